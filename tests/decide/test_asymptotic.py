"""Expansions near 0+ leave an error of the order that they say; tails to infinity contain the integral.

Known truth: Arb's balls of the formula itself at a small s, and mpmath's quadrature of it.
"""

from fractions import Fraction

import mpmath
import pytest
import sympy as sp
from flint import arb

from canon.decide.asymptotic import Expander, Ramified, expand
from canon.decide.enclosure import evaluate, precision
from canon.decide.growth import growth, tamed
from canon.decide.power_series import Unexpanded
from canon.decide.tails import tail_of
from canon.decide.tape import Tape

s = sp.Symbol("s", positive=True)
x = sp.Symbol("x", positive=True)
pi, sqrt, sin, cos, exp, log, atan, asin, acos, atan2 = (
    sp.pi, sp.sqrt, sp.sin, sp.cos, sp.exp, sp.log, sp.atan, sp.asin, sp.acos, sp.atan2,
)  # fmt: skip
TERMS = 6
EXPANSIONS = [
    1 / (s**2 - 2 * s) + s**3, (1 + 3 * s) ** sp.Rational(-7, 3), sqrt(4 + s) / sqrt(9 - s**2), sqrt(s**2 + s**3),
    (1 + 2 * s) ** -3 * (2 - s) ** 2, sin(2 * s + 1) - cos(3 * s), sin(pi / 2 + s) + cos(s - pi) / s, exp(2 * s) / s**3,
    log(3 * s + s**2) * s, log(2 + s), s**2 * log(s) ** 2, atan(2 * s), atan(1 / s), atan(-3 / s**2 + 1),
    atan(2 + s) / s,
    asin(s / 2), acos(sp.Rational(1, 3) + s), asin(1 - s**2), acos(s**2 - 1), atan2(s, 2 - s), atan2(2, s), atan2(s,
    -1),
    atan2(-s, -2 + s), sp.Abs(s - 2) * sp.Abs(s**2 - s), sp.elliptic_k(s), sp.elliptic_e(s), sp.elliptic_k(s - 2),
    sp.elliptic_e(sp.Rational(1, 2) - s), sp.elliptic_f(1 + s, sp.Rational(1, 3)), sp.elliptic_e(s, sp.Rational(1, 4)),
    sp.tan(s + 1), sp.tanh(s) / s, exp(-1 / s) + s, exp(-1 / s**2) / s**5 + 1, sin(s) ** 2 / (1 - cos(s)),
    s * sin(1 / s) + s**3,
    atan((1 + s) / s**2 - 1 / s**2), exp(1 / s**2 - (1 + s) / s**2) / s + s,
    (exp(s) - 1 - s) / s**2, 1 / (sin(s) - s), sqrt(1 + s) - sqrt(1 - s), log(1 + s) / log(1 + 2 * s),
]  # fmt: skip


def sign_of(tape: Tape):
    def found(node):
        value = tape.value(node)
        if value is None:
            with precision(256):
                ball = evaluate(tape, tape.reach([node]), {})[node]
            return "pos" if ball > 0 else "neg" if ball < 0 else "zero" if abs(ball) < 1e-60 else None
        return "zero" if value == 0 else "pos" if value > 0 else "neg"

    return found


@pytest.mark.parametrize("formula", EXPANSIONS, ids=str)
def test_an_expansion_is_right_to_its_order(formula: sp.Expr):
    tape = Tape()
    node, name = tape.load(formula), tape.symbol(s)
    ((series,), root, expander) = expand(tape, [node], name, sign_of(tape), TERMS)
    assert len(series.coefficients) >= TERMS - 3
    for bits in (40, 60):
        with precision(1024):
            small = arb(2) ** -bits
            place = {
                name: small**root,
                expander.log: small.log(),
                **{wave: (1 / small).sin() for wave in expander.waves},
            }
            total = sum(
                (
                    evaluate(tape, tape.reach([c]), place)[c] * small ** (series.start + k)
                    for k, c in enumerate(series.coefficients)
                ),
                arb(0),
            )
            exact = evaluate(tape, tape.reach([node]), place)[node]
            # up to the first power that is left out, with logarithms
            assert abs(exact - total) < small**series.end * 2**20


@pytest.mark.parametrize(
    ("formula", "root"),
    [(sqrt(s) + s, 2), (s ** sp.Rational(1, 3) + 1 + s, 3), (1 / sqrt(s) + s ** sp.Rational(1, 3), 6)],
    ids=str,
)
def test_fractional_powers_have_the_smallest_root_that_serves(formula: sp.Expr, root: int):
    tape = Tape()
    with pytest.raises(Ramified):
        Expander(tape, tape.symbol(s), sign_of(tape), TERMS).of(tape.load(formula))
    (series,), found, _ = expand(tape, [tape.load(formula)], tape.symbol(s), sign_of(tape), TERMS)
    assert found == root
    with precision(256):
        small = arb(2) ** -30
        total = sum(
            (arb(str(tape.value(c))) * small ** (series.start + k) for k, c in enumerate(series.coefficients)), arb(0)
        )
        exact = evaluate(tape, tape.reach([tape.load(formula)]), {tape.symbol(s): small**root})[tape.load(formula)]
        assert abs(exact - total) < small**series.end * 2**10


REFUSED = [
    exp(1 / s), log(-s + s**2), sqrt(s**2 - s), sp.gamma(s), acos(1 + s), sp.elliptic_k(1 - s), sp.elliptic_k(1 / s),
    asin(s - 2), acos(s + sp.Rational(3, 2)), sp.elliptic_f(sp.Rational(1, 3), s / 2), sp.elliptic_e(2 + s),
    sp.elliptic_f(s, 2),
]  # fmt: skip


@pytest.mark.parametrize("formula", REFUSED, ids=str)
def test_what_has_no_such_expansion_is_refused(formula: sp.Expr):
    tape = Tape()
    with pytest.raises(Unexpanded):
        expand(tape, [tape.load(formula)], tape.symbol(s), sign_of(tape), TERMS)


TAMED = [
    (sp.cosh(1 / s) - sp.sinh(1 / s), "neg"), (sp.cosh(1 / s) + sp.sinh(2 / s), "pos"), (sp.tanh(1 / s), "zero"),
    (exp(1 / s + 3) / (exp(1 / s) + exp(-1 / s)), "zero"), (sqrt(exp(2 / s) + exp(1 / s)) * exp(-1 / s), "zero"),
    (exp(1 / s) ** 3 * (1 + exp(-1 / s)) ** -4, "pos"), (log(exp(1 / s) + 1) * s, "zero"),
    (exp(-1 / s**2) * exp(1 / s), "neg"),
    (atan(exp(1 / s)) - atan(-exp(1 / s)), "zero"), (sp.Abs(exp(1 / s) - exp(2 / s)), "pos"), (s**3 + 1 / s, "zero"),
    ((exp(1 / s) - exp(-1 / s)) ** 2 - exp(2 / s), "zero"),
]  # fmt: skip


@pytest.mark.parametrize(("formula", "direction"), TAMED, ids=str)
def test_the_largest_exponential_is_taken_out_exactly(formula: sp.Expr, direction: str):
    tape = Tape()
    node, name = tape.load(formula), tape.symbol(s)
    expander = Expander(tape, name, sign_of(tape), TERMS)
    found = tamed(expander, node)
    assert growth(expander, found.exponent) == direction
    together = tape.times(tape.call("exp", found.exponent), found.rest)
    with precision(512):
        for at in (Fraction(1, 3), Fraction(1, 17)):
            place = {name: arb(at.numerator) / at.denominator}
            balls = evaluate(tape, tape.reach([node, together, found.rest]), place)
            assert abs(balls[node] - balls[together]) < abs(balls[node]) * 1e-60
    with precision(4000):
        place = {name: arb(2) ** -8}
        rest = evaluate(tape, tape.reach([found.rest]), place)[found.rest]
        assert 1e-30 < abs(rest) < 1e30, "what is left neither grows nor falls as an exponential does"


def test_a_tail_that_may_still_rise_is_not_bounded():
    """x¹⁰ exp(−x) rises up to x = 10."""
    tape = Tape()
    tail = tail_of(tape, tape.load(x**10 * exp(-x)), tape.symbol(x), tape.symbol(s), sign_of(tape))
    assert tail.beyond(7, 64) is None
    assert tail.beyond(40, 64).overlaps(arb(str(mpmath.gammainc(11, 40))))


TAILS = [  # a function of x, and how wide its tail's ball may be, against the tail
    (1 / x**2, 1e-6), (3 / (x**2 + 1), 0.2), (1 / (x**3 - x), 0.2), (x ** sp.Rational(-5, 2), 1e-6),
    (-2 / (x + 1) ** 3, 0.5),
    (sqrt(x) / (x**2 + 1), 0.2), (atan(1 / x) / x, 1.1), (cos(1 + 1 / x) / x**2, 1), (atan(2 - 1 / x) / x**2, 1),
    (exp(1 / x - 1) / x**2, 1), (sin(1 / x) / x**2, 1.1), (log(x) / x**3, 9),
    (cos(1 / x) / x**4, 0.1),
    (log(1 + 1 / x) / x**2, None), (exp(1 / x) / x**2, 0.5), (sp.Abs(1 - x) / x**4, 0.3), (sin(x) / x**3, None),
    (exp(-x), None),
    (x**2 * exp(-x), None), (exp(-(x**2)) * cos(x), None), (exp(-2 * x) * log(x), None), (exp(-x / 2) / sqrt(x), None),
    (sp.sech(x), None), (log(x) * cos(x) / x**2, None),
]  # fmt: skip


@pytest.mark.parametrize(("function", "width"), TAILS, ids=str)
def test_a_tail_contains_the_integral(function: sp.Expr, width: float | None):
    tape = Tape()
    tail = tail_of(tape, tape.load(function), tape.symbol(x), tape.symbol(s), sign_of(tape))
    f = sp.lambdify(x, function, "mpmath")
    for edge in (7, 40):
        ball = tail.beyond(edge, 64)
        assert ball is not None
        assert ball.is_finite()
        if function.has(sin(x)) or function.has(cos(x)):
            exact = sum(mpmath.quad(f, [edge + k * mpmath.pi, edge + (k + 1) * mpmath.pi]) for k in range(30))
        else:
            exact = mpmath.quad(f, [edge, 2 * edge, 4 * edge, 10 * edge, mpmath.inf])
        assert arb(str(exact), float(1e-9 * abs(exact))).overlaps(ball)
        if width is not None:
            assert float(ball.rad()) <= width * abs(exact)


@pytest.mark.parametrize(
    "function", [1 / x, 1 / (x + 1), x ** sp.Rational(-1, 2), sin(x) / x, exp(x), 1 + exp(-x)], ids=str
)
def test_no_tail_where_the_integral_is_infinite_or_not_absolutely_convergent(function: sp.Expr):
    tape = Tape()
    tail = tail_of(tape, tape.load(function), tape.symbol(x), tape.symbol(s), sign_of(tape))
    assert tail.beyond(7, 64) is None
