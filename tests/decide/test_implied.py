"""Conditions that follow from others, and the signs that show it."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.implied import without_implied
from canon.decide.positivity import positive_by_signs
from canon.decide.region import Region, Requirement
from canon.decide.tape import Tape

a, b, c = sp.symbols("a b c", positive=True)
x, y = sp.symbols("x y", real=True)
e = sp.sqrt(a * (2 * c - a)) / c


def _region(tape, conditions, kinds=()):
    kinds = [*kinds, *["positive"] * (len(conditions) - len(kinds))]
    made = tuple(Requirement(k, (tape.load(f),), str(f)) for f, k in zip(conditions, kinds, strict=True))
    return Region(made, (), tuple(tape.symbol(s) for s in (a, b, c, x, y)))


@pytest.mark.parametrize(
    ("conditions", "left"),
    [
        ([c - a, a * (2 * c - a), 1 + e * sp.sin(x)], [c - a]),
        ([c - a, a * (2 * c - a), 1 + 2 * e * sp.sin(x)], [c - a, 1 + 2 * e * sp.sin(x)]),
        ([c - a * b, 2 * c - a * b, c - 2 * a * b], [c - 2 * a * b]),
        # a root is defined where its own condition says so: none of the two follows from the other's presence
        ([sp.sqrt(y) + 1, y], [y]),
        ([y, sp.sqrt(y) + 1], [y]),
        ([sp.log(y) - x, x, y], [sp.log(y) - x, x, y]),
        ([x, 1 + sp.sqrt(y) * x], [x, 1 + sp.sqrt(y) * x]),
        ([x, 2 * x, 3 * x], [x]),
        ([sp.sin(x), 2 * sp.sin(x) + y**2], [sp.sin(x)]),
        ([x, y, x + sp.log(y) ** 2], [x, y]),
        ([x, x + sp.log(y) ** 2], [x, x + sp.log(y) ** 2]),  # it says that y is positive
        ([x, x + sp.asin(y) ** 2], [x, x + sp.asin(y) ** 2]),
        ([x, x + sp.sqrt(1 + y**2)], [x]),
        ([x, y, x + 1 / y], [x, y]),
        ([x, x + 1 / y**2], [x, x + 1 / y**2]),  # it says that y isn't 0
        ([x, x + 1 / (1 + y**2)], [x]),
        ([x, x - 1 / (-1 - y**2)], [x]),
        ([x - y, y - x], [x - y, y - x]),
        ([x, y**2], [x, y**2]),  # y may be 0
        ([x, x * y**2 + (x * y) ** 2], [x, x * y**2 + (x * y) ** 2]),
        ([x * (1 + sp.I)], [x * (1 + sp.I)]),
    ],
)
def test_what_follows_is_left_out(conditions, left):
    tape = Tape()
    found = without_implied(tape, _region(tape, conditions), Budget(10))
    assert [r.text for r in found.requirements] == [str(f) for f in left]


@pytest.mark.parametrize(
    ("kinds", "conditions", "left"),
    [
        (["positive", "nonzero"], [x, x], [x]),
        (["nonzero", "positive"], [-x, x], [x]),
        (["positive", "nonzero"], [x, y], [x, y]),
        (["nonzero"], [x], [x]),
        (["nonzero"], [1 + x**2], []),
        (["nonzero"], [sp.exp(x)], []),
        (["positive", "regular"], [x, x], [x, x]),
        (["positive", "slit"], [x, x], [x, x]),
        (["positive", "nonzero", "nonzero"], [x, x + sp.log(y) ** 2, x + y**2], [x, x + sp.log(y) ** 2]),
    ],
)
def test_only_signs_that_are_shown_take_out_what_must_not_be_zero(kinds, conditions, left):
    tape = Tape()
    found = without_implied(tape, _region(tape, conditions, kinds), Budget(10))
    assert [r.text for r in found.requirements] == [str(f) for f in left]


def test_conditions_on_two_expressions_stay():
    tape = Tape()
    both = Requirement("uncut", (tape.load(1 + x**2), tape.load(y)), "off the cut")
    region = Region((both,), (), (tape.symbol(x), tape.symbol(y)))
    assert without_implied(tape, region, Budget(10)).requirements == (both,)


@pytest.mark.parametrize(
    ("node", "expected"),
    [
        (c + a * sp.cos(x), True),
        (c * b + a * b * sp.sin(y), True),
        (-c + a * sp.cos(x), False),
        (a + c * sp.cos(x), False),
        (c + (a + b) * sp.cos(x), False),
        (2 * c - a, True),
        (2 * c - 3 * a, False),
        (c * b - a * b, True),
        (5 * c - 5 * a + x**2, True),
        (c - a - b, False),
        (x**2 + a * (y - 1) ** 2, False),  # it is 0 at a point
        (x**2 + a * (y - 1) ** 2 + b, True),
        (x**2 + 2 * x * y + 2 * y**2, False),
        (x**2 + 2 * x * y + 2 * y**2 + c, True),
    ],
)
def test_signs_where_a_is_less_than_c(node, expected):
    tape = Tape()
    assert positive_by_signs(tape, tape.load(node), _region(tape, [c - a]), Budget(10), strict=True) is expected
