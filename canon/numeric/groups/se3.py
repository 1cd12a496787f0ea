"""SE(3): rotations with translations, x → R x + b.

Conditioning: that of `so3`; b and v are linear in each other by a matrix of condition (|ω|/2)/sin(|ω|/2), at most π/2
for |ω| ≤ π.
"""

from __future__ import annotations

from typing import Any

from canon.numeric.exact.stumpff import stumpff, stumpff_4
from canon.numeric.groups import so3


def exp(omega: Any, v: Any) -> tuple[Any, Any]:
    """(R, b) of the twist (ω, v): R = exp ω, b = (1 + c₂ hat(ω) + c₃ hat(ω)²) v, with Stumpff's c_k(|ω|²).

    Murray, Li and Sastry, A Mathematical Introduction to Robotic Manipulation (1994), eq. 2.36.
    """
    import jax.numpy as jnp

    _, _, c2, c3 = stumpff(jnp.sum(omega * omega, -1))
    once = jnp.cross(omega, v)
    return so3.exp(omega), v + c2[..., None] * once + c3[..., None] * jnp.cross(omega, once)


def log(R: Any, b: Any) -> tuple[Any, Any]:
    """The twist (ω, v), |ω| ≤ π, of a motion: v = b − ω × b / 2 + (c₃/2 − c₄)/c₂ ω × (ω × b)."""
    import jax.numpy as jnp

    omega = so3.log(R)
    psi = jnp.sum(omega * omega, -1)
    _, _, c2, c3 = stumpff(psi)
    factor = (c3 / 2 - stumpff_4(psi)) / c2
    once = jnp.cross(omega, b)
    return omega, b - once / 2 + factor[..., None] * jnp.cross(omega, once)
