"""∬ Σ dp∧dq over parametrised surfaces, and the higher of Poincaré's absolute integral invariants.

With ω = Σ dp_i∧dq_i the invariant of order k is the integral of ωᵏ/k! over a surface of 2k dimensions: the sum of the
oriented areas of its projections onto all sets of k conjugate pairs. In parameters u it is ∫ Pf(ω(∂_a x, ∂_b x)) du.
Arnold, Mathematical Methods of Classical Mechanics (1989), section 44. Derivatives and quadrature are spectral.

Conditioning: points are known to roundings, so that the integral over a surface of size l at momenta up to p is known
to roundings of l·p, however small it is; the bound says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import listed, yes_or_no
from canon.numeric.loops import real
from canon.numeric.pfaffians import pfaffians
from canon.numeric.precision import UNIT
from canon.numeric.quadrature import Grid, grid

Array = Any  # numpy arrays
Surface = Callable[[Array], Array]
Noise = Callable[[Array, Array], Array]

FIRST_NODES: Final = {1: 16, 2: 6, 3: 3}
MOST_POINTS: Final = {1: 2**18, 2: 2**18}
"""On one grid, unless it is said otherwise; 2²⁰ for higher orders."""
AS_ROUGH: Final = 1e-3
"""Directions with tails of this part of the largest one are refined together with it, on surfaces of order 2 and up."""
SLAB: Final = 4096
"""So many points are looked at together there."""
FAST: Final = 0.05
"""Where a change is this part of the one before, at most, convergence is geometric, and what remains is estimated."""
FASTEST: Final = 1e-3
"""No faster convergence is relied on."""
SAFETY: Final = 4.0
MATRIX_ULPS: Final = 4.0
"""The rounding of a differentiation matrix, in units of roundoff of each entry."""

BETWEEN: Final = 8
GOLDEN: Final = 0.6180339887498949
CLOSE: Final = 1e-6
"""The interpolant may miss the surface between the nodes by this part of a variable's size."""

TAIL: Final = 1e-6
"""The highest frequencies may be this part of a variable's size."""


@dataclass(frozen=True)
class SurfaceIntegral:
    """∫ ωᵏ/k!: its `value`, a `bound` on its rounding, the `nodes` in each direction, and whether these `resolved` it.

    `change` is the most that the last doubling of the nodes of a direction changed; an integral that is not resolved
    has no digits beyond it. `tail` is the part that the highest frequencies have in the surface.
    """

    value: float
    bound: float
    nodes: tuple[int, ...]
    resolved: bool
    change: float
    tail: float


def surface_integral(
    surface: Surface,
    periodic: Sequence[bool],
    *,
    noise: Noise | None = None,
    most_points: int | None = None,
    unit: float = UNIT,
) -> SurfaceIntegral:
    """∫ ωᵏ/k! over a surface of 2k dimensions; nodes are added until nothing changes beyond rounding.

    For k = 1 they are doubled, direction by direction; for k > 1, where each doubling would cost the most, their number
    grows by a third, in all directions together that are as rough as the roughest.

    **Arguments:** `surface` takes parameters u (N, 2k) in [0, 1]²ᵏ to phase points (N, 2n); `periodic`, 2k booleans:
    which directions close (trapezoid rule; the others have Gauss–Legendre nodes); `noise`, of parameters and their
    points: how far the points may be off, by default `unit` of themselves; `most_points`, on one grid, by default 2¹⁸
    for k = 1 and 2, 2²⁰ for more.

    **Raises:** `InputError` where the surface has another shape, isn't finite, or doesn't close where it should.
    """
    directions = list(listed(periodic, "True or False", "periodic"))
    for closed in directions:
        yes_or_no(closed, "periodic")
    size = len(directions)
    if size < 2 or size % 2:
        raise InputError(f"a surface has 2, 4, 6, … directions, not {size}", "periodic")
    off = noise or (lambda _, points: unit * np.abs(points))
    most = most_points or MOST_POINTS.get(size // 2, 2**20)
    counts = [FIRST_NODES.get(size // 2, 2)] * size
    if math.prod(counts) > most:
        raise InputError(f"a grid of {size} directions has more than {most} points", "periodic")
    now = _on_grid(surface, counts, directions, off, unit)
    if now.points.shape[-1] < size:
        raise InputError(f"a phase space of {now.points.shape[-1]} dimensions has no surface of {size}", "surface")
    _check_closed(surface, directions)
    settled, changes, remaining = [False] * size, [math.inf] * size, [math.inf] * size
    while True:
        tails = now.tails()
        if all(settled):
            if max(tails) <= TAIL and _interpolates(surface, now):
                bound = now.bound + (0.0 if size == 2 else max(remaining))
                return SurfaceIntegral(now.value, bound, tuple(counts), True, max(changes), max(tails))
            settled = [False] * size
        larger = _refined(counts, tails, settled, most)
        if larger is None:
            return SurfaceIntegral(now.value, now.bound, tuple(counts), False, max(changes), max(tails))
        counts, before, old = larger, now.value, counts
        now = _on_grid(surface, counts, directions, off, unit)
        for axis in (a for a in range(size) if counts[a] > old[a]):
            last, changes[axis] = changes[axis], abs(now.value - before)
            remaining[axis] = changes[axis] if size == 2 else _remaining(last, changes[axis])
            settled[axis] = remaining[axis] <= now.bound


def _remaining(last: float, change: float) -> float:
    """What further nodes may still change, after two changes: less than the last one where they fall geometrically."""
    rate = change / last if 0 < last < math.inf else 1.0
    return change if rate > FAST else SAFETY * change * max(rate, FASTEST)


def _refined(counts: Sequence[int], tails: Sequence[float], settled: Sequence[bool], most: int) -> list[int] | None:
    """More nodes in the roughest direction that isn't settled, on surfaces of order 2 and up in all that are about as
    rough; None where the grid would have more than `most` points.
    """
    size = len(counts)
    roughest = max((a for a in range(size) if not settled[a]), key=lambda a: (tails[a], -counts[a]))
    if size == 2:
        larger = [2 * c if a == roughest else c for a, c in enumerate(counts)]
        return larger if math.prod(larger) <= most else None
    rough = {a for a in range(size) if not settled[a] and tails[a] >= AS_ROUGH * tails[roughest]}
    for chosen in (rough, {roughest}):
        larger = [c + max(1, c // 3) if a in chosen else c for a, c in enumerate(counts)]
        if math.prod(larger) <= most:
            return larger
    return None


@dataclass(frozen=True)
class _OnGrid:
    """A surface's points on a grid (one axis a direction, then the variables), and the integral over it."""

    grids: tuple[Grid, ...]
    points: Array
    value: float
    bound: float

    def tails(self) -> list[float]:
        """For each direction the part that its highest frequencies have."""
        sizes = np.abs(self.points).reshape(-1, self.points.shape[-1]).max(axis=0)
        sizes = np.where(sizes > 0, sizes, 1.0)
        return [float((g.tail(self.points, axis) / sizes).max()) for axis, g in enumerate(self.grids)]


def _on_grid(surface: Surface, counts: Sequence[int], periodic: Sequence[bool], noise: Noise, unit: float) -> _OnGrid:
    grids = tuple(grid(count, closed) for count, closed in zip(counts, periodic, strict=True))
    u = np.stack([x.ravel() for x in np.meshgrid(*(g.x for g in grids), indexing="ij")], axis=1)
    flat = _points(surface, u)
    off = np.sqrt(np.mean(noise(u, flat) ** 2, axis=0))
    off = np.hypot(off, MATRIX_ULPS * unit * np.abs(flat).max(axis=0))
    points = flat.reshape(*counts, -1)
    total, bound = (_by_slabs if len(grids) > 2 else _of_two_dimensions)(grids, points, off)
    return _OnGrid(grids, points, float(total), float(bound))


def _of_two_dimensions(grids: Sequence[Grid], points: Array, off: Array) -> tuple[Array, Array]:
    """The integral, and what rounding and errors of the points, `off` in each variable, make of it.

    A direction's differentiation makes errors larger. They are taken to be independent of each other along the
    direction, where they add in quadrature; across it the rounding of the matrix is the same everywhere, and they add
    up.
    """
    counts = [g.count for g in grids]
    flat = points.reshape(-1, points.shape[-1])
    tangents = np.stack([g.derivative(points, axis).reshape(flat.shape).T for axis, g in enumerate(grids)])
    weights = np.multiply.outer(grids[0].weights, grids[1].weights).ravel()
    total, bound = (weights @ part for part in pfaffians(tangents))
    larger = [_along(g.amplification(), axis, counts) * off[:, None] for axis, g in enumerate(grids)]
    for axis in range(2):
        errors = np.zeros_like(tangents)
        errors[axis] = larger[axis]
        added = (weights * pfaffians(tangents, errors)[1]).reshape(counts)
        bound = bound + SAFETY * np.sqrt(np.sum(added.sum(axis=1 - axis) ** 2))
    everywhere = np.full_like(tangents, 2 * np.pi) * off[:, None]
    return total, bound + weights @ pfaffians(tangents, everywhere)[1]


def _by_slabs(grids: Sequence[Grid], points: Array, off: Array) -> tuple[Array, Array]:
    """The same in more dimensions, where errors of points add up: slab by slab, each with one node in the first few
    directions, so that derivatives of all points are never there at once.
    """
    stacked = np.ascontiguousarray(np.moveaxis(points, -1, 0))
    width, counts, larger = len(stacked), [g.count for g in grids], [g.amplification() for g in grids]
    lead = next(k for k in range(2, len(grids) + 1) if math.prod(counts[k:]) <= SLAB or k == len(grids) - 1)
    inner = np.ones(1)
    for g in grids[lead:]:
        inner = np.multiply.outer(inner, g.weights).ravel()
    errors = np.empty((len(grids), width, len(inner)))
    for axis in range(lead, len(grids)):
        errors[axis] = _along(larger[axis], axis - lead, counts[lead:]) * off[:, None]
    tangents = np.empty_like(errors)
    total: Array = 0.0
    bound: Array = 0.0
    for index in np.ndindex(*counts[:lead]):
        weight = 1.0
        for axis, k in enumerate(index):
            line = stacked[(slice(None), *index[:axis], slice(None), *index[axis + 1 :])]
            tangents[axis] = np.tensordot(grids[axis].matrix[k], line, axes=(0, 1)).reshape(width, -1)
            errors[axis] = larger[axis][k] * off[:, None]
            weight *= grids[axis].weights[k]
        here = stacked[(slice(None), *index)]
        for axis in range(lead, len(grids)):
            tangents[axis] = grids[axis].derivative(here, 1 + axis - lead).reshape(width, -1)
        values, rounding = pfaffians(tangents, errors)
        total = total + weight * (inner @ values)
        bound = bound + weight * (inner @ rounding)
    return total, bound


def _along(values: Array, axis: int, counts: Sequence[int]) -> Array:
    shape = [-1 if a == axis else 1 for a in range(len(counts))]
    return np.broadcast_to(values.reshape(shape), tuple(counts)).ravel()


def _points(surface: Surface, u: Array) -> Array:
    points = real(surface(u))
    if points.ndim != 2 or len(points) != len(u) or points.shape[1] % 2 or not points.shape[1]:
        raise InputError(
            f"a surface takes parameters (N, {u.shape[1]}) to phase points (N, 2n), not to shape {points.shape}"
        )
    finite = np.isfinite(points).all(axis=1)
    if not finite.all():
        where = ", ".join(f"{x:.6g}" for x in u[~finite][0])
        raise InputError(f"the surface has a point that is not finite, at parameters {where}")
    return points


def _scattered(count: int, size: int) -> Array:
    """Parameters that lie on no grid."""
    steps = GOLDEN ** np.arange(1, size + 1)
    return (np.arange(1, count + 1)[:, None] * steps) % 1.0


def _check_closed(surface: Surface, periodic: Sequence[bool]) -> None:
    """Raise where a direction that should close has different points at 0 and 1."""
    inside = _scattered(BETWEEN, len(periodic))
    sizes = np.abs(_points(surface, inside)).max(axis=0)
    for axis in (a for a, closed in enumerate(periodic) if closed):
        ends = inside.copy(), inside.copy()
        ends[0][:, axis], ends[1][:, axis] = 0.0, 1.0
        first, last = (_points(surface, u) for u in ends)
        if np.any(np.abs(first - last) > 1e-9 * np.maximum(sizes, np.abs(first))):
            raise InputError(f"the surface does not close in direction {axis + 1}: its points at 0 and 1 differ")


def _interpolates(surface: Surface, found: _OnGrid) -> bool:
    """Whether the interpolant meets the surface between the nodes too: two sums may agree by chance."""
    u = _scattered(BETWEEN, len(found.grids))
    exact = _points(surface, u)
    sizes = np.abs(found.points).reshape(-1, exact.shape[1]).max(axis=0)
    for place, expected in zip(u, exact, strict=True):
        value = found.points
        for x, g in zip(place, found.grids, strict=True):
            value = np.tensordot(g.interpolation(np.array([x]))[0], value, axes=(0, 0))
        if np.any(np.abs(value - expected) > CLOSE * np.maximum(sizes, np.abs(expected))):
            return False
    return True
