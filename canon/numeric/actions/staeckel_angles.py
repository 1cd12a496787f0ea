"""Angles of many orbits in a Stäckel potential: w = ∂S/∂J of the generating function S = ∫ p_l dl + ∫ p_n dn + L φ.

The integrals ∂S/∂(E, I₂, I₃) run from the lower turning point of l and from the plane, each along its own
oscillation; with ∂(E, I₂, I₃)/∂J, the inverse of the actions' derivatives, they make the angles. Phases near a
turning point are taken from the momentum there, which is what the state has digits of. de Zeeuw (1985), Mon. Not. R.
Astron. Soc. 216, 273.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from canon.numeric.actions import staeckel
from canon.numeric.actions.orbit_blocks import orbits_of
from canon.numeric.actions.oscillation import NARROW_NODES, Narrow, Scalar, partial_quadrature, quadrature
from canon.numeric.actions.staeckel import CLOSE, mean_slope
from canon.numeric.actions.staeckel_orbits import NAMES, Parts, sums_of
from canon.numeric.actions.staeckel_rates import ROUNDING, narrow_rate, vertical_rate, wide_rate
from canon.numeric.exact.carlson import carlson_rf, complete_k


class StaeckelAngles(NamedTuple):
    """The angles w of each orbit, in [0, 1), conjugate to `staeckel_actions`, and a bound of their errors: an estimate
    of rounding and of what the last doubling of the nodes left."""

    radial: Any
    vertical: Any
    azimuthal: Any
    bound: Any


def staeckel_angles(
    G: Any,
    delta: float,
    R: Any,
    z: Any,
    p_R: Any,
    p_z: Any,
    L_z: Any,
    phi: Any = 0.0,
    *,
    m: float = 1.0,
    variable: str = "t",
    parameters: Mapping[str, Any] | None = None,
) -> StaeckelAngles:
    """The angles of the orbits whose actions `staeckel_actions` gives; the arguments are the same, `phi` the azimuth.

    All are 0 where l is least while the plane is crossed upwards at φ = 0, and grow evenly in time, at the rates of
    `staeckel_frequencies`. In the plane itself the vertical angle is that of the limit of small oscillations, at rest.

    **Raises:** `InputError` where G is no such formula, or an orbit is not bound or on the axis, with its index.
    """
    flat, whole = orbits_of((R, z, p_R, p_z, L_z, phi), (*NAMES, "phi"))
    rows = [row.reshape(whole) for row in flat]
    shape, state, along, across = sums_of(PARTS, (8, 8), G, delta, rows[:5], m, variable, parameters)
    L = state[4]
    A_E, A_2, A_3, off = m / 2 * along[[0, 1, 2, 7]]  # there and back
    B_3, B_E, B_2, across_off = m * across[[0, 1, 2, 7]]
    s_E, s_2, s_3, t_3, t_E, t_2 = m / 4 * np.concatenate([along[3:6], across[3:6]])
    by_E, by_2, by_3 = s_E - t_E, -s_2 - t_2, t_3 - s_3
    with np.errstate(all="ignore"):
        part = A_3 * B_E / (A_E * B_3)
        D = A_E * B_3 * (1 - part)
        radial, vertical = (by_E * B_3 + by_3 * B_E) / D, (by_E * A_3 + by_3 * A_E) / D
        drift = by_2 + (by_E * (B_3 * A_2 + A_3 * B_2) + by_3 * (B_E * A_2 + A_E * B_2)) / D
        azimuthal = (rows[5].ravel() + L / m * drift) / (2 * np.pi)
        relative = 4 * (off / A_E + across_off / B_3 + ROUNDING) / (1 - part)
        bound = relative * (1 + np.abs(azimuthal)) + along[6] + across[6]
    return StaeckelAngles(*(x.reshape(shape) for x in (radial % 1, vertical % 1, azimuthal % 1, bound)))


def _turned(phase: Any, outward: Any) -> Any:
    """The phase of a whole oscillation from that of a half, by the sense of the motion."""
    import jax.numpy as jnp

    return jnp.where(outward >= 0, phase, 2 * np.pi - phase)


def _near(G: Scalar, D2: Any, orbit: Narrow, m: Any, place: staeckel.Place) -> tuple[Any, ...]:
    import jax.numpy as jnp

    phase = _turned(2 * jnp.arctan2(jnp.sqrt(-orbit.low), jnp.sqrt(orbit.high)), place.outward)
    rate = narrow_rate(orbit, m, place)
    whole = quadrature(rate, orbit.low, orbit.high, NARROW_NODES)
    part = partial_quadrature(rate, orbit.low, orbit.high, phase, 2 * NARROW_NODES)
    # F' is a sum of terms of the size of E's, and moves the middle
    width = jnp.maximum(orbit.high - orbit.low, 2.0**-1000)
    stiff = jnp.abs(orbit.stiffness(jnp.zeros_like(width)))
    size = place.size / (stiff * width) + place.outward_size * jnp.sqrt(2 * place.l / (m * stiff)) / width
    shift = ROUNDING * (1 + size)
    return *whole, *part, shift, ROUNDING * whole[0]


def _wide(G: Scalar, D2: Any, m: Any, place: staeckel.Place, low: Any, high: Any, count: int) -> tuple[Any, ...]:
    import jax.numpy as jnp

    def F(u: Any) -> Any:
        beyond = jnp.exp(u)
        l = D2 + beyond
        return beyond * (l * (G(l) + place.E) - place.I3) - place.I2 * l

    half, here = (high - low) / 2, jnp.log(place.beyond)
    value = place.beyond * place.F  # of F(u), without a difference
    up, down = mean_slope(F, low, here), -mean_slope(F, here, high)
    below = jnp.where(here - low < CLOSE * half, value / up, here - low)
    above = jnp.where(high - here < CLOSE * half, value / down, high - here)
    phase = 2 * jnp.arctan2(jnp.sqrt(jnp.maximum(below, 0.0)), jnp.sqrt(jnp.maximum(above, 0.0)))
    phase = _turned(phase, place.outward)
    rate = wide_rate(G, D2, m, place)
    *whole, off = quadrature(rate, low, high, count)
    *part, _ = partial_quadrature(rate, low, high, phase, 2 * count)
    steep = half * jnp.minimum(jnp.abs(up), jnp.abs(down))
    size = place.size * place.beyond * place.l / steep
    size = size + place.outward_size * jnp.sqrt(2 * place.l * place.beyond / (m * steep))
    shift = ROUNDING * (1 + size)
    sums = [half * x for x in (*whole, *part)]
    return *sums, shift, 2.0**-51 * half * off


def _across(G: Scalar, D2: Any, m: Any, place: staeckel.Place, swing: staeckel.Swing, count: int) -> tuple[Any, ...]:
    import jax.numpy as jnp

    end = jnp.where(swing.end > 0, swing.end, 1.0)
    kinetic = 2 * place.within * place.across**2 / m  # what is left of I₃ at this n
    here = jnp.clip((swing.end - place.n) / end, 0.0, 1.0)
    slope = staeckel.vertical_slope(G, D2, place, swing, place.n, place.within, here)
    rest = kinetic / slope  # end − n, by what the state has digits of
    total = jnp.where(place.n + rest > 0, place.n + rest, 1.0)
    m1 = staeckel.swing_parameter(D2, swing)
    w = jnp.sqrt(place.n / total) * carlson_rf(rest / total, jnp.where(m1 < 1, place.within / D2, 1.0), 1.0)
    phase = _turned(jnp.pi * w / complete_k(m1), place.across)
    phase = jnp.where(place.side < 0, phase + 2 * np.pi, phase)  # n grows and falls twice while z does once
    rate, off = vertical_rate(G, D2, m, place, swing)
    ends = -jnp.ones_like(end), jnp.ones_like(end)
    whole = quadrature(rate, *ends, count)
    part = partial_quadrature(rate, *ends, phase, 2 * count)
    size = place.across_size * jnp.sqrt(2 * place.within / (m * slope * end))
    return *whole, *part, ROUNDING * (1 + size), off * whole[0]


PARTS = Parts(_near, _wide, _across, 3)
"""Three sums over a whole oscillation, three up to the phase, the rounding of the phase, and that of the first sum."""
