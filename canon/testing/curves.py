"""Loops and surfaces in phase space whose integrals are known, and strategies of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from canon.testing.points import phase_points

Array = np.ndarray
Vector = tuple[float, ...]


@dataclass(frozen=True)
class Loop:
    """The closed curve z(s) = c + Σ_k (a_k cos 2πks + b_k sin 2πks), k = 1, 2, …, with period 1 in s.

    **Arguments:** the `centre` c (2n,); `cosines` a_k and `sines` b_k, one (2n,) for each k. It is called with
    parameters (N,) and returns points (N, 2n).
    """

    centre: Vector
    cosines: tuple[Vector, ...]
    sines: tuple[Vector, ...]

    def __call__(self, s: Array) -> Array:
        """The points at parameters s (N,)."""
        angles = 2 * np.pi * np.multiply.outer(np.asarray(s, dtype=float), np.arange(1, len(self.cosines) + 1))
        return np.array(self.centre) + np.cos(angles) @ np.array(self.cosines) + np.sin(angles) @ np.array(self.sines)

    @property
    def integral(self) -> float:
        """∮ p dq = Σ_k k π (b_k·q a_k·p − a_k·q b_k·p), summed over degrees of freedom."""
        n = len(self.centre) // 2
        a, b = np.array(self.cosines), np.array(self.sines)
        areas = (b[:, :n] * a[:, n:] - a[:, :n] * b[:, n:]).sum(axis=1)
        return float(np.pi * (np.arange(1, len(a) + 1) * areas).sum())


@dataclass(frozen=True)
class Surface:
    """The surface z(s, t) = c + s a + t b + s t d for 0 ≤ s, t ≤ 1.

    **Arguments:** the `corner` c, the `sides` a and b, the `twist` d, each (2n,). It is called with parameters
    (s, t) of shape (N, 2) and returns points (N, 2n).
    """

    corner: Vector
    sides: tuple[Vector, Vector]
    twist: Vector

    def __call__(self, u: Array) -> Array:
        """The points at parameters u = (s, t) (N, 2)."""
        s, t = (np.asarray(u, dtype=float)[:, k, None] for k in (0, 1))
        a, b = (np.array(side) for side in self.sides)
        return np.array(self.corner) + s * a + t * b + s * t * np.array(self.twist)

    @property
    def integral(self) -> float:
        """∬ dp∧dq, with s before t: Σ (p_s q_t − p_t q_s) of the mean tangents, for these are affine."""
        n = len(self.corner) // 2
        first, second = (np.array(side) + np.array(self.twist) / 2 for side in self.sides)
        return float((first[n:] * second[:n] - second[n:] * first[:n]).sum())


@st.composite
def loops(
    draw: st.DrawFn, degrees: int, *, harmonics: int = 2, units: tuple[float, float] = (1.0, 1.0), size: float = 0.1
) -> Loop:
    """Smooth loops of a `size` in the given units of q and p; they shrink to a point at the origin."""
    points = phase_points(degrees, scales=(size,), units=units, twins=False)
    count = draw(st.integers(1, harmonics))
    return Loop(
        _vector(draw(points)),
        tuple(_vector(draw(points)) for _ in range(count)),
        tuple(_vector(draw(points)) for _ in range(count)),
    )


@st.composite
def surfaces(draw: st.DrawFn, degrees: int, *, units: tuple[float, float] = (1.0, 1.0), size: float = 0.1) -> Surface:
    """Surfaces of a `size` in the given units of q and p; they shrink to a point at the origin."""
    points = phase_points(degrees, scales=(size,), units=units, twins=False)
    corner, a, b, twist = (_vector(draw(points)) for _ in range(4))
    return Surface(corner, (a, b), twist)


def _vector(point: Array) -> Vector:
    return tuple(float(x) for x in point)
