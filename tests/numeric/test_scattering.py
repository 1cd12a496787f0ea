"""Deflections and cross-sections of one particle."""

from math import isclose, pi, sqrt

import pytest
import sympy as sp

from canon.errors import InputError
from canon.numeric.scattering import scattering

r, a, L = sp.symbols("r a lam", positive=True)
BEAM = {"energy": 1.5, "impact_parameter": 2.0}


def test_rutherford_and_a_screened_potential_that_is_hardly_screened():
    exact = scattering(a / r, r, **BEAM, parameters={a: 3})
    assert isclose(exact.cross_section, (3 / 6) ** 2 / sp.sin(exact.angle / 2) ** 4, rel_tol=1e-14)
    far = scattering(a / r * sp.exp(-r / L), r, **BEAM, parameters={"a": 3, "lam": 1e9})
    assert isclose(far.angle, exact.angle, rel_tol=1e-8)
    assert isclose(far.cross_section, exact.cross_section, rel_tol=1e-7)


def test_an_inverse_square_in_closed_form():
    """chi = pi (1 - b/sqrt(b^2 + a/E)) (Goldstein, Poole and Safko, problem 3.35)."""
    found = scattering(a / r**2, r, **BEAM, parameters={a: 3})
    assert isclose(found.angle, pi * (1 - 2 / sqrt(4 + 2)), rel_tol=1e-13)
    assert isclose(found.angle + found.backward, pi, rel_tol=1e-14)


@pytest.mark.parametrize("b", [0.0, 1e-5, 1e-3])
def test_almost_head_on_it_is_sent_back(b: float):
    """A thousand times b is still inside of what keeps it away: None was the answer, as of a fall into the centre."""
    found = scattering(a / r**2, r, energy=0.3, impact_parameter=b, parameters={a: 3})
    assert isclose(found.backward, pi * b / sqrt(b * b + 10), rel_tol=1e-12)
    assert isclose(found.nearest, sqrt(b * b + 10), rel_tol=1e-14)
    assert scattering(sp.exp(-r) / r, r, energy=0.3, impact_parameter=b).angle > 3.1


@pytest.mark.parametrize("V", [r ** sp.Rational(-1, 50), sp.exp(-r), 1 / sp.log(2 + r), sp.sin(r) / r])
def test_what_vanishes_however_it_does(V: sp.Expr):
    assert scattering(V, r, energy=5.0, impact_parameter=1.0) is not None


def test_attraction_and_a_fall_into_the_centre():
    assert scattering(-a / r, r, **BEAM, parameters={a: 3}).angle < 0
    assert scattering(-a / r**3, r, energy=1.5, impact_parameter=0.1, parameters={a: 3}) is None


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: scattering(a / r, r, **BEAM), "the value of a"),
        (lambda: scattering(1 / r + 1, r, energy=3.0, impact_parameter=1.0), "V vanishes far away"),
        (lambda: scattering(-r, r, **BEAM), "V vanishes far away"),  # 0.67 was its angle
        (lambda: scattering(sp.sin(r), r, **BEAM), "V vanishes far away"),
        (lambda: scattering(sp.log(r), r, **BEAM), "V vanishes far away"),
        (lambda: scattering(1 / r, r, energy="1", impact_parameter=1.0), "energy: a finite number is needed"),
        (lambda: scattering(sp.exp(-r), r, **BEAM, begin="far"), "begin: a finite number is needed"),
        (lambda: scattering(1 / r, r, energy=-1.0, impact_parameter=1.0), "a positive number"),
        (lambda: scattering(1 / r, r, energy=1.0, impact_parameter=-1.0), "from 0 on"),
        (lambda: scattering(sp.Function("V")(r), r, **BEAM), "arbitrary function"),
        (lambda: scattering(1 / r**2, r, **BEAM, begin=-1.0), "a positive distance"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
