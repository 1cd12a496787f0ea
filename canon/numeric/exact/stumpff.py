"""Stumpff's functions c_k(ψ) = Σ (−ψ)^j/(2j + k)!, which are trigonometric for ψ > 0 and hyperbolic for ψ < 0.

Conditioning: a rounding of ψ is √|ψ|/2 roundings of the angle, or of the exponent. So the values are off by some
1 + √|ψ| roundings, of themselves for ψ < 0, for ψ > 0 of the size about which they oscillate: 1, 1/√ψ, 1/ψ, 1/ψ.
"""

from __future__ import annotations

from functools import lru_cache
from math import factorial
from typing import Any, Final

SERIES_BELOW: Final = 2.0
QUICK_BELOW: Final = 4096.0
_TERMS: Final = 11
_QUARTERINGS: Final = 6


def stumpff(psi: Any) -> tuple[Any, Any, Any, Any]:
    """(c_0, c_1, c_2, c_3) at ψ: Taylor's series where |ψ| is small, closed forms elsewhere.

    Stumpff (1959), Himmelsmechanik I, § 37; Danby (1988), Fundamentals of Celestial Mechanics, 6.9.
    """
    import jax.numpy as jnp

    near = jnp.where(jnp.abs(psi) <= SERIES_BELOW, psi, 0.0)
    two, three = _series(near, 2), _series(near, 3)
    far = jnp.where(jnp.abs(psi) <= SERIES_BELOW, SERIES_BELOW, psi)
    x = jnp.sqrt(jnp.abs(far))
    bound = far > 0
    angle, hyperbolic = jnp.where(bound, x, 1.0), jnp.where(bound, 1.0, x)
    half = jnp.where(bound, jnp.sin(angle / 2), jnp.sinh(hyperbolic / 2))
    whole = jnp.where(bound, jnp.sin(angle), jnp.sinh(hyperbolic))
    two_far = 2 * half**2 / (x * x)
    three_far = jnp.where(bound, x - whole, whole - x) / (x * x * x)
    small = jnp.abs(psi) <= SERIES_BELOW
    c2, c3 = jnp.where(small, two, two_far), jnp.where(small, three, three_far)
    c0 = 1 - psi * c2
    c1 = jnp.where(small, 1 - psi * c3, whole / x)
    return c0, c1, c2, c3


def stumpff_quickly(psi: Any) -> tuple[Any, Any, Any, Any]:
    """The same for |ψ| ≤ `QUICK_BELOW`, without functions, to eight roundings more: series at ψ/4⁶, doubled 6 times.

    c_0 is taken as 1 − ψ c_2 each time: as 2 c_0² − 1 its rounding would grow fourfold.
    Mikkola (1997), Celest. Mech. Dyn. Astron. 67, 145.
    """
    return _traced_once()(psi)


@lru_cache(maxsize=1)
def _traced_once() -> Any:
    """An iteration calls it time and again, and jax traces it each time, unless it is told that it is one function."""
    import jax

    return jax.jit(_quickly)


def _quickly(psi: Any) -> tuple[Any, Any, Any, Any]:
    near = psi / 4.0**_QUARTERINGS
    c2, c3 = _series(near, 2, 7), _series(near, 3, 7)
    c0, c1 = 1 - near * c2, 1 - near * c3
    for _ in range(_QUARTERINGS):
        near = 4 * near
        c3 = (c2 + c0 * c3) / 4
        c2 = c1 * c1 / 2
        c0, c1 = 1 - near * c2, c0 * c1
    return c0, c1, c2, c3


def _series(psi: Any, k: int, terms: int = _TERMS) -> Any:
    total = 1.0 / factorial(2 * terms + k)
    for j in range(terms - 1, -1, -1):
        total = 1.0 / factorial(2 * j + k) - psi * total
    return total


def stumpff_4(psi: Any) -> Any:
    """c_4(ψ) = (1/2 − c_2(ψ))/ψ."""
    import jax.numpy as jnp

    small = jnp.abs(psi) <= SERIES_BELOW
    far = jnp.where(small, SERIES_BELOW, psi)
    return jnp.where(small, _series(jnp.where(small, psi, 0.0), 4), (0.5 - stumpff(far)[2]) / far)
