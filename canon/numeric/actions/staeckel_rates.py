"""∂p/∂(E, I₂, I₃) along orbits in a Stäckel potential, as functions of the phase θ of l and of n, up to factors.

∂p_l/∂(E, I₂, I₃) = (1, −1/(l − Δ²), −1/l) m/(4 (l − Δ²) p_l), and ∂p_n/∂(I₃, E, I₂) = (1, −n, −n/(Δ² − n)) m/(4 (Δ² −
n) n p_n). What is under the root of a momentum vanishes at a turning point as the distance from it does: their
quotient is a mean slope.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

from canon.numeric.actions import staeckel
from canon.numeric.actions.oscillation import Narrow, Scalar

ROUNDING: Final = 2.0**-46

Rate = Callable[[Any, Any], tuple[Any, ...]]


def wide_rate(G: Scalar, D2: Any, m: Any, place: staeckel.Place) -> Rate:
    """dl/(√m p_l)-like rates in u = ln(l − Δ²): over l − Δ², over its square, over (l − Δ²) l; and a rounding."""
    import jax.numpy as jnp

    def term(u: Any, sine: Any) -> tuple[Any, ...]:
        beyond = jnp.exp(u)
        l = D2 + beyond
        F = l * (G(l) + place.E - place.I2 / beyond) - place.I3
        F = jnp.where(F > 0, F, jnp.inf)
        rate = sine * jnp.sqrt(2 * l * beyond / (m * F))
        return rate, rate / beyond, rate / l, rate * l * place.size / F

    return term


def narrow_rate(orbit: Narrow, m: Any, place: staeckel.Place) -> Rate:
    """The first three of them for an orbit whose l hardly changes, in y = l − l₀."""
    import jax.numpy as jnp

    def term(y: Any, sine: Any) -> tuple[Any, ...]:
        beyond, l = place.beyond + y, place.l + y
        rate = jnp.sqrt(2 * l / (m * beyond * orbit.stiffness(y)))
        return rate, rate / beyond, rate / l

    return term


def vertical_rate(G: Scalar, D2: Any, m: Any, place: staeckel.Place, swing: staeckel.Swing) -> tuple[Rate, Any]:
    """The rates of n in θ, as of `along_swing`, for I₃, E and I₂; and the rounding of the first as a part of it."""
    import jax.numpy as jnp

    def term(n: Any, within: Any, part: Any) -> tuple[Any, ...]:
        slope = staeckel.vertical_slope(G, D2, place, swing, n, within, part)
        rate = 2 * jnp.sqrt(2 / (m * within * slope))
        return rate, rate * n, rate * n / within

    stiffness = G(jnp.zeros_like(swing.end)) + place.E + place.I2 / D2
    off = ROUNDING * (1 + place.size / jnp.abs(stiffness) + place.size * swing.left / place.I2)
    return staeckel.along_swing(D2, swing, term), off
