"""Elliptic integrals: the complete one of the first kind by the mean of Gauss, and Carlson's symmetric R_F and R_J.

Conditioning: they fall with each argument and are homogeneous, of degree −1/2 (R_F) and −3/2 (R_J), so that Σ |∂ ln R/∂
ln x| is 1/2 and 3/2: relative errors of positive arguments are not amplified.
"""

from __future__ import annotations

from typing import Any, Final

_MEANS: Final = 10
_DUPLICATIONS: Final = 16


def complete_k(m1: Any) -> Any:
    """K for the complementary parameter m1 = 1 − m > 0: π/(2 AGM(1, √m1)). Abramowitz and Stegun 17.6.3."""
    import jax.numpy as jnp

    a, b = jnp.ones_like(m1), jnp.sqrt(jnp.maximum(m1, 0.0))
    for _ in range(_MEANS):
        a, b = (a + b) / 2, jnp.sqrt(a * b)
    return jnp.pi / (a + b)


def carlson_rf(x: Any, y: Any, z: Any) -> Any:
    """R_F(x, y, z) = ½∫₀^∞ dt/√((t+x)(t+y)(t+z)), by duplication. Carlson (1995), Numer. Algorithms 10, 13."""
    import jax.numpy as jnp
    from jax import lax

    def duplicate(_: Any, point: Any) -> Any:
        rx, ry, rz = (jnp.sqrt(value) for value in point)
        shift = rx * ry + ry * rz + rz * rx
        return tuple((value + shift) / 4 for value in point)

    x, y, z = lax.fori_loop(0, _DUPLICATIONS, duplicate, tuple(jnp.broadcast_arrays(x * 1.0, y * 1.0, z * 1.0)))
    mean = (x + y + z) / 3
    dx, dy = 1 - x / mean, 1 - y / mean
    dz = -dx - dy
    e2, e3 = dx * dy - dz * dz, dx * dy * dz
    return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / jnp.sqrt(mean)


def carlson_rj(x: Any, y: Any, z: Any, p: Any) -> Any:
    """R_J(x, y, z, p) = (3/2)∫₀^∞ dt/((t+p)√((t+x)(t+y)(t+z))) for p > 0, by duplication. Carlson (1995)."""
    import jax.numpy as jnp
    from jax import lax

    def duplicate(_: Any, loop: Any) -> Any:
        x, y, z, p, total, power = loop
        rx, ry, rz, rp = jnp.sqrt(x), jnp.sqrt(y), jnp.sqrt(z), jnp.sqrt(p)
        shift = rx * ry + ry * rz + rz * rx
        d = (rp + rx) * (rp + ry) * (rp + rz)
        e = (p - x) * (p - y) * (p - z) / (d * d)
        quarters = ((x + shift) / 4, (y + shift) / 4, (z + shift) / 4, (p + shift) / 4)
        return (*quarters, total + power / d * _rc_one(e), power / 4)

    point = jnp.broadcast_arrays(x * 1.0, y * 1.0, z * 1.0, p * 1.0)
    begin = (*point, jnp.zeros_like(point[0]), jnp.ones_like(point[0]))
    x, y, z, p, total, power = lax.fori_loop(0, _DUPLICATIONS, duplicate, begin)
    mean = (x + y + z + 2 * p) / 5
    dx, dy, dz = 1 - x / mean, 1 - y / mean, 1 - z / mean
    dp = -(dx + dy + dz) / 2
    e2 = dx * dy + dx * dz + dy * dz - 3 * dp * dp
    e3 = dx * dy * dz + 2 * e2 * dp + 4 * dp**3
    e4 = (2 * dx * dy * dz + e2 * dp + 3 * dp**3) * dp
    e5 = dx * dy * dz * dp * dp
    series = 1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26
    return 6 * total + power * series / (mean * jnp.sqrt(mean))


def _rc_one(e: Any) -> Any:
    """R_C(1, 1 + e) = atan(√e)/√e, continued to e > −1."""
    import jax.numpy as jnp

    small = jnp.abs(e) < 1e-2
    root = jnp.sqrt(jnp.where(small, 1.0, jnp.abs(e)))
    far = jnp.where(e > 0, jnp.arctan(root), jnp.arctanh(jnp.where(e > 0, 0.0, jnp.minimum(root, 1 - 1e-16)))) / root
    return jnp.where(small, _alternating(jnp.where(small, e, 0.0)), far)


def _alternating(e: Any) -> Any:
    """Σ (−e)^k/(2k + 1)."""
    total = 1.0 / 17
    for k in range(7, -1, -1):
        total = 1.0 / (2 * k + 1) - e * total
    return total
