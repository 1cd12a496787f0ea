"""False only in a thin part of the domain: beyond a zero of a condition, near an edge or in a corner."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide import ladder
from canon.decide.region import Region
from canon.decide.slivers import simplest
from canon.decide.tape import Tape
from canon.domain import Condition, Domain, conditions_of

x, y = sp.symbols("x y", real=True)
z = sp.Symbol("z")
CORNER = (x > sp.Rational(999, 1000), y > sp.Rational(999999, 10**6), 2 - x > 0, 2 - y > 0)


def answer(expression, *where):
    tape = Tape()
    conditions = [Condition("positive", (w.gts - w.lts,)) for w in where]
    domain = Domain((*conditions, *conditions_of(expression)))
    (found,) = ladder.vanish(tape, [tape.load(expression)], Region.of(tape, domain), budget=Budget(5))
    return found


def away(width):
    """The number 1 − width."""
    return 1 - sp.Rational(1, 10**width)


@pytest.mark.parametrize("width", [3, 5, 7])
@pytest.mark.parametrize(
    "false",
    [
        lambda k: (sp.Abs(x - away(k)) - (away(k) - x), x > 0, x < 1),
        lambda k: (sp.sqrt(sp.expand((x - away(k)) ** 2)) - (away(k) - x), x > 0, x < 1),
        lambda k: (sp.sign(x - 1 + away(k)) - 1, x > 0, x < 3),
        lambda k: (sp.Abs(sp.sin(x) - away(k)) - (away(k) - sp.sin(x)), x > 0, x < 3),
        lambda k: (sp.asin(sp.sin(x)) - x, x > -1, sp.pi / 2 + 1 - away(k) > x),
        lambda k: (sp.acos(sp.cos(x)) - x, x > 0, sp.pi + 1 - away(k) > x),
        lambda k: (sp.atan(sp.tan(x)) - x, x > -1, sp.pi / 2 + 1 - away(k) > x),
        lambda k: (sp.sqrt((x - y) ** 2) - (x - y), x > 0, x < 1, y > 0, 1 - away(k) > y),
        lambda k: (sp.Abs(sp.exp(x) - 2 + away(k)) - (sp.exp(x) - 2 + away(k)), x > 0, x < 3),
        lambda k: (sp.atan2(x, y) - sp.atan(x / y), x > 1, y > away(k) - 1, y < 1),
    ],
)
def test_a_difference_in_a_sliver_is_found(false, width):
    assert answer(*false(width)).status == "refuted"


@pytest.mark.parametrize(
    "case",
    [
        (sp.Abs(x * y - 1) - x * y + 1, *CORNER),
        (sp.sqrt((x**2 + y**2 - 1) ** 2) - x**2 - y**2 + 1, *CORNER[:1], y > -1, sp.Rational(1, 100) - y > 0),
        (sp.Abs(sp.sin(x * y)) - sp.sin(x * y), x > 0, 1 - x > 0, y > 0, sp.Rational(31416, 10**4) - y > 0),
        (sp.LambertW(x * sp.exp(x)) - x, x > -sp.Rational(1001, 1000)),
        (sp.gamma(x) - sp.Abs(sp.gamma(x)), x > -sp.Rational(1, 1000)),
    ],
)
def test_a_corner_and_the_edges_of_special_functions(case):
    assert answer(*case).status == "refuted"


@pytest.mark.parametrize(
    "case",
    [
        (sp.Abs(x - away(5)) - (away(5) - x), x > 0, away(5) - x > 0),
        (sp.asin(sp.sin(x)) - x, x > -1, sp.pi / 2 - x > 0),
        (sp.Abs(x * y - 1) - x * y + 1, x > 1, y > 1),
    ],
)
def test_what_holds_up_to_the_edge_is_not_refuted(case):
    assert answer(*case).status in ("proved", "supported")


@pytest.mark.parametrize(
    ("low", "high", "between"),
    [(0, 1, "1/2"), (-1, 1, "0"), (0, "1/10", "1/11"), ("2/5", "1/2", "3/7"), (-3, -2, "-5/2"), ("7/2", 9, "4")],
)
def test_the_simplest_rational_between(low, high, between):
    assert simplest(Fraction(low), Fraction(high)) == Fraction(between)
