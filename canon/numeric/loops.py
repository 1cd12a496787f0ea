"""∮ p dq around closed loops by spectral quadrature: with equidistant nodes and the derivative of the trigonometric
interpolant, the error falls faster than any power of their number for a smooth loop. Polygons converge only as its
inverse square. Trefethen and Weideman, SIAM Review 56 (2014) 385.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from canon.errors import InputError
from canon.numeric.precision import UNIT

Array = np.ndarray
Loop = Callable[[Array], Array]
FIRST_NODES: Final = 32
SAFETY: Final = 8.0
BETWEEN: Final = 16
GOLDEN: Final = 0.6180339887498949
CLOSE: Final = 1e-6
"""The interpolant may miss the loop between the nodes by this part of a variable's size."""


@dataclass(frozen=True)
class LoopIntegral:
    """∮ p dq: its `value`, a `bound` on its rounding, the number of `nodes`, and whether these `resolved` the loop.

    `change` is what the last doubling of the nodes changed; an integral that is not resolved has no digits beyond it.
    """

    value: float
    bound: float
    nodes: int
    resolved: bool
    change: float


@dataclass(frozen=True)
class LoopComparison:
    """∮ p dq around a loop, and around its image under a map: the relative integral invariant of Poincaré."""

    before: LoopIntegral
    after: LoopIntegral

    @property
    def difference(self) -> float:
        """∮ P dQ − ∮ p dq."""
        return self.after.value - self.before.value

    @property
    def bound(self) -> float:
        """A bound on the difference's rounding."""
        return self.before.bound + self.after.bound

    @property
    def preserved(self) -> bool | None:
        """Whether the difference is within its bound; None where a loop is not resolved, so that nothing is known."""
        if not (self.before.resolved and self.after.resolved):
            return None
        return abs(self.difference) <= self.bound


def loop_integral(loop: Loop, *, most_nodes: int = 65536, unit: float = UNIT) -> LoopIntegral:
    """∮ p dq around a closed loop, the nodes doubled until nothing changes beyond rounding.

    **Arguments:** `loop` takes parameters s (N,), with period 1, to phase points (N, 2n); `unit`, the relative rounding
    of its values: what a long computation of a point adds to that is not known here.

    **Raises:** `InputError` where the loop has another shape, isn't finite, or isn't closed.
    """
    ends = _points(loop, np.array([0.0, 1.0]))
    sizes = np.abs(_points(loop, np.arange(FIRST_NODES) * GOLDEN % 1.0)).max(axis=0)
    if np.any(np.abs(ends[1] - ends[0]) > 1e-9 * sizes):
        raise InputError("the loop is not closed: its points at parameters 0 and 1 differ")
    nodes, before = FIRST_NODES, np.nan
    while True:
        points = _points(loop, np.arange(nodes) / nodes)
        value, bound = _trapezoid(points, unit)
        change = abs(value - before)
        resolved = bool(change <= bound) and _interpolates(points, loop, sizes)
        if resolved or 2 * nodes > most_nodes:
            return LoopIntegral(value, bound, nodes, resolved, change)
        nodes, before = 2 * nodes, value


def compare_loops(map: Callable[[Array], Array], loop: Loop, *, most_nodes: int = 65536) -> LoopComparison:  # noqa: A002
    """∮ p dq around the loop, and around its image under a map of points (N, 2n)."""
    before = loop_integral(loop, most_nodes=most_nodes)
    after = loop_integral(lambda s: map(loop(s)), most_nodes=most_nodes)
    return LoopComparison(before, after)


def _points(loop: Loop, s: Array) -> Array:
    points = np.asarray(loop(s), dtype=float)
    if points.ndim != 2 or len(points) != len(s) or points.shape[1] % 2 or not points.shape[1]:
        raise InputError(f"a loop takes parameters (N,) to phase points (N, 2n), not to shape {points.shape}")
    if not np.all(np.isfinite(points)):
        raise InputError("the loop has a point that is not finite")
    return points


def _interpolates(points: Array, loop: Loop, sizes: Array) -> bool:
    """Whether the trigonometric interpolant meets the loop between the nodes too: two sums may agree by chance."""
    count = len(points)
    s = np.arange(1, BETWEEN + 1) * GOLDEN % 1.0
    modes = np.fft.fft(points, axis=0) / count
    waves = np.fft.fftfreq(count, 1 / count)
    values = np.real(np.exp(2j * np.pi * s[:, None] * waves) @ modes)
    return bool(np.all(np.abs(values - _points(loop, s)) <= CLOSE * sizes))


def _trapezoid(points: Array, unit: float) -> tuple[float, float]:
    """Σ p dq/ds / N with the spectral derivative, and a bound on its rounding.

    A node's rounding spreads evenly over the modes, and a mode's error is multiplied by its wave number: each mode of q
    and of p is taken to be off by as much, and these errors to be independent of each other.
    """
    count, size = points.shape
    q, p = points[:, : size // 2], points[:, size // 2 :]
    waves = np.fft.fftfreq(count, 1 / count)[:, None]
    waves[count // 2] = 0.0
    a, b = np.fft.fft(q, axis=0) / count, np.fft.fft(p, axis=0) / count
    value = float(2 * np.pi * np.real(np.sum(1j * waves * a * np.conj(b))))
    level = SAFETY * unit / np.sqrt(count) * np.log2(count)
    off_q, off_p = level * np.abs(q).max(axis=0), level * np.abs(p).max(axis=0)
    off = np.abs(waves) * (np.abs(a) * off_p + off_q * np.abs(b) + off_q * off_p)
    # the independent roundings of the modes add in quadrature; the products themselves round too
    total = 2 * np.pi * np.sqrt(np.sum(off**2)) * SAFETY
    rounding = SAFETY * unit * 2 * np.pi * float(np.sum(np.abs(waves) * np.abs(a) * np.abs(b)))
    return value, float(total) + rounding
