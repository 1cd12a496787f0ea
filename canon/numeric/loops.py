"""∮ p dq around closed loops by spectral quadrature: with equidistant nodes and the derivative of the trigonometric
interpolant, the error falls faster than any power of their number for a smooth loop. Polygons converge only as its
inverse square. Trefethen and Weideman, SIAM Review 56 (2014) 385.

Conditioning: of a loop of length l at momenta up to p the points are known to roundings, and ∮ p dq to about l·p of
them, however small it is; the bound says so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import NO_NUMBER, InputError
from canon.numeric.precision import UNIT

Array = Any  # numpy arrays
Loop = Callable[[Array], Array]
Noise = Callable[[Array, Array], Array]
FIRST_NODES: Final = 32
SAFETY: Final = 8.0
BETWEEN: Final = 16
GOLDEN: Final = 0.6180339887498949
CLOSE: Final = 1e-6
"""The interpolant may miss the loop between the nodes by this part of a variable's size; so large, at most, may the
highest frequencies be."""

FEWEST: Final = 8


@dataclass(frozen=True)
class LoopIntegral:
    """∮ p dq: its `value`, a `bound` on its rounding, the number of `nodes`, and whether these `resolved` the loop.

    `change` is what the last doubling of the nodes changed; an integral that is not resolved has no digits beyond it.
    `tail` is the part that the upper half of the frequencies has in a variable: of a resolved loop, rounding.
    """

    value: float
    bound: float
    nodes: int
    resolved: bool
    change: float
    tail: float


def loop_integral(
    loop: Loop | Array,
    *,
    periods: Sequence[float | None] = (),
    noise: Noise | None = None,
    most_nodes: int = 65536,
    unit: float = UNIT,
) -> LoopIntegral:
    """∮ p dq around a closed loop, the nodes doubled until nothing changes beyond rounding.

    **Arguments:** `loop` takes parameters s (N,), with period 1, to phase points (N, 2n); or it is an array (N, 2n) of
    points at s = 0, 1/N, …, with which nothing can be refined; `periods`, for each variable that is an angle its
    period, None for the others: a loop may wind round such a coordinate; `noise`, of parameters and their points: how
    far these may be off, by default `unit` of themselves.

    **Raises:** `InputError` where the loop has another shape, isn't finite, isn't closed, or winds in a momentum.
    """
    off = noise or (lambda _, points: unit * np.abs(points))
    if not callable(loop):
        return _of_nodes(_checked(real(loop), len(loop)), periods, off, unit)
    ends = _points(loop, np.array([0.0, 1.0]))
    sizes = np.abs(_points(loop, np.arange(FIRST_NODES) * GOLDEN % 1.0)).max(axis=0)
    if np.any(np.abs(shortest(ends[1] - ends[0], periods)) > 1e-9 * sizes):
        raise InputError("the loop is not closed: its points at parameters 0 and 1 differ")
    nodes, before = FIRST_NODES, np.nan
    while True:
        s = np.arange(nodes) / nodes
        points = _points(loop, s)
        around = _unrolled(points, periods)
        value, bound, tail = _trapezoid(*around, off(s, points), unit)
        change = abs(value - before)
        resolved = bool(change <= bound) and tail <= CLOSE and _interpolates(*around, loop, sizes, periods)
        if resolved or 2 * nodes > most_nodes:
            return LoopIntegral(value, bound, nodes, resolved, change, tail)
        nodes, before = 2 * nodes, value


def _of_nodes(points: Array, periods: Sequence[float | None], noise: Noise, unit: float) -> LoopIntegral:
    """∮ p dq through given points: resolved if every second one gives the same, and the highest frequencies are low."""
    count = len(points)
    if count < FEWEST:
        raise InputError(f"a loop needs {FEWEST} points at least, not {count}", "loop")
    off = noise(np.arange(count) / count, points)
    value, bound, tail = _trapezoid(*_unrolled(points, periods), off, unit)
    half, _, _ = _trapezoid(*_unrolled(points[::2], periods), off[::2], unit)
    change = abs(value - half) if count % 2 == 0 else np.inf
    enough = change <= bound if count % 2 == 0 else tail <= np.sqrt(unit)
    return LoopIntegral(value, bound, count, bool(enough) and tail <= CLOSE, float(change), tail)


def shortest(difference: Array, periods: Sequence[float | None]) -> Array:
    """A difference of points, less the nearest whole number of periods."""
    for k, period in enumerate(periods):
        if period is not None:
            difference[..., k] -= period * np.round(difference[..., k] / period)
    return difference


def _unrolled(points: Array, periods: Sequence[float | None]) -> tuple[Array, Array]:
    """The nodes' points as periodic functions of s and, for each variable, what it gains in one turn."""
    turns = np.zeros(points.shape[1])
    if not any(periods):
        return points, turns
    if len(periods) != points.shape[1]:
        raise InputError(f"{points.shape[1]} periods are expected, None for what is no angle", "periods")
    closed = np.concatenate([points, points[:1]])
    for k, period in enumerate(periods):
        if period is not None:
            closed[:, k] = np.unwrap(closed[:, k], period=period)
            turns[k] = period * np.round((closed[-1, k] - closed[0, k]) / period)
    if np.any(turns[len(turns) // 2 :]):
        raise InputError("the loop winds in a momentum: p dq is not defined on such a phase space", "periods")
    return closed[:-1] - np.outer(np.arange(len(points)) / len(points), turns), turns


def _points(loop: Loop, s: Array) -> Array:
    return _checked(real(loop(s)), len(s))


def real(points: Any) -> Array:
    """Points of a loop or a surface as an array of floats. **Raises:** `InputError` for complex ones, or no numbers."""
    try:
        found = np.asarray(points)
        if np.iscomplexobj(found):
            raise InputError("a loop or surface has real points, not complex ones")
        return found.astype(float)
    except NO_NUMBER as reason:
        raise InputError(f"a loop or surface has numbers for points, not {type(points).__name__}") from reason


def _checked(points: Array, count: int) -> Array:
    if points.ndim != 2 or len(points) != count or points.shape[1] % 2 or not points.shape[1]:
        raise InputError(f"a loop takes parameters (N,) to phase points (N, 2n), not to shape {points.shape}")
    if not np.all(np.isfinite(points)):
        raise InputError("the loop has a point that is not finite")
    return points


def _interpolates(points: Array, turns: Array, loop: Loop, sizes: Array, periods: Sequence[float | None]) -> bool:
    """Whether the trigonometric interpolant meets the loop between the nodes too: two sums may agree by chance."""
    count = len(points)
    s = np.arange(1, BETWEEN + 1) * GOLDEN % 1.0
    modes = np.fft.fft(points, axis=0) / count
    waves = np.fft.fftfreq(count, 1 / count)
    values = np.real(np.exp(2j * np.pi * s[:, None] * waves) @ modes) + np.outer(s, turns)
    return bool(np.all(np.abs(shortest(values - _points(loop, s), periods)) <= CLOSE * sizes))


def _trapezoid(points: Array, turns: Array, off: Array, unit: float) -> tuple[float, float, float]:
    """Σ p dq/ds / N with the spectral derivative, a bound on its rounding, and the tail.

    Errors `off` of the nodes that are independent of each other spread evenly over the modes, and a mode's error is
    multiplied by its wave number: each mode of q and of p is taken to be off by as much. Errors that vary slowly along
    the loop stay in the low modes, and add to the integral as they are. A coordinate that gains `turns` in one turn
    adds that times the mean of its momentum.
    """
    count, size = points.shape
    n = size // 2
    q, p = points[:, :n], points[:, n:]
    waves = np.fft.fftfreq(count, 1 / count)[:, None]
    upper = (4 * np.abs(waves) > count).ravel()
    if count % 2 == 0:
        waves[count // 2] = 0.0
    a, b = np.fft.fft(q, axis=0) / count, np.fft.fft(p, axis=0) / count
    winding = float(turns[:n] @ p.mean(axis=0))
    value = float(2 * np.pi * np.real(np.sum(1j * waves * a * np.conj(b)))) + winding
    sizes = np.abs(points).max(axis=0)
    mean = np.sqrt(np.mean(off**2, axis=0))
    level = SAFETY / np.sqrt(count) * (mean + unit * np.log2(count) * sizes)
    wide = np.abs(waves) * (np.abs(a) * level[n:] + level[:n] * np.abs(b) + level[:n] * level[n:])
    # the independent errors of the modes add in quadrature; the products themselves round too
    apart = 2 * np.pi * np.sqrt(np.sum(wide**2)) * SAFETY
    slow = 2 * np.pi * np.sum(np.abs(waves) * (np.abs(a) * mean[n:] + mean[:n] * np.abs(b)))
    rounding = SAFETY * unit * (2 * np.pi * np.sum(np.abs(waves) * np.abs(a) * np.abs(b)) + abs(winding))
    rounding = rounding + np.abs(turns[:n]) @ mean[n:]
    high = np.abs(np.hstack([a, b]))[upper] / np.where(sizes > 0, sizes, 1.0)
    return value, float(apart + slow + rounding), float(high.max(initial=0.0))
