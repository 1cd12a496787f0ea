"""Roots of numbers whose factors are large: they come back from the factorisation as other integers than Python's."""

import sympy as sp

from canon.budget import Budget
from canon.decide.constants import number_is_zero
from canon.decide.tape import Tape

P, Q = 10**18 + 9, 10**19 + 51


def test_a_root_of_a_product_of_large_primes():
    tape = Tape()
    node = tape.load(sp.sqrt(sp.Integer(P * Q) ** 3, evaluate=False) - P * Q * sp.sqrt(sp.Integer(P * Q)))
    assert number_is_zero(tape, node, Budget(20))


def test_a_logarithm_of_a_product_of_large_primes():
    tape = Tape()
    product = tape.number(P * Q)
    log = tape.minus(tape.call("log", tape.power(product, 2)), tape.scaled(tape.call("log", product), 2))
    assert number_is_zero(tape, log, Budget(20))
