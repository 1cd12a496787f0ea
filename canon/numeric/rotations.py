"""Unit quaternions (w, x, y, z) as rotations, with components on the first axis; q v q* takes body to space.

Conditioning: a quaternion knows θ next to 0 or π to a part of itself, and (φ ± ψ)/2 to roundings of a turn.
"""

from __future__ import annotations

from typing import Any, Final

_NEAR: Final = 0.01
"""Squares of half angles below which a few terms of a series are exact."""


def multiply(a: Any, b: Any) -> Any:
    """Hamilton's product: first the rotation b, then a."""
    import jax.numpy as jnp

    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return jnp.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ]
    )


def conjugate(a: Any) -> Any:
    """The inverse of a unit quaternion."""
    import jax.numpy as jnp

    return jnp.stack([a[0], -a[1], -a[2], -a[3]])


def rotate(a: Any, v: Any) -> Any:
    """a v a*: the vector (3, …) in space of one in the body."""
    import jax.numpy as jnp

    w, x, y, z = a
    u = jnp.stack([x, y, z])
    twice = 2 * cross(u, v)
    return v + w * twice + cross(u, twice)


def matrix(a: Any) -> Any:
    """The rotation's matrix (3, 3, …), body to space."""
    import jax.numpy as jnp

    w, x, y, z = a
    return jnp.stack(
        [
            jnp.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)]),
            jnp.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)]),
            jnp.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]),
        ]
    )


def about_axis(axis: int, angle: Any) -> Any:
    """The rotation by an angle about a coordinate axis."""
    import jax.numpy as jnp

    zero = jnp.zeros_like(angle)
    parts = [jnp.cos(angle / 2), zero, zero, zero]
    parts[axis + 1] = jnp.sin(angle / 2)
    return jnp.stack(parts)


def about_vector(vector: Any) -> Any:
    """The rotation by |v| about v; the identity for v = 0."""
    import jax.numpy as jnp

    square = (vector[0] ** 2 + vector[1] ** 2 + vector[2] ** 2) / 4
    near = square < _NEAR
    half = jnp.sqrt(jnp.where(near, 1.0, square))
    # both are even: near 0 the root, which has no derivative there, is left out
    sinc = 1 - square / 6 * (1 - square / 20 * (1 - square / 42 * (1 - square / 72)))
    cosine = 1 - square / 2 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56)))
    sinc, cosine = jnp.where(near, sinc, jnp.sin(half) / half), jnp.where(near, cosine, jnp.cos(half))
    return jnp.concatenate([cosine[None], sinc * vector / 2])


def normalised(a: Any) -> Any:
    """A quaternion that is nearly a unit one, with its norm put right to second order."""
    return a * (1.5 - 0.5 * (a[0] ** 2 + a[1] ** 2 + a[2] ** 2 + a[3] ** 2))


def cross(a: Any, b: Any) -> Any:
    """The vector product of (3, …) and (3, …)."""
    import jax.numpy as jnp

    return jnp.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def from_euler(phi: float, theta: float, psi: float) -> Any:
    """The attitude of z-x-z Euler angles: turned by φ about z, by θ about the line of nodes, by ψ about the new z."""
    import jax.numpy as jnp

    angles = [jnp.asarray(angle, dtype=float) for angle in (phi, theta, psi)]
    return multiply(multiply(about_axis(2, angles[0]), about_axis(0, angles[1])), about_axis(2, angles[2]))


def to_euler(a: Any) -> tuple[Any, Any, Any]:
    """The z-x-z Euler angles (φ, θ, ψ) of an attitude, 0 ≤ θ ≤ π, φ and ψ in (−π, π].

    tan θ/2 = |(x, y)|/|(w, z)| keeps its digits at θ = 0 and θ = π, and (φ ± ψ)/2 are the angles of (w, z) and (x, y),
    which a quaternion knows to all digits at gimbal lock too. Where θ is 0 or π exactly only one of them exists: then
    ψ is 0.
    """
    import jax.numpy as jnp

    w, x, y, z = a
    along, across = jnp.arctan2(z, w), jnp.arctan2(y, x)
    upright, over = jnp.hypot(x, y), jnp.hypot(w, z)
    along, across = jnp.where(over == 0, across, along), jnp.where(upright == 0, along, across)
    wrapped = lambda angle: angle - 2 * jnp.pi * jnp.round(angle / (2 * jnp.pi))
    return wrapped(along + across), 2 * jnp.arctan2(upright, over), wrapped(along - across)


def momentum_in_body(theta: Any, psi: Any, p_phi: Any, p_theta: Any, p_psi: Any) -> Any:
    """The angular momentum (3, …) in the body's frame, of the momenta conjugate to z-x-z Euler angles.

    Its component across the line of nodes, (p_φ − p_ψ cos θ)/sin θ, is (p_φ − p_ψ)/sin θ + p_ψ tan θ/2, and likewise
    from θ = π: where p_φ = ±p_ψ it stays finite and keeps its digits. Goldstein, Poole and Safko (2002), 5.7.
    """
    import jax.numpy as jnp

    near = jnp.tan(theta / 2)
    upper = (p_phi - p_psi) / jnp.sin(theta) + p_psi * near
    lower = (p_phi + p_psi) / jnp.sin(theta) - p_psi / near
    along = jnp.where(p_phi == p_psi, p_psi * near, jnp.where(jnp.abs(near) <= 1, upper, lower))
    c, s = jnp.cos(psi), jnp.sin(psi)
    return jnp.stack([along * s + p_theta * c, along * c - p_theta * s, p_psi + 0.0 * along])
