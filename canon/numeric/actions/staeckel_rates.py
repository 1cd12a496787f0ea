"""∂p/∂(E, I₂, I₃) along orbits in a Stäckel potential, as functions of the phase θ of l and of n, up to factors.

∂p_l/∂(E, I₂, I₃) = (1, −1/(l − Δ²), −1/l) m/(4 (l − Δ²) p_l), and ∂p_n/∂(I₃, E, I₂) = (1, −n, −n/(Δ² − n)) m/(4 (Δ² −
n) n p_n). What is under the root of a momentum vanishes at a turning point as the distance from it does: their
quotient is a mean slope.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from canon.numeric.actions import staeckel
from canon.numeric.actions.oscillation import Narrow, Scalar

ROUNDING: Final = 2.0**-46
CLOSE: Final = 0.1
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)

Rate = Callable[[Any, Any], tuple[Any, ...]]


def mean_slope(f: Scalar, start: Any, end: Any) -> Any:
    """[f(end) − f(start)]/(end − start), by Gauss's rule for the derivative: no difference is taken."""
    import jax
    import jax.numpy as jnp

    places = start + (end - start) * (_NODES[:, None] + 1) / 2
    slopes = jax.jvp(f, (places,), (jnp.ones_like(places),))[1]
    return jnp.tensordot(_WEIGHTS / 2, slopes, axes=1)


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


def vertical_slope(G: Scalar, D2: Any, place: staeckel.Place, end: Any, n: Any) -> Any:
    """[I₃ − n (G(n) + E + I₂/(Δ² − n))]/(end − n): I₃ is the value of that at the end."""
    import jax.numpy as jnp

    rest = end - n
    close = mean_slope(lambda t: t * G(t), n, end) + place.E + place.I2 * D2 / ((D2 - n) * (D2 - end))
    apart = (place.I3 - n * (G(n) + place.E + place.I2 / (D2 - n))) / jnp.where(rest > 0, rest, 1.0)
    return jnp.where(rest > CLOSE * end, apart, close)


def vertical_rate(G: Scalar, D2: Any, m: Any, place: staeckel.Place, end: Any) -> tuple[Rate, Any]:
    """The rates of n in −cos θ, n = end sin²(θ/2), for I₃, E and I₂; and the stiffness at the plane."""
    import jax.numpy as jnp

    def term(half_turn: Any, _: Any) -> tuple[Any, ...]:
        n = end * (1 + half_turn) / 2  # dn / √(n (end − n)) = dθ
        rate = jnp.sqrt(2 / (m * (D2 - n) * vertical_slope(G, D2, place, end, n)))
        return rate, rate * n, rate * n / (D2 - n)

    return term, G(jnp.zeros_like(end)) + place.E + place.I2 / D2
