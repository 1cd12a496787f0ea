"""Positive throughout a region: by boxes that cover it, also where there is nothing to divide."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.positivity import positive_by_boxes
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
