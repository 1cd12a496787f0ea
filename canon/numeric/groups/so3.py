"""SO(3): rotations of space by vectors, and back.

Conditioning: the vector of a rotation is known to the roundings of the matrix, relative to itself next to 0 and next to
π alike; a vector of so many radians is rounded to as many roundings of a turn.
"""

from __future__ import annotations

from typing import Any

from canon.numeric.exact.stumpff import stumpff

SMALL = 1e-3
"""Below this sine the arc is taken from its series, which the derivative needs at 0."""


def hat(v: Any) -> Any:
    """The antisymmetric matrix (…, 3, 3) of a vector (…, 3): hat(v) x = v × x."""
    import jax.numpy as jnp

    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    zero = jnp.zeros_like(x)
    rows = [jnp.stack(row, -1) for row in ((zero, -z, y), (z, zero, -x), (-y, x, zero))]
    return jnp.stack(rows, -2)


def exp(v: Any) -> Any:
    """The active rotation (…, 3, 3) by |v| about v: 1 + c₁ hat(v) + c₂ hat(v)², with Stumpff's c_k(|v|²).

    Rodrigues' formula; Goldstein, Poole and Safko (2002), eq. 4.62.
    """
    import jax.numpy as jnp

    _, c1, c2, _ = stumpff(jnp.sum(v * v, -1))
    K = hat(v)
    return jnp.eye(3) + c1[..., None, None] * K + c2[..., None, None] * (K @ K)


def log(R: Any) -> Any:
    """The vector (…, 3) of a rotation, of length at most π; at π one of the two, ± v.

    By the unit quaternion, read from the column of 4 q qᵀ with the largest diagonal entry, so that no angle is special.
    Shepperd, J. Guidance and Control 1 (1978) 223.
    """
    q = quaternion(R)
    return 2 * vector_of(q)


def quaternion(R: Any) -> Any:
    """The unit quaternion (…, 4), first component not negative, of a rotation."""
    import jax.numpy as jnp

    t = jnp.trace(R, axis1=-2, axis2=-1)
    w = jnp.stack([R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]], -1)
    inner = R + jnp.swapaxes(R, -1, -2) + (1 - t)[..., None, None] * jnp.eye(3)
    top = jnp.concatenate([(1 + t)[..., None], w], -1)[..., None, :]
    whole = jnp.concatenate([top, jnp.concatenate([w[..., :, None], inner], -1)], -2)
    q = largest_column(whole)
    return jnp.where(q[..., :1] < 0, -q, q)


def largest_column(outer: Any) -> Any:
    """q (…, n) of unit length from c q qᵀ, c > 0: its column with the largest diagonal entry, normalised."""
    import jax.numpy as jnp

    k = jnp.argmax(jnp.diagonal(outer, axis1=-2, axis2=-1), -1)
    column = jnp.take_along_axis(outer, k[..., None, None], -1)[..., 0]
    return column / jnp.sqrt(jnp.sum(column * column, -1, keepdims=True))


def vector_of(q: Any) -> Any:
    """The vector u a of q = (cos a, u sin a), u of unit length, 0 ≤ a ≤ π; for q = −1, π about the first axis."""
    import jax.numpy as jnp

    w, u = q[..., 0], q[..., 1:]
    square = jnp.sum(u * u, -1)
    small = square < SMALL**2
    sine = jnp.sqrt(jnp.where(small, 1.0, square))
    series = 1 + square / 6 + 3 * square**2 / 40  # asin(s)/s
    arc = jnp.where(small, series, jnp.arctan2(sine, w) / sine)
    turned = small & (w < 0)
    length = jnp.sqrt(jnp.where(square > 0, square, 1.0))
    first = jnp.broadcast_to(jnp.array([1.0, 0.0, 0.0], dtype=u.dtype), u.shape)
    direction = jnp.where((square > 0)[..., None], u / length[..., None], first)
    whole = (jnp.pi - length * series * (square > 0))[..., None] * direction
    return jnp.where(turned[..., None], whole, arc[..., None] * u)
