"""What has no zero in a region, and what has a sign on a box: shown where it holds, and only there."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.intervals import intervals_of
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.region import Region
from canon.decide.sign_on_box import definite_sign, is_zero_free
from canon.decide.tape import Tape
from canon.domain import Condition, Domain

x, y, w = sp.symbols("x y w", real=True)
a = sp.Symbol("a", positive=True)
b = sp.Symbol("b", nonnegative=True)
z = sp.Symbol("z")
V = sp.Function("V", real=True)


def region_of(tape: Tape, f: sp.Expr, *positive: sp.Expr) -> Region:
    conditions = tuple(Condition("positive", (c,), f"{c} > 0") for c in positive)
    return Region.of(tape, Domain(conditions), f.free_symbols | set().union(*(c.free_symbols for c in positive)))


@pytest.mark.parametrize(
    ("f", "positive", "none"),
    [
        (sp.Integer(3), (), True),
        (sp.Integer(0), (), False),
        (a, (), True),
        (-2 * a, (), True),
        (b, (), False),  # 0 is allowed
        (1 + b, (), True),
        (1 - b, (1 - b,), True),
        (a * (1 + x**2), (), True),
        (a * (1 - x**2), (), False),
        (x, (), False),
        (x, (x,), True),
        (-3 * x * a, (x,), True),
        (x - 1, (x,), False),
        (x - 1, (x - 1,), True),
        (x - 1, (x - 2,), True),
        (1 / x, (), False),  # its factor x has one
        (1 / a, (), True),
        (sp.sqrt(1 + x**2) * a, (), True),
        (sp.exp(x), (), True),
        (1 + z**2, (), False),
        (V(x) ** 2 + 1, (), True),
        (V(x), (), False),
        (x * y, (x, y - 1), True),
        (x * w, (x, y - 1), False),
        (x**2 - y, (y - 1,), False),
    ],
)
def test_no_zero_is_shown_just_where_there_is_none(f: sp.Expr, positive: tuple[sp.Expr, ...], none: bool):
    tape = Tape()
    node = tape.load(f)
    assert has_no_zero(tape, node, region_of(tape, f, *positive), Budget(20)) is none


@pytest.mark.parametrize(
    ("f", "positive", "sign", "free"),
    [
        (x, (x,), "pos", True),
        (-x - 1, (x,), "neg", True),
        (x - 1, (x,), None, False),
        (x * y, (x, y), "pos", True),
        (-x * y, (x, y), "neg", True),
        (x * y**2, (x,), None, False),
        (x / y**2, (x,), None, True),  # y = 0 is no place of the domain
        (x / y, (x,), None, True),
        (x * y, (x,), None, False),
        (1 + x**2, (), "pos", True),
        (-1 - x**2, (), "neg", True),
        (x**2, (), None, False),
        (sp.exp(y) * x, (x,), "pos", True),
        (sp.exp(x) - 1, (x,), "pos", True),
        (1 - sp.exp(x), (x,), "neg", True),
        (sp.exp(x) - 1, (), None, False),
        (sp.sqrt(x) - 2, (x - 4,), "pos", True),
        (2 - sp.sqrt(x), (x - 4,), "neg", True),
        (sp.sqrt(x) - 2, (x - 3,), None, False),
        (sp.sqrt(1 + x**2) - sp.Rational(1, 2), (), "pos", True),
        (2 + sp.cos(x), (), "pos", True),
        (1 + sp.cos(x), (), None, False),
        (x**2 - x + 1, (), "pos", True),
        (x**2 - 2 * x + 1, (), None, False),
        (x**2 + y * (y - 2) + 2, (), "pos", True),
    ],
)
def test_a_sign_on_a_box(f: sp.Expr, positive: tuple[sp.Expr, ...], sign: str | None, free: bool):
    tape = Tape()
    node = tape.load(f)
    box = intervals_of(tape, region_of(tape, f, *positive))
    assert definite_sign(tape, node, box, Budget(20)) == sign
    assert is_zero_free(tape, node, box, Budget(20)) is free


@pytest.mark.parametrize(
    ("f", "none"), [(1 + x, False), (1 + x**3, False), (x, True), (3 * x, True), (1 + x**2, True), (x - y, False)]
)
def test_not_zero_is_not_positive(f: sp.Expr, none: bool):
    """Where x isn't 0 it may be −1."""
    tape = Tape()
    region = Region.of(tape, Domain((Condition("nonzero", (x,), "x != 0"),)), [x, y])
    assert has_no_zero(tape, tape.load(f), region, Budget(10)) == none
