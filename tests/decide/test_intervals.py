"""Exact intervals, far from 0 too, where floating-point numbers can't tell one multiple of pi from the next."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.enclosure import precision
from canon.decide.intervals import Edge, Interval
from canon.decide.sign_intervals import sign_by_real_roots
from canon.decide.tape import Tape
from canon.decide.tower import Tower, combine


@pytest.mark.parametrize(
    ("edge", "floor"),
    [
        (Edge(Fraction(0), Fraction(5, 2)), 2),
        (Edge(Fraction(0), Fraction(-5, 2)), -3),
        (Edge(Fraction(22, 7)), 1),
        (Edge(Fraction(3)), 0),
        (Edge(Fraction(-3), Fraction(1)), 0),
        (Edge(Fraction(10**20)), 31830988618379067153),
        (Edge(Fraction(-(10**18))), -318309886183790672),
    ],
)
def test_multiples_of_pi_below(edge: Edge, floor: int):
    assert edge.floor_of_multiple_of_pi() == floor


@pytest.mark.parametrize(("start", "sign"), [(10**17, "neg"), (10**18, "neg"), (10**20, "neg"), (-(10**20), "pos")])
def test_the_sign_of_a_sine_far_away(start: int, sign: str):
    interval = Interval(Edge(Fraction(start)), Edge(start + Fraction(1, 1000)))
    assert interval.sine_sign() == sign


@pytest.mark.parametrize(("above", "expected"), [(3, "pos"), (2**65, "neg")])
def test_a_polynomial_is_looked_at_inside_of_a_thin_interval(above: int, expected: str):
    tape = Tape()
    x = sp.Symbol("x", real=True)
    node = tape.load(x**2 - 2**120 - above)
    thin = Interval(Edge(Fraction(2**60 + 1)), Edge(Fraction(2**60 + 2)))
    tower = Tower(tape, [node], positive=(), intervals={tape.symbol(x): thin}, budget=Budget(10))
    values = dict(tower.values)
    for i in tape.reach([node]):
        if i not in values:
            values[i] = combine(tower.field, tape.ops[i], values)
    with precision(256):  # at which roots outside of it are told from its ends
        assert sign_by_real_roots(tower, values[node][0]) == expected


@pytest.mark.parametrize("digits", [10, 25, 40, 200])
def test_edges_on_both_sides_of_pi_are_told_apart(digits: int):
    """π cut after so many digits lies below it, and one more in the last place above."""
    below = Fraction(int(sp.pi.evalf(digits + 20) * 10**digits), 10**digits)
    for rational, sign in ((below, -1), (below + Fraction(1, 10**digits), 1)):
        for factor in (Fraction(1), Fraction(-2, 7)):
            sign_here = sign if factor > 0 else -sign
            assert Edge(rational * factor).compare(Edge(Fraction(0), factor)) == sign_here
            assert Edge(Fraction(0), factor).compare(Edge(rational * factor)) == -sign_here
