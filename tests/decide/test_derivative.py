"""The tape's derivatives of all functions, by each of their arguments, beside difference quotients of balls."""

from fractions import Fraction

import pytest
import sympy as sp
from flint import arb

from canon.decide.arbitrary import rational
from canon.decide.derivative import derivative, poisson_bracket
from canon.decide.enclosure import evaluate, precision
from canon.decide.tape import Tape
from canon.special import EllipticPi, JacobiCN, JacobiDN, JacobiEpsilon, JacobiSN

x, y, m, n = NAMES = sp.symbols("x y m n", real=True)
POINT = {x: Fraction(7, 10), y: Fraction(-9, 7), m: Fraction(2, 5), n: Fraction(-3, 8)}
FUNCTIONS = [
    sp.sin(x * m), sp.cos(x**2 + y), sp.exp(x * y), sp.log(x * m), sp.Abs(x * y), sp.atan(x * y), sp.asin(x * m),
    sp.acos(x * m), sp.atan2(x, y), sp.atan2(y * m, x * n), sp.sqrt(1 + x**2 * m), (x * m) ** sp.Rational(-7, 3),
    x**3 / y**2 * m, sp.LambertW(x), sp.elliptic_k(m * x), sp.elliptic_e(m * x), sp.elliptic_f(x, m),
    sp.elliptic_e(x, m), EllipticPi(n, m), EllipticPi(n, x, m), JacobiSN(x, m), JacobiCN(x, m), JacobiDN(x, m),
    JacobiEpsilon(x, m), sp.sinh(x * m) + sp.tan(x) / sp.acosh(3 + x), sp.sign(y) * sp.asinh(x) + sp.atanh(m),
]  # fmt: skip


@pytest.mark.parametrize("function", FUNCTIONS, ids=str)
def test_a_derivative_is_the_limit_of_difference_quotients(function: sp.Expr):
    """Of f, and of its derivatives: so the rules that stand in rules are asked too."""
    tape = Tape()
    node = tape.load(function)
    names = [tape.symbol(s) for s in NAMES if s in function.free_symbols]
    cases = [(node, name) for name in names] + [(derivative(tape, node, a), b) for a in names for b in names]
    step = arb(2) ** -80
    with precision(320):
        place = {tape.symbol(s): arb(rational(v)) for s, v in POINT.items()}
        for f, name in cases:
            slope = derivative(tape, f, name)
            low, high = (evaluate(tape, tape.reach([f]), {**place, name: place[name] + k * step})[f] for k in (-1, 1))
            found = evaluate(tape, tape.reach([slope]), place)[slope]
            assert found.rad() < 1e-40
            assert abs((high - low) / (2 * step) - found) < 1e-30 * (1 + abs(found))


@pytest.mark.parametrize("factor", [1, sp.Rational(1001, 1000)])
def test_the_bracket_is_that_of_the_derivatives(factor):
    """{x²m + y³, x m² n + y n} in the pairs (x, m), (y, n), by hand."""
    tape = Tape()
    f, g = tape.load(x**2 * m + y**3), tape.load(x * m**2 * n + y * n)
    found = poisson_bracket(tape, f, g, [tape.symbol(x), tape.symbol(y)], [tape.symbol(m), tape.symbol(n)])
    expected = 2 * x * m * 2 * x * m * n - x**2 * factor * m**2 * n + 3 * y**2 * (x * m**2 + y)
    with precision(128):
        place = {tape.symbol(s): arb(rational(v)) for s, v in POINT.items()}
        difference = tape.minus(found, tape.load(expected))
        ball = evaluate(tape, tape.reach([difference]), place)[difference]
    assert ball.contains(0) == (factor == 1)
