"""Jacobi's functions: balls at every real parameter beside mpmath, derivatives in u and m, claims that need them."""

import random

import mpmath
import pytest
import sympy as sp
from flint import arb

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.decide.derivative import derivative
from canon.decide.enclosure import evaluate, precision
from canon.decide.jacobi import jacobi
from canon.decide.tape import Tape
from canon.special import JacobiCN, JacobiDN, JacobiEpsilon, JacobiSN

PARAMETERS = (-100, -0.5, -1e-6, 0, 0.3, 0.99, 1, 1 + 1e-6, 4)
CLASSES = {"sn": JacobiSN, "cn": JacobiCN, "dn": JacobiDN, "epsilon": JacobiEpsilon}


def _reference(which: str, u, m):
    """By mpmath's own functions; epsilon by quadrature of dn²."""
    if which != "epsilon":
        return mpmath.re(mpmath.ellipfun(which, u, m=m))
    return mpmath.quad(lambda t: mpmath.re(mpmath.ellipfun("dn", t, m=m)) ** 2, mpmath.linspace(0, u, 4))


@pytest.mark.parametrize("m", PARAMETERS)
def test_balls_contain_what_mpmath_computes(m):
    rng = random.Random(m)
    with mpmath.workdps(15), precision(96):
        for _ in range(2):
            u = rng.uniform(-4, 4) / (1 + abs(m)) ** 0.5
            for which in CLASSES:
                ball = jacobi(which)(arb(u), arb(m))
                assert abs(ball - arb(mpmath.nstr(_reference(which, mpmath.mpf(u), mpmath.mpf(m)), 15))) < 1e-10, which


def test_balls_of_wide_balls_contain_the_values_inside():
    with precision(64):
        wide = {which: jacobi(which)(arb(0.5, 0.01), arb(-0.5, 0.01)) for which in CLASSES}
        for u, m in ((0.491, -0.509), (0.509, -0.491), (0.5, -0.5)):
            assert all(wide[which].contains(jacobi(which)(arb(u), arb(m)).mid()) for which in CLASSES)
        assert jacobi("sn")(arb(0.5), arb(0, 0.01)) is None
        assert jacobi("sn")(arb(0.5), arb(1, 0.01)) is None


@pytest.mark.parametrize("which", CLASSES)
@pytest.mark.parametrize("argument", [0, 1])
@pytest.mark.parametrize("m", ["-3/2", "2/5", "7/3"])
def test_derivatives_in_u_and_m(which, argument, m):
    """The tape's rule and sympy's `fdiff` beside a difference quotient of balls, for each function and argument."""
    u_symbol, m_symbol = sp.symbols("u m", real=True)
    formula = CLASSES[which](u_symbol, m_symbol)
    tape = Tape()
    node = tape.load(formula)
    by_rule = derivative(tape, node, tape.symbol((u_symbol, m_symbol)[argument]))
    by_sympy = tape.load(formula.diff((u_symbol, m_symbol)[argument]))
    with precision(256):
        place = {tape.symbol(u_symbol): arb(7) / 10, tape.symbol(m_symbol): arb(sp.Rational(m).p) / sp.Rational(m).q}
        balls = evaluate(tape, tape.reach([by_rule, by_sympy]), place)
        step = arb(2) ** -80
        ends = [dict(place), dict(place)]
        moved = tape.symbol((u_symbol, m_symbol)[argument])
        ends[0][moved] -= step
        ends[1][moved] += step
        low, high = (evaluate(tape, tape.reach([node]), end)[node] for end in ends)
        assert abs((high - low) / (2 * step) - balls[by_rule]) < 1e-20
        assert abs(balls[by_sympy] - balls[by_rule]) < 1e-60


CLAIMS = [
    ("m<0", "jacobi_sn(u,m)**2+jacobi_cn(u,m)**2", "1", "proved"),
    ("m<0", "jacobi_sn(u,m)**2+jacobi_cn(u,m)**2", "1001/1000", "refuted"),
    ("m>1", "jacobi_dn(u,m)", "sqrt(1-m*jacobi_sn(u,m)**2)", "refuted"),
    ("0<m<1", "jacobi_dn(u,m)", "sqrt(1-m*jacobi_sn(u,m)**2)", "proved"),
    ("0<m<1", "jacobi_cn(u,m)", "sqrt(1-jacobi_sn(u,m)**2)", "refuted"),
    ("0<m<1", "abs(jacobi_cn(u,m))", "sqrt(1-jacobi_sn(u,m)**2)", "proved"),
    ("", "jacobi_dn(u,1/u)**2", "1-jacobi_sn(u,1/u)**2/u", "proved"),
    ("", "jacobi_dn(u,1/u)**2", "1-jacobi_sn(u,1/u)**2*1001/1000/u", "refuted"),
    ("", "jacobi_cn(-u,m)+jacobi_sn(-u,m)", "jacobi_cn(u,m)-jacobi_sn(u,m)", "proved"),
    ("", "jacobi_sn(u,0)+jacobi_cn(u,0)+jacobi_dn(u,0)", "sin(u)+cos(u)+1", "proved"),
    ("", "jacobi_sn(u,1)+jacobi_cn(u,1)-jacobi_dn(u,1)", "tanh(u)", "proved"),
    ("", "D(D(jacobi_sn(u,m),m),u)", "D(D(jacobi_sn(u,m),u),m)", "proved"),
    ("", "D(D(jacobi_dn(u,m),m,2),u)", "D(D(jacobi_dn(u,m),u),m,2)", "proved"),
    ("", "D(jacobi_sn(u,m),m)*jacobi_sn(u,m)", "-1001/1000*D(jacobi_cn(u,m),m)*jacobi_cn(u,m)", "refuted"),
]


@pytest.mark.parametrize(("where", "left", "right", "verdict"), CLAIMS)
def test_identities(where, left, right, verdict):
    text = f'[phase_space]\nq = ["u"]\np = ["m"]\n[domain]\nwhere = {[where] if where else []!r}\n'
    text += f'[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n'
    (claim,) = read_text(text).claims
    assert verify(claim, budget=20.0).status == verdict


SUM = "(jacobi_sn(u,m)*jacobi_cn(v,m)*jacobi_dn(v,m)+jacobi_sn(v,m)*jacobi_cn(u,m)*jacobi_dn(u,m))"
BELOW = "(1-m*jacobi_sn(u,m)**2*jacobi_sn(v,m)**2)"
SUMS = [
    ("", "jacobi_sn(u+v,m)", f"{SUM}/{BELOW}", "proved"),
    ("", "jacobi_sn(u+v,m)", f"{SUM}/{BELOW}*1001/1000", "refuted"),
    ("", "jacobi_sn(u+v,m)", f"{SUM}/(1-1001/1000*m*jacobi_sn(u,m)**2*jacobi_sn(v,m)**2)", "refuted"),
    ("", "jacobi_sn(2*u,m)*(1-m*jacobi_sn(u,m)**4)", "2*jacobi_sn(u,m)*jacobi_cn(u,m)*jacobi_dn(u,m)", "proved"),
    ("", "jacobi_cn(u,m)", "jacobi_cn(u/2,m)**2-jacobi_sn(u/2,m)**2", "refuted"),
    ("m<1", "jacobi_sn(u+4*elliptic_k(m),m)", "jacobi_sn(u,m)", "proved"),
    ("m<1", "jacobi_sn(u+2*elliptic_k(m),m)", "-jacobi_sn(u,m)", "proved"),
    ("m<1", "jacobi_sn(u+2*elliptic_k(m),m)", "jacobi_sn(u,m)", "refuted"),
    ("m<1", "jacobi_sn(u+elliptic_k(m),m)", "jacobi_cn(u,m)/jacobi_dn(u,m)", "proved"),
    ("m<1", "jacobi_cn(u-elliptic_k(m),m)", "sqrt(1-m)*jacobi_sn(u,m)/jacobi_dn(u,m)", "proved"),
    ("m<1", "jacobi_cn(u-elliptic_k(m),m)", "-sqrt(1-m)*jacobi_sn(u,m)/jacobi_dn(u,m)", "refuted"),
    ("m<1", "jacobi_dn(elliptic_k(m)/2,m)**2", "sqrt(1-m)*1001/1000", "refuted"),
    ("m<1", "D(jacobi_sn(u+2*elliptic_k(m),m),m)", "-D(jacobi_sn(u,m),m)", "proved"),
    ("m<1", "D(jacobi_cn(u+2*elliptic_k(m),m),m)", "-1001/1000*D(jacobi_cn(u,m),m)", "refuted"),
    ("m<1; -pi/2<u<pi/2", "jacobi_cn(elliptic_f(u,m),m)", "cos(u)", "proved"),
    ("m<1", "jacobi_dn(elliptic_f(u,m),m)", "sqrt(1-m*sin(u)**2)", "proved"),
    ("m<1", "jacobi_sn(elliptic_f(u,m)+v,m)", "jacobi_sn(v+elliptic_f(u,m),m)*1001/1000", "refuted"),
    ("", "D(jacobi_sn(u+v,m),m)", f"D({SUM}/{BELOW},m)", "proved"),
]


@pytest.mark.parametrize(("where", "left", "right", "verdict"), SUMS)
def test_addition_theorems_and_periods(where, left, right, verdict):
    parts = where.split("; ") if where else []
    text = f'[phase_space]\nq = ["u"]\np = ["v"]\n[symbols]\nm = "real"\n[domain]\nwhere = {parts!r}\n'
    text += f'[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n'
    (claim,) = read_text(text).claims
    assert verify(claim, budget=20.0).status == verdict
