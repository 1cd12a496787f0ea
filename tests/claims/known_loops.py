"""A loop, a surface, and steps of which it is known what they do to areas."""

import numpy as np

Array = np.ndarray
TURN = 2 * np.pi


def ellipse(s: Array) -> Array:
    """Half-axes 2 and 0.7: ∮ p dq = −1.4 π."""
    return np.stack([0.3 + 2 * np.cos(TURN * s), 1 + 0.7 * np.sin(TURN * s)], axis=1)


def disc(u: Array) -> Array:
    """The ellipse filled: by Stokes's theorem ∬ dp∧dq = −1.4 π too."""
    r, angle = u[:, 0], TURN * u[:, 1]
    return np.stack([0.3 + 2 * r * np.cos(angle), 1 + 0.7 * r * np.sin(angle)], axis=1)


def leapfrog(q: Array, p: Array, h: float = 0.1) -> tuple[Array, Array]:
    for _ in range(10):
        p = p - h / 2 * np.sin(q)
        q = q + h * p
        p = p - h / 2 * np.sin(q)
    return q, p


def henon(z: Array) -> Array:
    return np.array([1 - 1.4 * z[0] ** 2 + z[1], 0.3 * z[0]])


def damped(q: Array, p: Array) -> tuple[Array, Array]:
    """Multiplies areas by 0.9, wherever they are."""
    return q + 0.1 * p, 0.9 * p
