"""Frequencies of many orbits in a Stäckel potential: the inverse of ∂(J_λ, J_ν, J_φ)/∂(E, I₂, I₃), by quadrature.

With the separation of `staeckel`, ∂p_l/∂(E, I₂, I₃) = (1, −1/(l − Δ²), −1/l) m/(4 (l − Δ²) p_l), and for n alike. At
fixed actions dE then is ν_λ dJ_λ + ν_ν dJ_ν + ν_φ dJ_φ with, D being ∂(J_λ, J_ν)/∂(E, I₃) and I₂ = L²/2m,
ν_λ = ∂J_ν/∂I₃ /D, ν_ν = −∂J_λ/∂I₃ /D and 2πmν_φ = L [∂(J_λ, J_ν)/∂(I₃, I₂)]/D. No numerator is a difference, and D is
one of two terms with the ratio of ⟨n⟩⟨1/l⟩ < 1. de Zeeuw (1985), Mon. Not. R. Astron. Soc. 216, 273, section 4.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from canon.numeric.actions import staeckel
from canon.numeric.actions.oscillation import NARROW_NODES, Narrow, Scalar, quadrature
from canon.numeric.actions.staeckel_orbits import Parts, sums_of
from canon.numeric.actions.staeckel_rates import ROUNDING, narrow_rate, vertical_rate, wide_rate


class StaeckelFrequencies(NamedTuple):
    """ν_λ, ν_ν and ν_φ of each orbit, in cycles, in the plane's terms radial, vertical and azimuthal; and their bound,
    relative to each: an estimate of rounding and of what the last doubling of the nodes left."""

    radial: Any
    vertical: Any
    azimuthal: Any
    relative_bound: Any


def staeckel_frequencies(
    G: Any,
    delta: float,
    R: Any,
    z: Any,
    p_R: Any,
    p_z: Any,
    L_z: Any,
    *,
    m: float = 1.0,
    variable: str = "t",
    parameters: Mapping[str, Any] | None = None,
) -> StaeckelFrequencies:
    """The frequencies ∂E/∂J of the orbits whose actions `staeckel_actions` gives; the arguments are the same.

    ν_φ has the sign of L_z, and the vertical angle grows by 1 while n, and z with it, goes there and back across the
    plane. In the plane itself the vertical frequency is that of small oscillations about it.

    **Raises:** `InputError` where G is no such formula, or an orbit is not bound or on the axis, with its index.
    """
    shape, state, along, across = sums_of(PARTS, (4, 4), G, delta, (R, z, p_R, p_z, L_z), m, variable, parameters)
    by_E, by_2, by_3, off = m / 2 * along  # there and back
    across_3, across_E, across_2, across_off = m * across
    with np.errstate(all="ignore"):
        part = by_3 * across_E / (by_E * across_3)
        D = by_E * across_3 * (1 - part)
        bound = 4 * (off / by_E + across_off / across_3 + ROUNDING) / (1 - part)
        found = (across_3 / D, by_3 / D, state[4] * (by_2 * across_3 + by_3 * across_2) / (2 * np.pi * m * D), bound)
    return StaeckelFrequencies(*(x.reshape(shape) for x in found))


def _wide_sums(G: Scalar, D2: Any, m: Any, place: staeckel.Place, low: Any, high: Any, count: int) -> tuple[Any, ...]:
    """∫ dl/p_l over l − Δ², over its square and over (l − Δ²) l, between the ends; the rounding of the first."""
    half = (high - low) / 2
    *sums, off = quadrature(wide_rate(G, D2, m, place), low, high, count)
    return *(half * value for value in sums), 2.0**-51 * half * off


def _narrow_sums(G: Scalar, D2: Any, orbit: Narrow, m: Any, place: staeckel.Place) -> tuple[Any, ...]:
    """The same sums of an orbit whose l hardly changes."""
    first, *others = quadrature(narrow_rate(orbit, m, place), orbit.low, orbit.high, NARROW_NODES)
    return first, *others, ROUNDING * first


def _vertical_sums(G: Scalar, D2: Any, m: Any, place: staeckel.Place, swing: staeckel.Swing, count: int) -> Any:
    """∫ dn/p_n over (Δ² − n) n, over Δ² − n and over its square, up to the largest n; the rounding of the first."""
    import jax.numpy as jnp

    rate, off = vertical_rate(G, D2, m, place, swing)
    first, second, third = quadrature(rate, -jnp.ones_like(swing.end), jnp.ones_like(swing.end), count)
    return first, second, third, off * first


PARTS = Parts(_narrow_sums, _wide_sums, _vertical_sums, 3)
"""The derivatives of the actions by the constants, up to factors."""
