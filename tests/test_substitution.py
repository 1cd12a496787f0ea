"""Substitution in derivatives of arbitrary functions is that in the derivatives of any functions put for them."""

from typing import Any

import pytest
import sympy as sp

from canon import PhaseSpace, Transformation, verify
from canon.substitution import replaced

x, y, z = sp.symbols("x y z", real=True)
f, g = sp.Function("f"), sp.Function("g")
FORMULAS: list[Any] = [
    f(x, y).diff(x), f(x, y).diff(y) * x + y, f(x, y).diff(x, y), f(x, y).diff(x, 2, y), f(x**2, y).diff(x),
    f(x, x).diff(x), f(x * y, x + y).diff(y), f(f(x, y), y).diff(x), f(x, y).diff(x) ** 2 + f(y, x).diff(x),
    sp.sqrt(1 + f(x, y).diff(y) ** 2) * f(x, y), f(x, y).diff(x) + f(x, z).diff(z) + z,
]  # fmt: skip
IMAGES: list[dict[Any, Any]] = [
    {x: y, y: -x}, {x: z, y: x}, {x: y}, {y: x + y}, {x: 2 * y, y: x * y},
]  # fmt: skip


def put(expression: Any) -> Any:
    """With a³b² + b for f(a, b)."""
    a, b = sp.Dummy(), sp.Dummy()
    return expression.subs(f, sp.Lambda((a, b), a**3 * b**2 + b)).doit()


@pytest.mark.parametrize("images", IMAGES, ids=str)
def test_it_is_the_same_before_and_after_a_function_is_chosen(images: dict[Any, Any]) -> None:
    for formula in FORMULAS:
        wanted = put(formula).xreplace(images)
        once = replaced(formula, images)
        assert sp.expand(put(once) - wanted) == 0, formula
        again = replaced(once, {x: y, y: -x})  # of what has been replaced already
        assert sp.expand(put(again) - wanted.xreplace({x: y, y: -x})) == 0, formula


def test_short_forms_stay_short() -> None:
    assert replaced(f(x, y).diff(x), {x: y, y: x}) == f(y, x).diff(y)
    assert replaced(f(x).diff(x), {x: z}) == f(z).diff(z)
    assert replaced(f(x, y).diff(x, y), {x: z, y: x}) == f(z, x).diff(z, x)
    assert replaced(x + 2 * y, {x: y, y: x}) == y + 2 * x


SPACE = PhaseSpace("x y", "px py", new=("X Y", "PX PY"), functions="f")
(q1, q2), (p1, p2), arbitrary = SPACE.q, SPACE.p, SPACE.function("f")
GAUGE = Transformation(SPACE, Q=(q1, q2), P=(p1 - arbitrary(q1, q2).diff(q1), p2 - arbitrary(q1, q2).diff(q2)))


@pytest.mark.parametrize(
    "other",
    [
        Transformation(SPACE, Q=(q1 + q2, q2), P=(p1, p2 - p1)),
        Transformation(SPACE, Q=(q2, q1), P=(p2, p1)),
        Transformation(SPACE, Q=(q2, -q1), P=(p2, -p1)),
        Transformation(SPACE, Q=(p1, q2), P=(-q1, p2)),
    ],
)
def test_gauge_transformations_by_any_function_compose(other: Transformation) -> None:
    """A canonical map and one whose momenta are shifted by ∇f(x, y): canonical, in either order."""
    for both in (GAUGE.after(other), other.after(GAUGE)):
        assert verify(both.canonical()).status == "proved"


def test_a_composition_by_hand() -> None:
    sheared = GAUGE.after(Transformation(SPACE, Q=(q1 + q2, q2), P=(p1, p2 - p1)))
    (_, _, first, second) = (sp.sympify(e) for e in sheared.expressions)
    F = sp.Lambda((x, y), x**3 * y**2)
    shown = [e.subs(arbitrary, F).doit() for e in (first, second)]
    assert sp.expand(shown[0] - (p1 - 3 * (q1 + q2) ** 2 * q2**2)) == 0
    assert sp.expand(shown[1] - (p2 - p1 - 2 * (q1 + q2) ** 3 * q2)) == 0


def test_conditions_on_derivatives_are_pulled_back_too() -> None:
    """∂₁f > 0 under the exchange of x and y, and under a shear."""
    where = SPACE.where(arbitrary(q1, q2).diff(q1) > 0)
    kept = Transformation(where, Q=(q1, q2), P=(p1, p2))
    swapped = kept.after(Transformation(SPACE, Q=(q2, q1), P=(p2, p1)))
    (condition,) = swapped.space.domain.conditions
    assert condition.terms == (arbitrary(q2, q1).diff(q2),)
    sheared = kept.after(Transformation(SPACE, Q=(q1 + q2, q2), P=(p1, p2 - p1)))
    (condition,) = sheared.space.domain.conditions
    shown = condition.terms[0].subs(arbitrary, sp.Lambda((x, y), x**3 * y)).doit()
    assert sp.expand(shown - 3 * (q1 + q2) ** 2 * q2) == 0
