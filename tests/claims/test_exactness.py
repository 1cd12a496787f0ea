"""Is a closed form exact?  Gauge transformations P = p + A(q), for which P dQ − p dq = A is any form one likes."""

from __future__ import annotations

import math

import pytest


def gauge(answer, names, form, *, where=(), symbols="", more=""):
    """A claim of exactness of the form with these components, in as many degrees of freedom; `more` widens H."""
    q = list(names)
    p, Q, P = ([f"{letter}{name}" for name in q] for letter in "pQP")
    images = [f"{pk} + {Ak}" for pk, Ak in zip(p, form, strict=True)]
    return answer(
        'kind = "cartan_invariant"\nK = "0"',
        space=f"q = {q}\np = {p}\nQ = {Q}\nP = {P}\n",
        symbols=symbols,
        domain=f"where = {list(where)}",
        hamiltonian=f'H = "0{more}"',
        transformation=f"Q = {q}\nP = {images}",
    )


def flux(u: str = "x", v: str = "y", a: str = "1", *, du=("1", "0"), dv=("0", "1")) -> tuple[str, ...]:
    """a times the differential of the polar angle of (u, v), which have the differentials du and dv."""
    return tuple(f"{a}*(({u})*({q}) - ({v})*({p}))/(({u})**2 + ({v})**2)" for p, q in zip(du, dv, strict=True))


def plus(first: tuple[str, ...], second: tuple[str, ...]) -> tuple[str, ...]:
    """The sum of two forms."""
    return tuple(f"{a} + {b}" for a, b in zip(first, second, strict=True))


@pytest.mark.parametrize(
    ("form", "where", "symbols"),
    [
        (flux(), (), ""),
        (flux(a="a"), (), 'a = "nonzero"'),
        (flux("x - b", "y + b**2"), (), ""),
        (flux(), ("x**2 + y**2 > 1", "x**2 + y**2 < 4"), ""),
        (flux("2*x + y", "y/10", du=("2", "1"), dv=("0", "1/10")), (), ""),
        (plus(flux("x - 1"), flux("x + 1", a="-1")), (), ""),
        (plus(flux(a="1e-6"), ("exp(x)*cos(y)", "-exp(x)*sin(y)")), (), ""),
        (flux(a="D(V(b), b)"), (), 'V = "function"\nb = "real"'),
        (flux("x**3 + x", "y", du=("3*x**2 + 1", "0")), (), ""),
        (flux(), ("x**4 + y**4 > 1", "x**2 + y**2 < 9"), ""),
    ],
)
def test_a_form_with_a_period_is_refuted_by_a_loop(ask, form, where, symbols):
    (verdict,) = gauge(ask, "xy", form, where=where, symbols=symbols or 'b = "real"')
    assert verdict.status == "refuted"
    assert (verdict.witness, verdict.method) == (None, "theorem")
    assert "cos(s)" in verdict.detail["loop"]["x"]


def test_a_hole_that_two_formulas_take_out_is_a_hole(status):
    """The Aharonov–Bohm potential (Phys. Rev. 115 (1959) 485), in the map and in K: the same condition twice over."""
    assert (
        status(
            'kind = "cartan_invariant"\nK = "((PX + Y/(X**2 + Y**2))**2 + (PY - X/(X**2 + Y**2))**2)/2"',
            space='q = ["x", "y"]\np = ["px", "py"]\nQ = ["X", "Y"]\nP = ["PX", "PY"]\n',
            hamiltonian='H = "(px**2 + py**2)/2 + log(x**2 + y**2)*0"',
            transformation='Q = ["x", "y"]\nP = ["px - y/(x**2 + y**2)", "py + x/(x**2 + y**2)"]',
        )
        == "refuted"
    )


def test_a_complex_denominator_takes_out_a_hole(status):
    """x + iy is 0 on a line of space, not on a wall: no loop is contracted across it."""
    form = ("(1/(x - 1j*y) - 1/(x + 1j*y))*1j/2", "(1/(x + 1j*y) + 1/(x - 1j*y))/2")
    assert gauge(status, "xy", form) == "supported"


def test_the_loop_integral_is_the_flux(ask):
    (verdict,) = gauge(ask, "xy", flux(a="3"))
    assert abs(float(verdict.detail["loop_integral"])) == pytest.approx(6 * math.pi)


@pytest.mark.parametrize(
    ("form", "where", "more"),
    [
        (flux(), ("y > x",), ""),
        (flux(), ("x**2 + y**2 > 1", "y > 0"), ""),
        (flux(), (), " + atan2(y, x)*0"),
        (flux("x - exp(y)", "y", du=("1", "-exp(y)")), (), " + 0*atan2(y, x - exp(y))"),
        (("x/(x**2 + y**2)", "y/(x**2 + y**2)"), (), ""),
    ],
)
def test_a_form_without_periods_is_proved(status, form, where, more):
    assert gauge(status, "xy", form, where=where, more=more) == "proved"


def test_space_without_a_point_has_no_periods(ask):
    """exp(1/r) dr has no potential among elementary functions, and needs none; a line taken out makes periods."""
    r = "sqrt(x**2 + y**2 + z**2)"
    (point,) = gauge(ask, "xyz", [f"exp(1/{r})*{u}/{r}" for u in "xyz"])
    (line,) = gauge(ask, "xyz", ("-y/(x**2 + y**2)", "x/(x**2 + y**2)", "0"))
    assert point.status == "proved"
    assert point.detail["exact_by"] == "every loop in the domain can be contracted"
    assert line.status == "refuted"


def test_fluxes_that_cancel_outside_of_a_circle_are_not_refuted(status):
    form = plus(flux("x - 1"), flux("x + 1", a="-1"))
    assert gauge(status, "xy", form, where=("x**2 + y**2 > 4",)) in ("supported", "proved")
    assert gauge(status, "xy", form, where=("x**2 + y**2 > 1/4",)) == "refuted"


def test_the_quadrature_round_a_loop_continues_absolute_values_analytically(ask):
    """The modulus of a complex number isn't the continuation of |x|: sin(200|z|) stays small where sin(200 z) grows."""
    form = ("D(y*sin(200*abs(x + 5)), x)", "sin(200*abs(x + 5))")
    (verdict,) = gauge(ask, "xy", form, where=("x + 5 > 0", "x**2 + y**2 > 1/10"))
    assert verdict.status in ("proved", "supported")
    (verdict,) = gauge(ask, "xy", plus(flux(), ("D(y*sin(abs(x + 5)), x)", "sin(abs(x + 5))")), where=("x + 5 > 0",))
    assert verdict.status == "refuted"
    assert verdict.detail["loop_integral"].startswith(("6.28318530", "-6.28318530"))
