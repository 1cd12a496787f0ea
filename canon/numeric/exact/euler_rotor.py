"""The flow of Ẋ = −YZ, Ẏ = ZX, Ż = −XY: the pendulum and Euler's top in disguise.

X² + Y² and Y² + Z² are constant; with Z the larger of X and Z, X = k cn, Y = k sn, Z = dn. The addition theorem takes a
state to a state, so that no phase is looked for, and works at the separatrix X² = Z², where the functions become
hyperbolic: it is reached through the complementary parameter (Z² − X²)/(Y² + Z²), factored.

Conditioning: near the separatrix errors of the state grow as e^t while Z is small, as the motion's do; else with t.
"""

from __future__ import annotations

from typing import Any, Final

LEVELS: Final = 11
"""Landen transformations: the last one that matters for any complementary parameter that is not 0."""


def rotor(X: Any, Y: Any, Z: Any, t: Any) -> tuple[Any, Any, Any]:
    """(X, Y, Z) after a time t."""
    import jax.numpy as jnp

    swap = jnp.abs(X) > jnp.abs(Z)
    small, large = jnp.where(swap, Z, X), jnp.where(swap, X, Z)
    size = jnp.sqrt(Y * Y + large * large)
    scale = jnp.where(size > 0, size, 1.0)
    P, S, C = small / scale, Y / scale, large / scale
    # where X and Z change places the third equation keeps its sign: the flow is the same
    s, c, d = sn_cn_dn(size * t, (large - small) * (large + small) / (scale * scale))
    below = C * C + (S * c) ** 2
    sn = (S * c * d + s * P * C) / below
    cn = (P * c - S * s * C * d) / below
    dn = (C * d - S * P * s * c) / below
    small, large = size * cn, size * dn
    return jnp.where(swap, large, small), size * sn, jnp.where(swap, small, large)


def sn_cn_dn(u: Any, m1: Any) -> tuple[Any, Any, Any]:
    """Jacobi's sn, cn and dn of u for the complementary parameter 0 ≤ m1 ≤ 1, by descending Landen transformations.

    Bulirsch (1965), Numer. Math. 7, 78; Abramowitz and Stegun 16.4. At m1 = 0 they are tanh and sech.
    """
    import jax.numpy as jnp
    from jax import lax

    u, m1 = jnp.broadcast_arrays(u * 1.0, jnp.clip(m1 * 1.0, 0.0, 1.0))

    def descend(pair: Any, _: Any) -> Any:
        a, b = pair
        return ((a + b) / 2, jnp.sqrt(a * b)), pair

    def ascend(loop: Any, pair: Any) -> Any:
        ratio, c, d = loop
        (upper, lower), ratio = pair, c * ratio
        c = c * d
        return (c / upper, c, (lower + ratio) / (upper + ratio)), None

    (a, _), pairs = lax.scan(descend, (jnp.ones_like(m1), jnp.sqrt(jnp.maximum(m1, 1e-300))), None, length=LEVELS)
    angle = u * a
    sine, cosine = jnp.sin(angle), jnp.cos(angle)
    ratio = cosine / jnp.where(sine == 0, 1.0, sine)
    (_, c, d), _ = lax.scan(ascend, (ratio, a * ratio, jnp.ones_like(a)), pairs, reverse=True)
    length = 1 / jnp.sqrt(c * c + 1)
    sn = jnp.where(sine < 0, -length, length)
    sn = jnp.where(sine == 0, 0.0, sn)
    cn = jnp.where(sine == 0, jnp.sign(cosine), c * sn)
    dn = jnp.where(sine == 0, 1.0, d)
    sech = 1 / jnp.cosh(u)
    flat = m1 < 1e-290
    return jnp.where(flat, jnp.tanh(u), sn), jnp.where(flat, sech, cn), jnp.where(flat, sech, dn)
