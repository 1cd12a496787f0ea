"""The harmonic oscillator, damped and driven: one formula at and near resonance and critical damping.

q̈ + 2γ q̇ + ω² q = f cos(Ωt + β). The free motion uses Stumpff's functions of (ω² − γ²)t², which do not care for its
sign; the forced one is a divided difference of exp(zt) at iΩ and the two roots, whichever of them coincide.
Landau and Lifshitz (1976), Mechanics, §§ 22, 25, 26; McCurdy, Ng and Parlett (1984), Math. Comput. 43, 501.
"""

from __future__ import annotations

from math import factorial
from typing import Any, Final

from canon.numeric.exact.stumpff import stumpff

CLOSE: Final = 1.0
_TERMS: Final = 18


def oscillator(
    q: Any,
    v: Any,
    t: Any,
    *,
    omega2: Any,
    damping: Any = 0.0,
    force: Any = 0.0,
    drive: Any = 0.0,
    phase: Any = 0.0,
) -> tuple[Any, Any]:
    """The position and velocity after a time t from t = 0.

    **Arguments:** `omega2` = k/m, of any sign; `damping` γ (the force is −2mγ q̇); `force` f per mass, `drive` Ω and
    `phase` β of the driving f cos(Ωt + β).
    """
    import jax.numpy as jnp

    c0, c1, _, _ = stumpff((omega2 - damping**2) * t * t)
    decay = jnp.exp(-damping * t)
    slide = t * c1
    free = decay * (q * c0 + (v + damping * q) * slide)
    velocity = decay * (v * c0 - (damping * v + omega2 * q) * slide)
    if isinstance(force, float) and force == 0.0:
        return free, velocity
    root = jnp.sqrt(jnp.asarray(damping**2 - omega2, dtype=complex))
    high, low, wave = root - damping, -root - damping, 1j * drive
    push = force * jnp.exp(1j * phase)
    second = divided_exponential(wave, high, low, t)
    return free + jnp.real(push * second), velocity + jnp.real(push * (decay * slide + wave * second))


def divided_exponential(a: Any, b: Any, c: Any, t: Any) -> Any:
    """The second divided difference of exp(zt) at a, b and c, any of which may coincide."""
    import jax.numpy as jnp

    ab, bc, ca = jnp.abs(a - b), jnp.abs(b - c), jnp.abs(c - a)
    # the difference is taken across the two points that are farthest apart
    first = (ab >= bc) & (ab >= ca)
    second = ~first & (bc >= ca)
    x, z = jnp.where(first | ~second, a, b), jnp.where(first, b, c)
    y = jnp.where(first, c, jnp.where(second, a, b))
    near = jnp.abs(x - z) * jnp.abs(t) <= CLOSE
    gap = jnp.where(near, 1.0, x - z)
    far = (_first(x, y, t) - _first(y, z, t)) / gap
    return jnp.where(near, _series(a, b, c, t, near), far)


def _first(a: Any, b: Any, t: Any) -> Any:
    """(e^{at} − e^{bt})/(a − b)."""
    import jax.numpy as jnp

    half = (a - b) * t / 2
    small = jnp.abs(half) < 0.1
    away = jnp.where(small, 1.0, half)
    square = jnp.where(small, half, 0.0) ** 2
    series = 1 + square / 6 * (1 + square / 20 * (1 + square / 42 * (1 + square / 72 * (1 + square / 110))))
    # one exponential is taken out, so that nothing overflows where both decay
    return jnp.exp((a + b) * t / 2) * t * jnp.where(small, series, jnp.sinh(away) / away)


def _series(a: Any, b: Any, c: Any, t: Any, near: Any) -> Any:
    """t² e^{mt} Σ h_k/(k + 2)! with the complete symmetric polynomials h_k of the points about their mean m."""
    import jax.numpy as jnp

    mean = (a + b + c) / 3
    x, y, z = (jnp.where(near, (point - mean) * t, 0.0) for point in (a, b, c))
    e2, e3 = x * y + y * z + z * x, x * y * z
    h = [jnp.ones_like(x), jnp.zeros_like(x), -e2]
    for _ in range(3, _TERMS):
        h.append(-e2 * h[-2] + e3 * h[-3])
    total = sum((value / factorial(k + 2) for k, value in enumerate(h) if k), h[0] / 2)
    return jnp.exp(mean * t) * t * t * total
