"""Enclosed integrals contain what quadrature gives: of analytic functions, and of moduli that don't vanish."""

from fractions import Fraction

import mpmath
import pytest
import sympy as sp
from flint import acb, arb

from canon.decide.ball_quadrature import enclosed
from canon.decide.enclosure import precision
from canon.decide.tape import Tape

x, y = sp.symbols("x y", real=True)
z = sp.Symbol("z")
FORMULAS = [
    x**2 - y * x, sp.exp(-(x**2)) * sp.cos(y), 1 / (1 + x**2), sp.sqrt(2 + x), sp.Abs(x + 4),
    sp.Abs(x - 5) * sp.Abs(y * x - 9),
    sp.log(4 + x * y), sp.sin(20 * x) / (x + 3), sp.Abs(x + 4) ** 3 * sp.sign(x - 7),
]  # fmt: skip


@pytest.mark.parametrize("formula", FORMULAS, ids=str)
@pytest.mark.parametrize("ends", [(-1, 2), (Fraction(3, 2), Fraction(-1, 3))])
def test_an_integral_is_enclosed(formula: sp.Expr, ends: tuple):
    tape = Tape()
    low, high = (arb(Fraction(e).numerator) / Fraction(e).denominator for e in ends)
    with precision(96):
        found = enclosed(tape, tape.load(formula), tape.symbol(x), (low, high), {tape.symbol(y): arb(3) / 4})
    f = sp.lambdify(x, formula.subs(y, sp.Rational(3, 4)), "mpmath")
    exact = mpmath.quad(f, mpmath.linspace(*map(float, ends), 9))
    assert found is not None
    assert found.rad() < 1e-10
    assert abs(found - arb(str(exact))) < 1e-10


@pytest.mark.parametrize(
    "formula", [1 / x, sp.log(x), sp.Abs(z + x), sp.sqrt(x), 1 / (x - sp.Rational(1, 3)) ** 2], ids=str
)
def test_what_is_not_analytic_there_is_refused(formula: sp.Expr):
    tape = Tape()
    place = {tape.symbol(z): acb(1, 2)}
    assert enclosed(tape, tape.load(formula), tape.symbol(x), (arb(-1), arb(2)), place) is None


def test_complex_values():
    tape = Tape()
    found = enclosed(tape, tape.load(sp.exp(sp.I * x)), tape.symbol(x), (arb(0), arb.pi()), {})
    assert abs(found - acb(0, 2)) < 1e-10
