"""Roots and logarithms of numbers whose prime factors are large, of whatever type of integer these come."""

import contextlib
import math
import time
from fractions import Fraction

import pytest
import sympy as sp

from canon import InputError, PhaseSpace, bracket, identity
from canon.budget import Budget
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.decide.constants import number_is_zero
from canon.decide.factors import prime_factors
from canon.decide.ring import Ring, TooCostly
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


@pytest.mark.parametrize("n", [10_000, 100_000, 1_000_000])
def test_powers_of_sums_count_the_length_of_their_coefficients(n):
    """(x + 1)ⁿ has n + 1 of them, of up to n bits: at n = 10⁶ no memory would hold them."""
    ring = Ring(1, math.inf, Budget(1))
    start = time.monotonic()
    if n < 20_000:
        assert len(ring.power(ring.generators[0] + ring.constant(1), n)) == n + 1
    else:
        with pytest.raises(TooCostly):
            ring.power(ring.generators[0] + ring.constant(1), n)
        with pytest.raises(TooCostly):
            ring.power(ring.scaled(ring.generators[0], Fraction(10**3000)), n)
    assert time.monotonic() - start < 5


def test_numbers_that_are_longer_than_python_writes():
    space = PhaseSpace("q", "p")
    q, p = space.old
    long = sp.Integer(10) ** 3000
    assert verify(bracket(space, long * q, (long + 1) * p, 1)).detail["value"] == "a long formula"
    root = sp.Integer(10) ** 1500
    assert verify(bracket(space, root * q, (root + 1) * p, root * (root + 1))).status == "proved"
    for edge in (long, 1 / long):
        near = space.where(sp.Gt(q, edge, evaluate=False))
        with contextlib.suppress(InputError):  # a domain so far away may look empty
            assert verify(identity(near, abs(q), q)).status in ("proved", "supported", "undecided")
