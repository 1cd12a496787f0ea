"""Series in balls: Taylor coefficients of elementary functions, remainders over boxes, branches that are refused."""

from fractions import Fraction
from typing import Any

import pytest
import sympy as sp
from flint import arb

from canon.decide.series import algebra, constant_term
from canon.decide.series_program import Unenclosed, run_series, working
from canon.decide.symplectic_defect import Box, _above, _below, defect_at, defect_over, degree_for
from canon.program import Builder, Program

DEGREE = 5
x = sp.Symbol("x")

FUNCTIONS: dict[str, tuple[Any, float]] = {
    "sin": (sp.sin(x), 0.7),
    "cos": (sp.cos(x), -0.7),
    "tan": (sp.tan(x), 0.4),
    "exp": (sp.exp(x), 1.1),
    "expm1": (sp.exp(x) - 1, 0.1),
    "log": (sp.log(x), 0.6),
    "log1p": (sp.log(1 + x), -0.3),
    "sinh": (sp.sinh(x), 0.5),
    "cosh": (sp.cosh(x), 0.5),
    "tanh": (sp.tanh(x), -0.8),
    "asin": (sp.asin(x), 0.3),
    "acos": (sp.acos(x), 0.3),
    "atan": (sp.atan(x), 2.0),
    "asinh": (sp.asinh(x), -1.5),
    "acosh": (sp.acosh(x), 1.5),
    "atanh": (sp.atanh(x), 0.3),
    "sqrt": (sp.sqrt(x), 0.3),
    "cbrt": (-sp.cbrt(-x), -0.3),
    "abs": (-x, -0.3),
    "neg": (-x, 0.3),
    "sign": (sp.Integer(-1), -0.3),
    "floor": (sp.Integer(-3), -2.5),
    "ceil": (sp.Integer(-2), -2.5),
    "round": (sp.Integer(-3), -2.75),
}


def unary(name: str) -> Program:
    builder = Builder(1, 10)
    return builder.program((builder.apply(name, builder.input(0)),))


def binary(name: str, other: float, *, first: bool = True) -> Program:
    builder = Builder(1, 10)
    operands = (builder.input(0), builder.number(other))
    return builder.program((builder.apply(name, *(operands if first else operands[::-1])),))


def series_at(program: Program, centre: Any) -> dict[int, Any]:
    space = algebra(1, DEGREE)
    (found,) = run_series(program, [space.variable(0, centre, arb(1))], space)
    return found


def assert_taylor(program: Program, expected: Any, place: float) -> None:
    with working(128, DEGREE):
        at = series_at(program, arb(place))
        over = series_at(program, arb(place) + arb(0, 2.0**-10))
        for m in range(DEGREE + 1):
            exact = expected.diff(x, m).subs(x, sp.Rational(place)).evalf(45) / sp.factorial(m)
            number = arb(str(exact))
            assert abs(at.get(m, arb(0)) - number) < 1e-30
            assert over.get(m, arb(0)).contains(number.mid())


@pytest.mark.parametrize("name", FUNCTIONS)
def test_taylors_coefficients(name: str) -> None:
    expected, place = FUNCTIONS[name]
    assert_taylor(unary(name), expected, place)


@pytest.mark.parametrize(
    ("program", "expected", "place"),
    [
        (binary("div", 3.0, first=False), 3 / x, 0.7),
        (binary("pow", 1.5), x ** sp.Rational(3, 2), 0.7),
        (binary("pow", -2.0), x**-2, -0.7),
        (binary("pow", 2.0, first=False), 2**x, -0.7),
        (binary("atan2", 0.5), sp.atan2(x, sp.Rational(1, 2)), -0.7),
        (binary("atan2", -0.5), sp.atan2(x, -sp.Rational(1, 2)), -0.7),
        (binary("atan2", 0.5, first=False), sp.atan2(sp.Rational(1, 2), x), -0.7),
        (binary("max", 0.5), x, 0.7),
        (binary("min", 0.5), sp.Rational(1, 2), 0.7),
        (binary("rem", 0.5), x - 1, 1.25),
        (binary("rem", 0.5), x + 1, -1.25),
    ],
)
def test_functions_of_two_numbers(program: Program, expected: Any, place: float) -> None:
    assert_taylor(program, expected, place)


@pytest.mark.parametrize(
    ("program", "place"),
    [
        (unary("abs"), 0.0),
        (unary("sign"), 0.0),
        (unary("sqrt"), 0.0),
        (unary("log"), -1.0),
        (unary("asin"), 1.5),
        (unary("floor"), 2.0),
        (unary("round"), 0.5),
        (unary("tan"), None),
        (binary("div", 1.0, first=False), 0.0),
        (binary("max", 0.5), 0.5),
        (binary("rem", 0.5), 1.0),
        (binary("atan2", 0.0, first=False), -1.0),
        (binary("atan2", -1.0), 0.0),
        (binary("pow", 0.5), -1.0),
    ],
)
def test_kinks_jumps_and_poles_are_refused(program: Program, place: float | None) -> None:
    with working(64, DEGREE), pytest.raises(Unenclosed):
        series_at(program, arb.pi() / 2 if place is None else arb(place))


def chosen(comparison: str) -> Program:
    """x² where x² < 0 (or ≤, =), else x."""
    builder = Builder(1, 10)
    argument = builder.input(0)
    square = builder.power(argument, 2)
    test = builder.apply(comparison, square, builder.number(0.0))
    return builder.program((builder.apply("select", test, square, argument),))


def test_a_choice_needs_a_certain_comparison() -> None:
    """At 0 the series of x² has lost its only term at low degrees, and is still no constant."""
    space = algebra(1, 1)
    for comparison in ("less", "less_equal", "equal"):
        with working(64, 1):
            found = run_series(chosen(comparison), [space.variable(0, arb(0.5), arb(1))], space)
            assert constant_term(found[0]) == 0.5
            with pytest.raises(Unenclosed):
                run_series(chosen(comparison), [space.variable(0, arb(0), arb(1))], space)


@pytest.mark.parametrize("place", [-0.5, 0.25, 0.5, 1.5])
def test_a_choice_takes_what_its_condition_says(place: float) -> None:
    """x² or x by every comparison with 3/8 and 1, and by what connects them; by none that is uncertain."""
    builder = Builder(1, 60)
    argument, near, far = builder.input(0), builder.number(0.375), builder.number(1.0)
    first, second = builder.apply("less", argument, near), builder.apply("less_equal", far, argument)
    unsure = builder.apply("less", argument, builder.number(place))
    a, b = place < 0.375, place >= 1.0
    conditions = [
        (first, a), (second, b), (builder.apply("not", first), not a), (builder.apply("and", first, second), a and b),
        (builder.apply("or", first, second), a or b), (builder.apply("equal", first, second), a == b),
        (builder.apply("equal", near, builder.number(0.375)), True), (builder.apply("equal", near, far), False),
        (builder.apply("less", near, builder.number(0.375)), False), (builder.apply("less", near, far), True),
        (builder.apply("less_equal", near, builder.number(0.375)), True), (builder.apply("less", far, near), False),
        (builder.apply("equal", argument, far), False),
        (builder.apply("or", unsure, builder.apply("less", near, far)), True),
        (builder.apply("and", unsure, builder.apply("less", far, near)), False),
    ]  # fmt: skip
    square = builder.power(argument, 2)
    program = builder.program(tuple(builder.apply("select", test, square, argument) for test, _ in conditions))
    space = algebra(1, 2)
    with working(64, 2):
        found = run_series(program, [space.variable(0, arb(place), arb(1))], space)
        for series, (_, truth) in zip(found, conditions, strict=True):
            assert constant_term(series) == (place**2 if truth else place)
            assert series[1] == (2 * place if truth else 1)
        for name, other in (("not", ()), ("and", (builder.apply("less", near, far),)), ("equal", (first,))):
            test = builder.apply(name, unsure, *other)
            with pytest.raises(Unenclosed):
                run_series(
                    builder.program((builder.apply("select", test, square, argument),)),
                    [space.variable(0, arb(place), arb(1))],
                    space,
                )


def product_map() -> Program:
    """Q = q p², P = p: det M = p²."""
    builder = Builder(2, 20)
    q, p = builder.input(0), builder.input(1)
    return builder.program((builder.apply("mul", q, builder.power(p, 2)), p))


def test_the_defect_over_a_box_and_at_a_point() -> None:
    """det M − 1 = p² − 1 lies between 5/4 and 21/4 where 3/2 ≤ p ≤ 5/2, and is 3 at p = 2."""
    box = Box((Fraction(0), Fraction(2)), (Fraction(1), Fraction(1, 2)))
    bound = defect_over(product_map(), box, Fraction(1), 4)
    assert bound.upper == pytest.approx(21 / 4, rel=1e-12)
    assert bound.lower == 3
    assert bound.direction == 1
    assert bound.entry == (0, 1)
    ((_, ball),) = defect_at(product_map(), [Fraction(1, 3), Fraction(2)], Fraction(1)).items()
    assert ball.contains(3)
    assert ball.rad() < 1e-30
    left, right = box.halves(1)
    assert (left.centre[1], right.centre[1], left.radii[1]) == (Fraction(7, 4), Fraction(9, 4), Fraction(1, 4))


def test_a_variable_may_stand_still() -> None:
    box = Box((Fraction(0), Fraction(2)), (Fraction(1), Fraction(0)))
    bound = defect_over(product_map(), box, Fraction(1), 2)
    assert bound.lower == 3
    assert bound.upper == pytest.approx(3, rel=1e-12)


def test_degrees_fall_with_the_number_of_variables() -> None:
    degrees = [degree_for(2 * n) for n in range(1, 9)]
    assert degrees[0] == 8
    assert degrees == sorted(degrees, reverse=True)
    assert degrees[-1] >= 1


@pytest.mark.parametrize("value", ["0", "1e-400", "3e-320", "1", "0.1", "123456789.123456789", "1e300"])
def test_floats_beside_a_ball(value: str) -> None:
    """Rounded outward, also where a double has few digits or none."""
    for radius in (0.0, 1e-20, 1e-3):
        with working(128, 1):
            ball = arb(value) * arb(1, radius)
            above, below = _above(ball), _below(ball)
            assert arb(above) >= ball.upper()
            assert arb(below) <= ball.lower() or below == 0
            assert above - float(ball.upper()) <= 4e-16 * above + 1e-322
            assert float(ball.lower()) - below <= 4e-16 * above + 1e-322
