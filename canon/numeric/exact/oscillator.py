"""The harmonic oscillator, damped and driven: one formula at and near resonance and critical damping.

q̈ + 2γ q̇ + ω² q = f cos(Ωt + β). The free motion uses Stumpff's functions of (ω² − γ²)t², which do not care for its
sign, and far from critical damping its two decays, of which the slow one is ω² over the fast one; the forced motion is
a divided difference of exp(zt) at iΩ and the two roots, whichever of them coincide. Conditioning: that of the motion
itself; a phase of so many radians is off by as many roundings of its frequency and time.
Landau and Lifshitz (1976), Mechanics, §§ 22, 25, 26; McCurdy, Ng and Parlett (1984), Math. Comput. 43, 501.
"""

from __future__ import annotations

from math import factorial
from typing import Any, Final

from canon.numeric.exact.stumpff import stumpff

CLOSE: Final = 1.0
APART: Final = 4.0
"""(γ² − ω²)t² beyond which the two decays are taken one by one."""

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
    slow, fast, apart = _decays(omega2, damping, t)
    one, other = (v - fast * q) * jnp.exp(slow * t), (v - slow * q) * jnp.exp(fast * t)
    free = jnp.where(apart, (one - other) / (slow - fast), free)
    velocity = jnp.where(apart, (slow * one - fast * other) / (slow - fast), velocity)
    if isinstance(force, float) and force == 0.0:
        return free, velocity
    root = jnp.sqrt(jnp.asarray(damping**2 - omega2, dtype=complex))
    high, low, wave = jnp.where(apart, slow, root - damping), jnp.where(apart, fast, -root - damping), 1j * drive
    push = force * jnp.exp(1j * phase)
    second = divided_exponential(wave, high, low, t)
    first = jnp.where(apart, jnp.real(_first(high, low, t)), decay * slide)
    return free + jnp.real(push * second), velocity + jnp.real(push * (first + wave * second))


def _decays(omega2: Any, damping: Any, t: Any) -> tuple[Any, Any, Any]:
    """The roots of z² + 2γz + ω², the smaller as a quotient, where their exponentials are `apart`; else −1 and −2."""
    import jax.numpy as jnp

    square = damping**2 - omega2
    apart = square * t * t > APART
    root = jnp.sqrt(jnp.where(apart, square, 1.0))
    fast = -damping - jnp.where(damping >= 0, root, -root)
    fast = jnp.where(apart, fast, -2.0)
    return jnp.where(apart, omega2 / fast, -1.0), fast, apart


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
    far = jnp.abs(jnp.real(half)) > 1  # nothing cancels, and the sine would overflow
    wide = (jnp.exp(a * t) - jnp.exp(b * t)) / jnp.where(far, a - b, 1.0)
    half = jnp.where(far, 1.0, half)
    away = jnp.where(small, 1.0, half)
    square = jnp.where(small, half, 0.0) ** 2
    series = 1 + square / 6 * (1 + square / 20 * (1 + square / 42 * (1 + square / 72 * (1 + square / 110))))
    # one exponential is taken out, so that nothing overflows where both decay
    close = jnp.exp((a + b) * t / 2) * t * jnp.where(small, series, jnp.sinh(away) / away)
    return jnp.where(far, wide, close)


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
