"""Regions of the radial motion, exactly."""

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.central_motion import effective_potential, radial_regions

r = sp.Symbol("r", positive=True)
Q = sp.Rational


def _kinds(V, E, M):
    return [region.kind for region in radial_regions(V, r, energy=E, angular_momentum=M)]


@pytest.mark.parametrize(
    ("V", "E", "M", "kinds"),
    [
        (-1 / r, "-0.3", 1, ["bounded"]),
        (-1 / r, "0.3", 1, ["unbounded"]),
        (-1 / r, 0, 1, ["unbounded"]),
        (-1 / r, Q(-1, 2), 1, ["circular"]),
        (-1 / r, "-0.5000000000000000000001", 1, []),
        (-1 / r, "-0.4999999999999999999999", 1, ["bounded"]),  # the turning points differ by 4e-11
        (-1 / r, -1, 0, ["falls in"]),
        (1 / r, 1, 0, ["unbounded"]),
        (-1 / r**3, Q(1, 10), 1, ["falls in and escapes"]),
        (-1 / r**3, Q(1, 100), 1, ["falls in", "unbounded"]),
        (-1 / r**3, Q(1, 54), 1, ["separatrix", "separatrix"]),
        (r**2 / 2, 2, 1, ["bounded"]),
        (-Q(1, 2) / r**2, 1, 1, ["falls in and escapes"]),
        (1 / r**12 - 1 / r**6, Q(-1, 10), Q(1, 10), ["bounded"]),
    ],
)
def test_kinds(V, E, M, kinds):
    assert _kinds(V, E, M) == kinds


def test_kepler_apsides_are_exact():
    """r = p/(1 ± e) with p = 1, e² = 1 + 2E (Goldstein, eq. 3.57)."""
    (region,) = radial_regions(-1 / r, r, energy=Q(-3, 10), angular_momentum=1)
    e = sp.sqrt(Q(2, 5))
    assert sp.simplify(region.low - 1 / (1 + e)) == 0
    assert sp.simplify(region.high - 1 / (1 - e)) == 0
    assert effective_potential(-1 / r, r, 1, 1) == 1 / (2 * r**2) - 1 / r


@pytest.mark.parametrize("gap", [Q(1, 10**9), Q(1, 10**20), Q(1, 10**33)])
@pytest.mark.parametrize("side", [1, -1])
def test_turning_points_that_nearly_meet_at_a_short_number(gap, side):
    """E − V − M²/2mr² = −(r − 1)(r − 1 ∓ gap)/r²: their middle is 1 but for many digits."""
    other = 1 + side * gap
    (region,) = radial_regions(-(1 + other) / r, r, mass=1 / (2 * other), energy=-1, angular_momentum=1)
    assert (region.low, region.high, region.kind) == (*sorted((sp.Integer(1), other)), "bounded")


@pytest.mark.parametrize(
    ("V", "E", "message"),
    [(sp.exp(-r), 1, "rational function"), (1 / (r - 1), 1, "pole"), (-1 / r, sp.sqrt(2), "rational numbers")],
)
def test_faults(V, E, message):
    with pytest.raises(InputError, match=message):
        radial_regions(V, r, energy=E, angular_momentum=1)
