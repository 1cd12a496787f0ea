"""Integrators and maps of which it is known whether they are symplectic."""

from typing import Any

import numpy as np

Array = np.ndarray
H = 0.1


def leapfrog(q: Any, p: Any) -> Any:
    """Kick, drift, kick of two pendulums."""
    p = p - H / 2 * np.sin(q)
    q = q + H * p
    return q, p - H / 2 * np.sin(q)


def mistaken_leapfrog(q: Any, p: Any) -> Any:
    """The second kick with the force at the old positions."""
    half = p - H / 2 * np.sin(q)
    return q + H * half, half - H / 2 * np.sin(q)


def field(z: Array) -> Array:
    return np.array([z[1], -np.sin(z[0])])


def rk4(z: Array) -> Array:
    a = field(z)
    b = field(z + H / 2 * a)
    c = field(z + H / 2 * b)
    d = field(z + H * c)
    return z + H / 6 * (a + 2 * b + 2 * c + d)


def velocity_verlet(z: Array) -> Array:
    q, v = z
    moved = q + H * v - H**2 / 2 * np.sin(q)
    return np.array([moved, v - H / 2 * (np.sin(q) + np.sin(moved))])


def implicit_midpoint(z: Array) -> Array:
    y = z
    for _ in range(40):
        y = z + H * field((z + y) / 2)
    return y


def symplectic_euler(z: Array) -> Array:
    p = z[1] - H * np.sin(z[0])
    return np.array([z[0] + H * p, p])


def standard_map(z: Array) -> Array:
    p = z[1] + 0.9 * np.sin(z[0])
    return np.array([np.mod(z[0] + p, 2 * np.pi), p])


def henon_map(z: Array) -> Array:
    """The area-preserving one: a shear, then a rotation."""
    c, s = np.cos(0.5), np.sin(0.5)
    kicked = z[1] - z[0] ** 2
    return np.array([c * z[0] - s * kicked, s * z[0] + c * kicked])


def henon_attractor(z: Array) -> Array:
    """Hénon's dissipative map, det M = −0.3."""
    return np.array([1 - 1.4 * z[0] ** 2 + z[1], 0.3 * z[0]])
