"""Π(n, m) and Π(n, φ, m): balls beside quadrature, derivatives beside difference quotients, claims that need them."""

import random

import pytest
import sympy as sp
from flint import acb, arb

from canon.checker.formulas import Formulas
from canon.checker.points import Numbers
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.decide.derivative import derivative
from canon.decide.enclosure import REAL, OutOfDomain, evaluate, precision
from canon.decide.tape import Tape
from canon.errors import InputError
from canon.expression import Vocabulary, read
from canon.special import EllipticPi

N, PHI, M = sp.symbols("n phi m", real=True)
COMPLETE, INCOMPLETE = REAL["elliptic_pi"], REAL["elliptic_pii"]


def quadrature(n: arb, phi: arb, m: arb) -> arb:
    """The definition, enclosed by Arb's own quadrature: independent of its elliptic functions."""

    def integrand(theta: acb, _analytic: bool) -> acb:
        square = theta.sin() ** 2
        under = 1 - m * square
        return 1 / ((1 - n * square) * under.sqrt()) if under.real > 0 else acb("nan")

    return acb.integral(integrand, acb(0), acb(phi), rel_tol=arb(2) ** -60).real


def test_balls_contain_the_integral() -> None:
    rng = random.Random(5)
    with precision(96):
        for n, m in ((-30, 0.5), (-0.4, -7), (0.3, 0.9), (0.999, -0.2), (0.5, 0.5), (0, 0.25), (0.7, 0)):
            n, m = arb(n), arb(m)
            assert COMPLETE(n, m).overlaps(quadrature(n, arb.pi() / 2, m))
            for phi in (rng.uniform(-1.5, 1.5), rng.uniform(2, 9), -rng.uniform(2, 9)):
                assert INCOMPLETE(n, arb(phi), m).overlaps(quadrature(n, arb(phi), m)), (n, phi, m)
        short = arb("0.4")  # n > 1 or m > 1 is allowed as long as the path stays below the poles
        assert INCOMPLETE(arb(5), short, arb(0.3)).overlaps(quadrature(arb(5), short, arb(0.3)))
        assert INCOMPLETE(arb(0.3), short, arb(5)).overlaps(quadrature(arb(0.3), short, arb(5)))


def test_wide_balls_contain_the_values_inside() -> None:
    rng = random.Random(6)
    with precision(64):
        for _ in range(40):
            middle = [rng.uniform(-3, 0.9), rng.uniform(-4, 4), rng.uniform(-3, 0.9)]
            radius = rng.choice((1e-6, 1e-2, 0.08))
            try:
                wide = INCOMPLETE(*(arb(x, radius) for x in middle))
            except OutOfDomain:
                continue
            inner = [arb(x + rng.uniform(-1, 1) * radius * 0.99) for x in middle]
            assert wide.contains(INCOMPLETE(*inner).mid())
            assert COMPLETE(arb(middle[0], radius), arb(middle[2], radius)).contains(COMPLETE(inner[0], inner[2]).mid())


@pytest.mark.parametrize(
    "arguments", [(1, 0.5), (1.5, 0.5), (0.5, 1), (0.5, 2), (arb(0.95, 0.1), 0.5), (1, 2.0, 0.5), (0.5, 2.0, 1.2),
                  (3, 1.5, 0.1), (0.1, 1.5, 3)]
)  # fmt: skip
def test_no_principal_value_and_no_pole(arguments) -> None:
    rule = COMPLETE if len(arguments) == 2 else INCOMPLETE
    with pytest.raises(OutOfDomain):
        rule(*map(arb, arguments))


@pytest.mark.parametrize("formula", [EllipticPi(N, M), EllipticPi(N, PHI, M)])
@pytest.mark.parametrize(("n", "m"), [("-3/2", "2/5"), ("3/5", "-2"), ("1/7", "3/7")])
def test_derivatives(formula: sp.Expr, n: str, m: str) -> None:
    """The tape's rules, sympy's `fdiff` and the checker's table beside difference quotients of balls."""
    tape, checker, numbers = Tape(), Formulas(), Numbers()
    node = tape.load(formula)
    at = {N: sp.Rational(n), PHI: sp.Rational(7, 10), M: sp.Rational(m)}
    text = f"elliptic_pi({', '.join(map(str, formula.args))})"
    for symbol in formula.free_symbols:
        by_rule = derivative(tape, node, tape.symbol(symbol))
        by_sympy = tape.load(formula.diff(symbol))
        with precision(256):
            place = {tape.symbol(x): arb(int(v.p)) / int(v.q) for x, v in at.items()}
            balls = evaluate(tape, tape.reach([by_rule, by_sympy]), place)
            step, moved = arb(2) ** -80, tape.symbol(symbol)
            low, high = (
                evaluate(tape, tape.reach([node]), {**place, moved: place[moved] + s * step})[node] for s in (-1, 1)
            )
            assert abs((high - low) / (2 * step) - balls[by_rule]) < 1e-20
            assert abs(balls[by_sympy] - balls[by_rule]) < 1e-60
        by_checker = checker.slope(checker.read(text, {}), str(symbol))
        of = {str(x): numbers.mp.mpf(int(v.p)) / int(v.q) for x, v in at.items()}
        found = numbers.values(checker, [by_checker], of)[by_checker]
        assert abs(found - numbers.mp.mpf(balls[by_rule].str(40, radius=False))) < 1e-30


CASES = [
    ("n<1; m<1", "D(D(elliptic_pi(n, m), n), m)", "D(D(elliptic_pi(n, m), m), n)", "proved"),
    ("n<1; m<1", "D(D(elliptic_pi(n, u, m), n), u)", "D(D(elliptic_pi(n, u, m), u), n)", "proved"),
    ("n<1; m<1", "D(D(elliptic_pi(n, u, m), m), u)", "1001/1000*D(D(elliptic_pi(n, u, m), u), m)", "refuted"),
    ("n<1; m<1", "D(elliptic_pi(n, m), m)", "1001/1000*D(elliptic_pi(n, m), m)", "refuted"),
    ("m<1", "elliptic_pi(m, m)", "elliptic_e(m)/(1 - m)", "proved"),
    ("m<1", "elliptic_pi(m, u, m)", "(elliptic_e(u, m) - m*sin(u)*cos(u)/sqrt(1-m*sin(u)**2))/(1 - m)", "proved"),
    ("m<1", "D(elliptic_pi(m, m), m)", "D(elliptic_e(m)/(1 - m), m)", "proved"),
    ("m<1", "elliptic_pi(0, u, m) + elliptic_pi(0, m)", "elliptic_f(u, m) + elliptic_k(m)", "proved"),
    ("n<1; m<1", "elliptic_pi(n/(n-1), m/(m-1))", "(1-n)*sqrt(1-m)*elliptic_pi(n, m)", "proved"),
    ("n<1; m<1", "elliptic_pi(n/(n-1), m/(m-1))", "(1+n)*sqrt(1-m)*elliptic_pi(n, m)", "refuted"),
    ("n<1; m<1", "elliptic_pi(n, m)", "elliptic_pi(m, n)", "refuted"),
    ("n<1", "elliptic_pi(n, 0)", "pi/2/sqrt(1 - n)", "proved"),
    ("n<1", "elliptic_pi(n, u, 0)", "atan(sqrt(1-n)*tan(u))/sqrt(1-n)", "refuted"),  # beyond pi/2 they part
    ("n<1; -pi/2<u<pi/2", "elliptic_pi(n, u, 0)", "atan(sqrt(1-n)*tan(u))/sqrt(1-n)", "proved"),
]  # fmt: skip


@pytest.mark.parametrize(("where", "left", "right", "verdict"), CASES)
def test_claims(where: str, left: str, right: str, verdict: str) -> None:
    text = f"""
[phase_space]
q = ["u"]
p = ["v"]
[symbols]
n = "real"
m = "real"
[domain]
where = [{", ".join(f'"{c.strip()}"' for c in where.split(";"))}]
[[claim]]
kind = "identity"
lhs = "{left}"
rhs = "{right}"
"""
    (claim,) = read_text(text).claims
    assert verify(claim).status == verdict


def test_pole_everywhere_is_an_input_error() -> None:
    text = '[phase_space]\nq = ["u"]\np = ["v"]\n[symbols]\nm = "real"\n[[claim]]\nkind = "identity"\n'
    (claim,) = read_text(text + 'lhs = "elliptic_pi(2, m)"\nrhs = "1"\n').claims
    with pytest.raises(InputError):
        verify(claim)


def test_sympys_own_class_is_taken_for_ours() -> None:
    from canon.mechanics.formulas import as_expression

    assert as_expression(sp.elliptic_pi(N, PHI, M)) == EllipticPi(N, PHI, M)
    assert read("elliptic_pi(n, phi, 0)", Vocabulary({"n": N, "phi": PHI})).expr == EllipticPi(N, PHI, 0)
    assert sp.latex(EllipticPi(N, M) ** 2) == r"\Pi\left(n\middle| m\right)^{2}"
