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
    ],
)
def test_what_follows_is_left_out(conditions, left):
    tape = Tape()
    found = without_implied(tape, _region(tape, conditions), Budget(10))
    assert [r.text for r in found.requirements] == [str(f) for f in left]


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
    ],
)
def test_signs_where_a_is_less_than_c(node, expected):
    tape = Tape()
    assert positive_by_signs(tape, tape.load(node), _region(tape, [c - a]), Budget(10), strict=True) is expected
