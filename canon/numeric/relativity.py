"""Kinetic energy and momentum of a relativistic particle, from far below m c to far above it.

Conditioning: both are powers of their argument, with an exponent between 1/2 and 2, so that no digit needs to be lost;
√(p²c² + m²c⁴) − mc² loses all of them below p = 1e-8 mc.
"""

from __future__ import annotations

from typing import Any


def kinetic_energy(p: Any, *, m: Any = 1.0, c: Any = 1.0) -> Any:
    """T = √(p²c² + m²c⁴) − mc² = c p²/(√(p² + m²c²) + mc) of a momentum p, elementwise; p of any units and sign.

    Landau and Lifshitz (1975), The Classical Theory of Fields, § 9.
    """
    import jax.numpy as jnp

    rest = m * c
    return c * p * (p / (jnp.hypot(p, rest) + rest))


def momentum_of(T: Any, *, m: Any = 1.0, c: Any = 1.0) -> Any:
    """|p| = √(T (T + 2mc²))/c of a kinetic energy T ≥ 0, elementwise."""
    import jax.numpy as jnp

    return jnp.sqrt(T) * jnp.sqrt(T + 2 * m * c * c) / c
