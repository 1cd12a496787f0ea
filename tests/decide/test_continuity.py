"""Arguments on connected cells prove nothing of what vanishes at the point they begin at, and there alone."""

import random
from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.cells import cells_of
from canon.decide.continuity import _conjugates, _reduce, vanishes_by_cells, vanishes_on_cell
from canon.decide.derivative import substitute
from canon.decide.region import Region, Requirement
from canon.decide.search import samples
from canon.decide.tape import Tape
from canon.domain import Domain, conditions_of

x, y = sp.symbols("x y", real=True)
a = sp.Symbol("a", positive=True)
I, atan, log, sqrt = sp.I, sp.atan, sp.log, sp.sqrt  # noqa: E741
FALSE = [
    log(1 + I * x), log(a) + I * x, I * log(a), log(a) * x, atan(x) + atan(x / 2), atan(x) * x,
    atan(x) - sp.asin(x / 9), sp.atan2(x, a) / sp.pi, sqrt(1 + x**2) * sqrt(1 + y**2), sqrt(1 + x**2) + x * y, x * y,
    x + a * y, sp.Abs(x) * y, sp.acos(x / 9) + log(a), sp.exp(x) + sqrt(a), sp.sin(x) * log(a),
    log(1 + I * x) + log(1 + I * y),
]  # fmt: skip


@pytest.mark.parametrize("function", FALSE, ids=str)
def test_what_is_zero_at_the_first_point_is_no_identity(function: sp.Expr):
    tape = Tape()
    region = Region.of(tape, Domain(conditions_of(function)), sorted(function.free_symbols, key=str))
    node = tape.load(function)
    for cell in cells_of(tape, region, [node], Budget(20)) or ():
        (first,) = samples(tape, [node], cell.region, random.Random(2), count=1, budget=Budget(20), tries=40, nice=True)
        values = {n: tape.number(v) for n, v in first.point.items() if isinstance(v, Fraction)}
        near = tape.minus(node, substitute(tape, node, values))
        assert not tape.value(near)
        assert vanishes_on_cell(tape, near, cell, random.Random(2), Budget(20), 3) is None


def test_what_is_not_zero_is_not_taken_for_positive():
    tape = Tape()
    inside = x * y - 1
    region = Region((Requirement("nonzero", (tape.load(inside),), ""),), (), ())
    for function in (sqrt(sp.expand(inside**2)) - inside, sqrt(sp.expand(inside**2)) + inside):
        assert vanishes_by_cells(tape, tape.load(function), region, random.Random(1), Budget(20)) is None


def test_conjugates_that_are_too_costly_prove_nothing():
    tape = Tape()
    node = tape.load(sqrt(1 + x**2) - y)
    (cell,) = cells_of(tape, Region((), (), ()), [node], Budget(20)) or ()
    reduced = _reduce(tape, node, cell, Budget(20))
    assert reduced is not None
    zero, form, field, tower = reduced
    assert not zero
    assert form is not None
    (point,) = samples(tape, [node], cell.region, random.Random(2), count=1, budget=Budget(20))
    assert not _conjugates(form, field, tower, point)
    field.ring.limit = 0.0
    assert not _conjugates(form, field, tower, point)


TRUE = [
    (atan(x) + atan(1 / x) - sp.pi / 2, (x,), None, "zero gradient|values in 2 pi Z"),
    (log(1 + I * x) + log(1 - I * x) - log(1 + x**2), (), "values in 2 pi i Z on a connected cell", ""),
    (sqrt(x**2) + x, (-x,), "normal form", ""),
    (sp.asin(x) + sp.acos(x) - sp.pi / 2, (1 - x, 1 + x), None, "zero gradient|values in 2 pi Z"),
    (sqrt(2) + sqrt(3) - sqrt(5 + 2 * sqrt(6)), (), None, "exact constant|normal form"),
]


@pytest.mark.parametrize(("function", "positive", "exactly", "words"), TRUE, ids=str)
def test_what_is_zero_is_proved_and_a_thousandth_beside_it_is_not(function, positive, exactly, words):
    tape = Tape()
    region = Region.of(tape, Domain(conditions_of(function)))
    region = region.also(*(Requirement("positive", (tape.load(p),), "") for p in positive))
    found = vanishes_by_cells(tape, tape.load(function), region, random.Random(1), Budget(20))
    assert found is not None
    assert found[0] == exactly or any(word in found[0] for word in words.split("|") if word)
    for wrong in (function + sp.Rational(1, 1000), function - sp.pi, function * 2 + 2 * sp.pi):
        assert vanishes_by_cells(tape, tape.load(wrong), region, random.Random(1), Budget(20)) is None
