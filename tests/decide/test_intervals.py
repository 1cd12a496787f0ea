"""Exact intervals, far from 0 too, where floating-point numbers can't tell one multiple of pi from the next."""

from fractions import Fraction

import pytest

from canon.decide.intervals import Edge, Interval


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
