"""What is loaded has the value that sympy gives, at points; what has no such value is refused."""

import random
from fractions import Fraction

import pytest
import sympy as sp
from flint import acb, arb

from canon.decide.arbitrary import choose_functions, rational
from canon.decide.derivative import derivative
from canon.decide.enclosure import evaluate, precision
from canon.decide.series import algebra, constant_term
from canon.decide.series_program import run_series, working
from canon.decide.tape import Tape, Unsupported
from canon.decide.tape_program import program_of
from canon.special import EllipticPi, JacobiCN, JacobiDN, JacobiEpsilon, JacobiSN

x, y, m = sp.symbols("x y m", real=True)
z = sp.Symbol("z")
k, even = sp.Symbol("k", integer=True), sp.Symbol("l", even=True)
n = sp.Symbol("n", integer=True, positive=True)
POINT = {x: sp.Rational(7, 10), y: sp.Rational(-9, 7), m: sp.Rational(2, 5), k: 3, even: -4, n: 2}
PLACE = POINT | {z: sp.Rational(1, 3) - sp.I * sp.Rational(5, 4)}
FORMULAS = [
    x**2 - 3 / y + sp.sqrt(-y) * x ** sp.Rational(-5, 3), sp.pi**2 * x + sp.E * y, sp.exp(x) * sp.E**y, x**y, 2**x,
    sp.sinh(x) - 2 * sp.cosh(y), sp.tanh(x) + sp.coth(y), sp.sech(x) * sp.csch(y), sp.tan(x) - sp.cot(y),
    sp.sec(x) / sp.csc(y), sp.asinh(x), sp.acosh(2 + x), sp.atanh(x), sp.asin(x) + sp.acos(x / 2) - sp.atan(y),
    sp.atan2(x, y) - sp.atan2(y, x), sp.Abs(y) ** 3 + sp.sign(y) * x, sp.log(x, 3) + sp.log(m), sp.gamma(x),
    sp.LambertW(m) * sp.elliptic_k(m) + sp.elliptic_e(m) + sp.elliptic_f(x, m) + sp.elliptic_e(x, m), (-3) ** k + y**k,
    y ** (-n) * 3**n,
    y ** (2 * n + k - 1), y ** (even / 2), sp.Rational(-2, 3) ** (2 * k - n), (-x) ** (1 - 2 * n),
    sp.sqrt(z) + z ** sp.Rational(-2, 3), sp.log(z) * sp.exp(z), sp.sin(z) + sp.cos(z * x), sp.asin(sp.I * x),
    sp.acos(2 + sp.I * x), sp.atan(x + sp.I), sp.Abs(x + sp.I * y), sp.re((x + sp.I * y) ** 3), sp.acosh(sp.I * x + y),
    sp.conjugate(sp.exp(x + sp.I * y)) * sp.I**3, sp.Abs(sp.I * x - y**2) ** -3,
]  # fmt: skip


@pytest.mark.parametrize("formula", FORMULAS, ids=str)
def test_a_formula_has_its_value(formula: sp.Expr):
    tape = Tape()
    node = tape.load(formula)
    with precision(128):
        place = {}
        for name in formula.free_symbols:
            re, im = sp.sympify(PLACE[name]).as_real_imag()
            ball = arb(int(re.p)) / int(re.q)
            place[tape.symbol(name)] = acb(ball, arb(int(im.p)) / int(im.q)) if name == z else ball
        found = complex(evaluate(tape, tape.reach([node]), place)[node])
    expected = complex(formula.subs(PLACE).evalf(30))
    assert found == pytest.approx(expected, rel=1e-13, abs=1e-13)


SPECIAL = [  # by another formula of the same value (DLMF 19.6, 22.5)
    (EllipticPi(0, m), sp.elliptic_k(m)), (EllipticPi(0, x, m), sp.elliptic_f(x, m)),
    (EllipticPi(x, 0), sp.pi / 2 / sp.sqrt(1 - x)), (EllipticPi(m, m), sp.elliptic_e(m) / (1 - m)),
    (EllipticPi(m, x, m), (sp.elliptic_e(x, m) - m * sp.sin(2 * x) / 2 / sp.sqrt(1 - m * sp.sin(x) ** 2)) / (1 - m)),
    (JacobiSN(x, 0), sp.sin(x)), (JacobiCN(x, 0), sp.cos(x)), (JacobiDN(x, 0), 1), (JacobiEpsilon(x, 0), x),
    (JacobiSN(x, 1), sp.tanh(x)), (JacobiCN(x, 1), sp.sech(x)), (JacobiDN(x, 1), sp.sech(x)),
    (JacobiEpsilon(x, 1), sp.tanh(x)),
]  # fmt: skip


@pytest.mark.parametrize(("function", "other"), SPECIAL, ids=str)
def test_special_values_are_those_of_balls_nearby(function: sp.Expr, other):
    tape = Tape()
    node = tape.load(function)
    with precision(128):
        place = {tape.symbol(s): arb(int(POINT[s].p)) / int(POINT[s].q) for s in (x, m)}
        found = complex(evaluate(tape, tape.reach([node]), place)[node])
    assert found == pytest.approx(complex(sp.sympify(other).subs(POINT).evalf(30)), rel=1e-13)


u, V, W = sp.Function("u"), sp.Function("V"), sp.Function("W")


@pytest.mark.parametrize(
    ("written", "function"),
    [
        (V(u(x)).diff(u(x)) * u(x).diff(x), V(u(x))),
        (V(u(x)).diff(u(x), 2) * u(x).diff(x) ** 2 + V(u(x)).diff(u(x)) * u(x).diff(x, 2), V(u(x)).diff(x)),
        (W(u(x), y).diff(u(x)) * u(x).diff(x), W(u(x), y)),
        (V(x * y).diff(x), V(x * y)),
        (sp.Subs(V(y).diff(y), y, 3 * x) * 3, V(3 * x)),
    ],
    ids=str,
)
def test_the_derivative_of_an_arbitrary_function_by_its_argument(written: sp.Expr, function: sp.Expr):
    """By the chain rule it makes the derivative by x: with concrete functions, at a point."""
    tape = Tape()
    node, other = tape.load(written), derivative(tape, tape.load(function), tape.symbol(x))
    order = tape.reach([node, other])
    with precision(256):
        place = {tape.symbol(s): arb(rational_of(POINT[s])) for s in (x, y)}
        balls = evaluate(tape, order, place, choose_functions(tape, order, random.Random(1)))
        assert abs(balls[node] - balls[other]) < 1e-9
        assert abs(balls[node]) > 1e-3


def rational_of(value: sp.Rational):
    return rational(Fraction(int(value.p), int(value.q)))


REFUSED = [
    sp.Derivative(W(u(x), V(x)), u(x), V(x)), sp.Derivative(V(2 * u(x)), u(x)), sp.Derivative(W(u(x), u(x)), u(x)),
    sp.Derivative(V(x), (x, k)), sp.Symbol("A", commutative=False), sp.Function("f", positive=True)(x),
    sp.Float("0.5") * x, sp.Piecewise((x, x > 0), (y, True)), sp.zeta(x), sp.oo, sp.sign(x + sp.I * y),
]  # fmt: skip


@pytest.mark.parametrize("formula", REFUSED, ids=str)
def test_what_there_is_no_exact_operation_for_is_refused(formula):
    with pytest.raises(Unsupported):
        Tape().load(formula)


PROGRAMS = [
    (x**2 / y - 3 * x * m + 2, sp.sqrt(x) * sp.exp(-x * y) ** 3), (sp.sin(x) * sp.cos(y) + sp.pi * m, sp.log(x) / 7),
    (sp.atan2(y, x) - sp.Abs(y) ** sp.Rational(5, 3), sp.asin(x) - sp.acos(m) + sp.atan(y)),
    (sp.sinh(x) + x ** sp.Rational(-2, 3), sp.Integer(5)),
]  # fmt: skip


@pytest.mark.parametrize("formulas", PROGRAMS, ids=str)
def test_a_program_of_formulas_has_their_values(formulas: tuple[sp.Expr, ...]):
    """As series in balls of degree 0, with a number in the place of m."""
    tape = Tape()
    values = {tape.symbol(m): Fraction(2, 5)}
    program = program_of(tape, [tape.load(f) for f in formulas], [tape.symbol(y), tape.symbol(x)], values)
    space = algebra(2, 1)
    with working(96, 1):
        inputs = [space.variable(k, arb(rational_of(POINT[s])), arb(1)) for k, s in enumerate((y, x))]
        found = [float(constant_term(value).mid()) for value in run_series(program, inputs, space)]
    assert found == pytest.approx([float(f.subs(POINT)) for f in formulas], rel=1e-13)


@pytest.mark.parametrize("formula", [x + z, sp.I * x, sp.Function("V")(x), sp.gamma(x), sp.elliptic_k(x)], ids=str)
def test_what_has_no_program_is_refused(formula: sp.Expr):
    tape = Tape()
    with pytest.raises(Unsupported):
        program_of(tape, [tape.load(formula)], [tape.symbol(x)], {})
