"""Positive throughout a region: by boxes that cover it, also where there is nothing to divide."""

import random
from fractions import Fraction

import pytest
import sympy as sp
from flint import arb

from canon.budget import Budget
from canon.decide.enclosure import precision
from canon.decide.intervals import Edge
from canon.decide.positivity import _outward, first_points, point_below, positive_by_boxes, positive_by_signs
from canon.decide.region import Region, Requirement
from canon.decide.tape import Tape

ROOT = sp.sqrt(2) + sp.sqrt(3) - sp.sqrt(5 + 2 * sp.sqrt(6))


@pytest.mark.parametrize(
    ("constant", "boxes"),
    [(sp.sqrt(2) - 1, 1), (1 - sp.sqrt(2), None), (ROOT, None), (ROOT + sp.Rational(1, 10**12), 1)],
)
def test_a_constant_is_one_box(constant: sp.Expr, boxes: int | None):
    tape = Tape()
    node = tape.load(constant)
    assert positive_by_boxes(tape, node, Region((), (), frozenset()), Budget(10), strict=True) == boxes


@pytest.mark.parametrize(("edge", "covered"), [(sp.Rational(99, 100), True), (sp.Rational(101, 100), False)])
def test_a_parabola_is_positive_up_to_its_zero(edge: sp.Rational, covered: bool):
    tape = Tape()
    x = sp.Symbol("x", real=True)
    inside = tuple(Requirement("positive", (tape.load(c),), str(c)) for c in (x, edge - x))
    region = Region(inside, (), frozenset({tape.symbol(x)}))
    found = positive_by_boxes(tape, tape.load(1 - x**2), region, Budget(10), strict=True)
    assert (found is not None) == covered


def region_of(tape: Tape, *positive: sp.Expr) -> Region:
    names = sorted(set().union(*(p.free_symbols for p in positive)), key=str)
    nodes = tuple(Requirement("positive", (tape.load(p),), str(p)) for p in positive)
    return Region(nodes, (), tuple(tape.symbol(s) for s in names))


@pytest.mark.parametrize("pi_part", ["1", "-3/7", "22/7", "1/1000", "0"])
def test_a_box_reaches_just_beyond_an_edge(pi_part: str):
    edge = Edge(Fraction(-2, 3), Fraction(pi_part))
    low, high = _outward(edge, -1), _outward(edge, 1)
    with precision(128):
        value = arb(-2) / 3 + arb.pi() * arb(edge.pi.numerator) / edge.pi.denominator
        assert not arb(low.numerator) / low.denominator > value
        assert not arb(high.numerator) / high.denominator < value
    assert 0 <= high - low < Fraction(1, 10**15)


x, y = sp.symbols("x y", real=True)
u = sp.Symbol("u", nonnegative=True)
a = sp.Symbol("a", positive=True)
SIGNED = [  # conditions, a function, whether it is positive, whether it isn't negative, there
    ((x, sp.pi - x), sp.sin(x) + x / 10, True, True),
    ((x - 1, sp.pi - x), sp.sin(x) - sp.Rational(1, 10), False, False),
    ((x + 1, 2 - x), x**2 - x + sp.Rational(1, 3), True, True),
    ((x + 1, 2 - x), x**2 - x + sp.Rational(1, 5), False, False),
    ((x + 1, 2 - x), (x**2 - x) ** 2, False, True),
    ((x, 1 - x, y, 1 - y), 1 - x * y + x * y**2 / 4, True, True),
    ((x, 1 - x, y, 1 - y), sp.Rational(99, 100) - x * y, False, False),
    ((3 - u,), u * (5 - u), False, True),
    ((3 - u,), u**2 + 1 - u, True, True),
    ((3 - u, a), a + u - u**2 / 3, True, True),
    ((3 - u, a), a + u - u**2, False, False),
    ((a,), a**2 - a + sp.Rational(1, 4), False, True),
    ((x, y), sp.sqrt(1 + x**2) - x, True, True),
    ((x, y), sp.sqrt(1 + x**2) - x * y, False, False),
    ((x + 1, 1 - x), 1 / (2 + x) - sp.Rational(1, 4), True, True),
    ((x + 1, 1 - x), 1 / (2 + x) - sp.Rational(2, 5), False, False),
]


@pytest.mark.parametrize(("conditions", "function", "positive", "not_negative"), SIGNED, ids=str)
def test_positive_where_it_is(conditions, function, positive, not_negative):
    """Never is positive what isn't; and of the two arguments one sees what is."""
    tape = Tape()
    region, node = region_of(tape, *conditions), tape.load(function)
    for strict, known in ((True, positive), (False, not_negative)):
        by_signs = positive_by_signs(tape, node, region, Budget(20), strict=strict)
        by_boxes = positive_by_boxes(tape, node, region, Budget(20), strict=strict) is not None
        assert known or not (by_signs or by_boxes)
        assert not known or by_signs or by_boxes
    starts = first_points(tape, node, region, random.Random(1), Budget(20))
    for strict, known in ((True, positive), (False, not_negative)):
        below = point_below(tape, node, region, starts, random.Random(1), Budget(20), strict=strict)
        assert below is None or not known
        if below is not None:
            value = function.subs({tape.symbol_at(n): sp.Rational(str(v)) for n, v in below.point.items()})
            assert value < 0 or (strict and value == 0)
        else:
            assert not_negative


def test_what_is_undefined_where_a_name_may_be_zero_is_not_taken_for_positive():
    tape = Tape()
    region = region_of(tape, 3 - u)
    assert positive_by_signs(tape, tape.load((1 + u) / u), region, Budget(20), strict=False)
    assert not positive_by_signs(tape, tape.load((1 + u) / u), region, Budget(20), strict=True)
