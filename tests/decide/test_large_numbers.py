"""Roots and logarithms of numbers whose prime factors are large, of whatever type of integer these come."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.constants import number_is_zero
from canon.decide.tape import Tape

PAIRS = [(10**9 + 7, 10**9 + 9), (10**12 + 39, 10**9 + 7), (10**13 + 37, 10**12 + 39)]


@pytest.mark.parametrize(("p", "q"), PAIRS)
def test_a_root_of_a_product_of_large_primes(p: int, q: int):
    tape = Tape()
    root = tape.sqrt(tape.number(p * q))
    node = tape.minus(tape.times(tape.sqrt(tape.number(p)), tape.sqrt(tape.number(q))), root)
    assert number_is_zero(tape, node, Budget(20))


@pytest.mark.parametrize(("p", "q"), PAIRS)
def test_a_logarithm_of_a_product_of_large_primes(p: int, q: int):
    tape = Tape()
    logs = tape.plus(tape.call("log", tape.load(sp.Integer(p))), tape.call("log", tape.load(sp.Integer(q))))
    assert number_is_zero(tape, tape.minus(tape.call("log", tape.number(p * q)), logs), Budget(20))
