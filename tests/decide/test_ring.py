"""Polynomials in few generators and in many: their terms, factors, quotients and roots are what they are said to be."""

import random
from fractions import Fraction
from math import prod

import pytest

from canon.budget import Budget
from canon.decide.ring import FEW, Ring, TooCostly

SIZES = (3, FEW + 5)


def polynomial(ring: Ring, rng: random.Random, terms: int = 3):
    p = ring.zero
    for _ in range(terms):
        factors = [ring.generators[rng.choice((0, 1, ring.size - 1))] ** rng.randint(0, 2) for _ in range(2)]
        p = p + ring.scaled(prod(factors, start=ring.one), Fraction(rng.choice((-3, -1, 1, 2, 4)), rng.choice((1, 5))))
    return p


@pytest.mark.parametrize("size", SIZES)
def test_factors_make_up_the_polynomial_and_fall_no_further(size: int):
    rng, ring = random.Random(3), Ring(size, 1e7, Budget(60))
    for _ in range(30):
        a, b = polynomial(ring, rng), polynomial(ring, rng)
        p = ring.times(ring.power(a, 2), b)
        if not p:
            continue
        content, factors = ring.factor(p)
        assert prod((f**e for f, e in factors), start=ring.constant(content)) == p
        assert all(len(ring.factor(f)[1]) == 1 and ring.factor(f)[1][0][1] == 1 for f, _ in factors)
        assert ring.quotient(p, b) == a * a
        assert ring.quotient(p * ring.generators[0] + ring.one, a * ring.generators[0]) is None
        assert ring.square_root(ring.power(a, 2)) in (a, -a)
        assert ring.square_root(ring.power(a, 2) + ring.generators[0]) is None


@pytest.mark.parametrize("count", [10, 30, FEW + 5])
def test_factors_in_many_generators(count: int):
    ring = Ring(FEW + 5, 1e7, Budget(60))
    first = sum(ring.generators[:count], ring.one)
    second = ring.generators[1] * ring.generators[3] + ring.constant(2) * ring.generators[count - 1]
    content, factors = ring.factor(ring.constant(Fraction(3, 4)) * first**2 * second)
    assert {e: f for f, e in factors} in ({2: first, 1: second}, {2: first, 1: ring.scaled(second, Fraction(1, 2))})
    assert prod((f**e for f, e in factors), start=ring.constant(content)) == ring.scaled(
        first**2 * second, Fraction(3, 4)
    )


@pytest.mark.parametrize("size", SIZES)
def test_terms_are_in_the_order_of_the_generators(size: int):
    ring = Ring(size, 1e7, Budget(60))
    low, next_to, high = ring.generators[0], ring.generators[1], ring.generators[-1]
    p = ring.constant(Fraction(2, 3)) * high * low**2 - next_to**3
    nothing = [0] * (size - 3)
    assert ring.terms(p) == {(2, 0, *nothing, 1): Fraction(2, 3), (0, 3, *nothing, 0): Fraction(-1)}
    assert ring.degrees(p) == (2, 3, *nothing, 1)
    assert ring.polynomial(ring.terms(p)) == p
    assert ring.leading(p) == Fraction(2, 3), "the last generator is the highest"


def test_work_is_counted_and_refused_beyond_the_limit():
    ring = Ring(2, 30.0, Budget(60))
    a = ring.one + ring.generators[0] + ring.generators[1]
    ring.times(a, a)
    assert ring.spent == 9
    with pytest.raises(TooCostly):
        ring.power(a, 9)
    with pytest.raises(TooCostly):
        Ring(2, 1e9, Budget(0.01)).charge(1e8)
