"""Roots and logarithms of numbers whose prime factors are large, of whatever type of integer these come."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.decide.constants import number_is_zero
from canon.decide.factors import prime_factors
from canon.decide.ring import TooCostly
from canon.decide.tape import Tape, Unsupported
from canon.decide.tower import Tower

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


def test_numbers_are_factored_as_far_as_that_is_quick():
    p, q = sp.nextprime(2**90), sp.nextprime(2**99)
    assert prime_factors(Fraction(360, 7)) == [(2, 3), (3, 2), (5, 1), (7, -1)]
    assert prime_factors(Fraction(10007**2 * 1009, 1)) == [(1009, 1), (10007, 2)]
    assert prime_factors(Fraction(PAIRS[2][0] * PAIRS[2][1])) == sorted([(PAIRS[2][0], 1), (PAIRS[2][1], 1)])
    assert prime_factors(Fraction(p, 2)) == [(p, 1), (2, -1)]
    with pytest.raises(Unsupported, match="takes long"):
        prime_factors(Fraction(3 * p * q))
    with pytest.raises(Unsupported, match="too long"):
        prime_factors(Fraction(2**201))


def test_a_root_of_two_primes_of_thirty_digits_is_no_hang():
    """The factors of that product take minutes to find."""
    n = sp.nextprime(2**97) * sp.nextprime(2**98)
    head = '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\nkind = "identity"\n'
    for rhs, status in (("q", "refuted"), (f"sqrt({n})*abs(q)", None)):
        text = f'{head}lhs = "sqrt({n}*q**2)"\nrhs = "{rhs}"\n'
        found = verify(read_text(text).claims[0], budget=2.0).status
        assert found == status if status else found in ("proved", "supported")


def test_a_root_of_order_a_hundred_million_is_no_hang():
    """Its relation has the 10⁸-th power of sin x below, which has to be reduced while it is multiplied."""
    tape = Tape()
    node = tape.load(sp.cos(sp.Symbol("x", real=True)) / sp.sin(sp.Symbol("x", real=True)))
    budget = Budget(20)
    with pytest.raises(TooCostly):
        Tower(tape, [tape.root(node, Fraction(1, 10**8))], budget=budget)
    assert not budget.spent()
