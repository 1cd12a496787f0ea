"""Polynomials in one whole number are positive where all whole numbers within their roots' bound say so."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.positive_by_cases import positive_at_whole_numbers, positive_by_cases
from canon.decide.region import Region, Requirement
from canon.decide.tape import Tape

whole, x = sp.Symbol("n", integer=True), sp.Symbol("x", real=True)
upwards = sp.Symbol("k", integer=True, positive=True)
downwards = sp.Symbol("m", integer=True, negative=True)
SIGNS = {  # strictly, and without 0 left out
    whole**2 + 1: (True, True),
    whole**2 - whole: (False, True),
    4 * whole**2 - 1: (False, False),
    4 * upwards**2 - 1: (True, True),
    4 * downwards**2 - 1: (True, True),
    upwards - 1: (False, True),
    1 - upwards: (False, False),
    1 - downwards: (True, True),
    -(downwards**3): (True, True),
    downwards**3: (False, False),
    (upwards - 3) * (upwards - 4): (False, True),
    2 * (upwards - 3) * (2 * upwards - 7): (False, True),
    (2 * upwards - 5) * (2 * upwards - 9): (False, False),
    x**2 + 1: (False, False),  # no whole number
    whole**2 + x**2 + 1: (False, False),
    sp.cos(whole) + 2: (False, False),
}


@pytest.mark.parametrize(("formula", "signs"), SIGNS.items(), ids=str)
def test_whole_numbers_one_by_one(formula: sp.Expr, signs: tuple[bool, bool]) -> None:
    tape = Tape()
    node = tape.load(formula)
    assert tuple(positive_at_whole_numbers(tape, node, strict=strict) for strict in (True, False)) == signs


@pytest.mark.parametrize(("formula", "shown"), [(x**4 + abs(x), True), (x**3 + abs(x) ** 3, False), (x, False)])
def test_both_signs_of_what_is_not_0(formula: sp.Expr, shown: bool) -> None:
    tape = Tape()
    node, name = tape.load(formula), tape.symbol(x)
    region = Region((Requirement("nonzero", (name,), "x != 0"),), (), (name,))
    assert bool(positive_by_cases(tape, node, region, Budget(10), strict=True)) is shown
