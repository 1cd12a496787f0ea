"""Short forms are the same functions, sums of series have their terms, and substitution is done at once."""

from random import Random
from typing import Any

import pytest
import sympy as sp

from canon.errors import InputError
from canon.expression import Vocabulary, read
from canon.mechanics.formulas import as_formula, substituted
from canon.mechanics.linear_recurrence import constant_recurrence, periodic_sum, recurrent_sum
from canon.mechanics.one_form import exterior_derivative, potential, tidy
from canon.mechanics.picard import picard
from canon.mechanics.trigonometry import contracted

a, b, x, y, s = sp.symbols("a b x y s", real=True)
sin, cos, sinh, cosh = sp.sin, sp.cos, sp.sinh, sp.cosh
LONG: list[Any] = [
    (sin(a) ** 2 + 2 * cos(a) ** 2 - 1) / (x * cos(a)),
    1 / (sp.tan(a) ** 2 + 1) + sp.cot(b) * sp.tan(b),
    (sp.csc(a) ** 2 - sp.cot(a) ** 2) * x + sp.sec(a) ** 2 - sp.tan(a) ** 2,
    sp.coth(a) ** 2 - 1 / sinh(a) ** 2 + sp.tanh(b) * cosh(b),
    sp.sqrt(cosh(a) ** 2 - 1) + sp.sqrt(1 + sinh(b) ** 2) ** 3,
    (x * cos(a) + y * sin(a)) ** 3 / (sin(a) ** 2 + cos(a) ** 2 + x),
    x / (cos(a) ** 4 - sin(a) ** 4) + y / (1 - cos(b) ** 2),
    (sin(a) * cosh(b)) ** 2 + (cos(a) * sinh(b)) ** 2,
    (x**2 - y**2) / (x - y) + sp.exp(x) * sin(a) ** 2 + sp.exp(x) * cos(a) ** 2,
    x / (x + y) + y / (x + y) + 1 / (x * y) - (x + y) / (x**2 * y + x * y**2),
    sp.cot(a) / (1 + sp.cot(a) ** 2) + sp.sec(b) / (1 + sp.tan(b) ** 2),
    sp.csc(a) * sp.tanh(x) / (1 - sp.tanh(x) ** 2),
]


@pytest.mark.parametrize("short_form", [contracted, tidy])
@pytest.mark.parametrize("number", range(len(LONG)))
def test_a_short_form_is_the_same_function(number: int, short_form: Any) -> None:
    """At two points, to 25 digits, and not longer."""
    given = LONG[number]
    found = sp.sympify(short_form(given))
    assert sp.count_ops(found) <= sp.count_ops(given)
    for seed in (1, 2):
        random = Random(seed)
        point = {z: sp.Rational(random.randint(100, 900), 1000) for z in (a, b, x, y)}
        assert abs(sp.N((found - given).xreplace(point), 30)) < 1e-25


@pytest.mark.parametrize("period", [1, 2])
@pytest.mark.parametrize("start", range(5))
@pytest.mark.parametrize("ratio", [sp.Integer(3), sp.Integer(-2), x**2, -(x**2), x])
def test_a_periodic_sum_has_its_terms(start: int, period: int, ratio: Any) -> None:
    """The k-th derivative at 0 is f_k, with f_(k+r) = ratio f_k from `start` on; x is positive where it is a number."""
    terms = [sp.Integer(7 + k**2) for k in range(start + period)]
    total = periodic_sum(terms, start, ratio, s)
    known = list(terms)
    while len(known) < start + 5:
        known.append(ratio * known[-period])
    point = {x: sp.Rational(2, 3)}
    for k, value in enumerate(known):
        assert abs(sp.N((total.diff(s, k).subs(s, 0) - value).xreplace(point), 20)) < 1e-15


@pytest.mark.parametrize(
    "coefficients",
    [
        (6, -5), (6, -11, 6), (0, 1), (0, 0), (-1, 2), (-4, 0), (0, -1, 0), (-2, -2),     (0, 0, 4), (8, -12, 6),
    ],
)  # fmt: skip
def test_a_recurrent_sum_solves_its_equation(coefficients: tuple[int, ...]) -> None:
    """y⁽ⁿ⁾ = Σ c_j y⁽ʲ⁾ with the given derivatives at 0: simple, double and triple roots, imaginary pairs, 0."""
    n = len(coefficients)
    terms = [x + k * y for k in range(1, n + 1)]
    total = recurrent_sum(terms, [sp.Integer(c) for c in coefficients], s)
    assert total is not None
    known: list[Any] = list(terms)
    for k in range(3):
        known.append(sum(c * known[k + j] for j, c in enumerate(coefficients)))
    point = {x: sp.Rational(2, 3), y: sp.Rational(5, 7)}
    for k, value in enumerate(known):
        assert abs(sp.N((total.diff(s, k).subs(s, 0) - value).xreplace(point), 20)) < 1e-15


def test_a_recurrence_is_found_where_its_coefficients_are_constant() -> None:
    terms = [x, x * y + 1]
    third = 3 * terms[1] - b * terms[0]
    assert constant_recurrence([*terms, third], (x, y)) == (-b, 3)
    assert constant_recurrence([*terms, third + x**2 / 1000], (x, y)) is None
    assert constant_recurrence([*terms, x * terms[0]], (x, y)) is None
    assert constant_recurrence([x, 2 * x, 4 * x], (x, y)) is None  # of one function there are many
    assert constant_recurrence([1 / (y - y), x, x], (x, y)) is None


def test_a_pull_back_is_defined_where_what_it_uses_is() -> None:
    """√x − √x + y needs x ≥ 0 although x is gone; the image of z, which it doesn't use, restricts nothing."""
    z = sp.Symbol("z", real=True)
    given = read("sqrt(x) - sqrt(x) + y", Vocabulary(symbols={"x": x, "y": y}))
    images = {x: as_formula(sp.log(a)), y: as_formula(b), z: as_formula(sp.log(b))}
    found = substituted(given, images)
    assert found.expr == b
    assert {term for condition in found.conditions for term in condition.terms} == {a, sp.log(a)}


@pytest.mark.slow
def test_a_potential_has_the_form_as_its_gradient() -> None:
    """Of closed forms, in any order of the variables; a form that isn't closed leaves a residual."""
    for F in (x**2 * y + sp.sin(a * y) * x, sp.exp(x * y) + a**2 / 2, x / (1 + y)):
        for order in ((x, y, a), (a, y, x)):
            form = [F.diff(z) for z in order]
            found = potential(form, order)
            assert found is not None
            point = {x: sp.Rational(2, 3), y: sp.Rational(5, 7), a: sp.Rational(3, 11)}
            for residual, z, part in zip(found.residuals, order, form, strict=True):
                assert abs(sp.N(residual.xreplace(point), 20)) < 1e-15
                assert abs(sp.N((found.function.diff(z) - part - residual).xreplace(point), 20)) < 1e-15
            assert all(sp.simplify(e) == 0 for e in exterior_derivative(form, order))
    bent = potential((y, 2 * x), (x, y))
    assert bent is not None
    assert any(sp.expand(residual) != 0 for residual in bent.residuals)
    assert exterior_derivative((y, 2 * x, x * a), (x, y, a)) == (1, a, 0)
    assert potential((sp.Function("f")(x) * sp.exp(-(x**3)), 0), (x, y)) is None


def test_an_antiderivative_at_a_singular_value_of_an_earlier_variable() -> None:
    """What is left over may be infinite at 1 and 2: it is taken at another value."""
    F = y / ((x - 1) * (x - 2)) + a * y
    found = potential((F.diff(y), F.diff(x), F.diff(a)), (y, x, a))
    assert found is not None
    assert all(sp.simplify(residual) == 0 for residual in found.residuals)


def test_picard_without_a_step_is_the_initial_value() -> None:
    assert picard([y, -x], [x, y], s, [1, a], 0) == ((1, a),)
    for values in ([y, 1], [1, s], [x, s]):
        with pytest.raises(InputError, match="initial"):
            picard([y, -x], [x, y], s, values, 1)
    (last,) = picard([y + s, x * y], [x, y], s, [2, 3], 1)[1:]
    assert last == (2 + 3 * s + s**2 / 2, 3 + 6 * s)
