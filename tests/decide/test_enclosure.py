"""Balls of functions and powers contain the true values, and are refused where the function isn't defined."""

from fractions import Fraction

import mpmath as mp
import pytest
import sympy as sp
from flint import arb

from canon.decide.enclosure import OutOfDomain, _integer_power, evaluate, precision
from canon.decide.tape import Tape, Unsupported

x, y, n = sp.Symbol("x", real=True), sp.Symbol("y", real=True), sp.Symbol("n", integer=True)


def ball(f: sp.Expr, place: dict[sp.Symbol, object]) -> arb:
    tape = Tape()
    node = tape.load(f)
    at = {tape.load(name): value for name, value in place.items()}
    with precision(128):
        return evaluate(tape, tape.reach([node]), at)[node]


@pytest.mark.parametrize("exponent", [-3, -1, 0, 1, 2, 5])
@pytest.mark.parametrize("middle", [Fraction(-7, 3), Fraction(1, 5)])
def test_whole_powers_of_thin_and_of_thick_balls(exponent: int, middle: Fraction):
    with precision(128):
        centre = arb(middle.numerator) / middle.denominator
        for radius in (0, Fraction(1, 100)):
            thick = arb(centre, float(radius))
            found = _integer_power(thick, arb(exponent))
            for end in (middle - radius, middle, middle + radius):
                exact = end**exponent
                assert found.contains(arb(exact.numerator) / exact.denominator) or found.overlaps(
                    arb(exact.numerator) / exact.denominator
                )
            assert float(found.rad()) < (1e-30 if not radius else 500)


def test_powers_that_are_not_known_to_be_whole():
    for exponent in (arb(1) / 2, arb(2, 0.5), arb(10**5)):
        with pytest.raises(OutOfDomain):
            _integer_power(arb(2), exponent)
    with pytest.raises(OutOfDomain, match="denominator"):
        _integer_power(arb(0, 1), arb(-1))


@pytest.mark.parametrize(
    ("f", "inside", "outside"),
    [
        (sp.asin(x), {x: arb("0.5")}, {x: arb(1, 0.1)}),
        (sp.Abs(x), {x: arb(-2)}, {x: arb(0, 1)}),
        (sp.sign(x), {x: arb(-2)}, {x: arb(0, 1)}),
        (sp.log(x), {x: arb(3)}, {x: arb(0, 1)}),
        (sp.sqrt(x), {x: arb(3)}, {x: arb(0, 1)}),
        (sp.LambertW(x), {x: arb("-0.25")}, {x: arb("-0.5")}),
        (sp.elliptic_k(x), {x: arb("0.5")}, {x: arb(1)}),
        (sp.elliptic_f(y, x), {y: arb(2), x: arb("0.5")}, {y: arb(2), x: arb("1.5")}),
        (sp.atan2(y, x), {y: arb(1), x: arb(-1)}, {y: arb(0, 1), x: arb(-1)}),
        (sp.acosh(x), {x: arb(2)}, {x: arb(1, 0.5)}),
        (1 / x, {x: arb(2)}, {x: arb(0, 1)}),
        (x ** sp.Rational(-2, 3), {x: arb(3)}, {x: arb(-1)}),
        (sp.atan2(y, x), {y: arb("-0.5"), x: arb(-1)}, {y: arb(0, 0.001), x: arb(-1)}),
        (sp.elliptic_f(y, x), {y: arb("0.5"), x: arb("1.5")}, {y: arb("0.99"), x: arb("1.5")}),  # x sin² y = 1.05
        (sp.elliptic_e(y, x), {y: arb("0.5"), x: arb("1.5")}, {y: arb("0.99"), x: arb("1.5")}),
    ],
)
def test_functions_inside_and_outside_of_their_domain(f: sp.Expr, inside: dict, outside: dict):
    with mp.workdps(40):
        exact = mp.mpf(
            str(sp.N(f.xreplace({k: sp.Rational(str(v.mid().str(20, radius=False))) for k, v in inside.items()}), 35))
        )
        assert ball(f, inside).overlaps(arb(str(exact)) + arb(0, 1e-30))
    assert float(ball(f, inside).rad()) < 1e-25
    with pytest.raises((OutOfDomain, ZeroDivisionError)):
        ball(f, outside)


def test_an_arbitrary_function_that_was_not_chosen():
    tape = Tape()
    node = tape.load(sp.Function("V", real=True)(x))
    for functions in (None, {}):
        with pytest.raises(Unsupported, match="arbitrary function V"):
            evaluate(tape, tape.reach([node]), {tape.symbol(x): arb(1)}, functions)
