"""The symplectic map near a map f, by a generating function that is integrated along rays.

In mixed variables u = (x, y) a symplectic map has dF = θ(u), where θ holds the other variables, with their signs. The θ
of an f that is nearly symplectic isn't closed, but F(u) = ∫₀¹ θ(u₀ + s(u − u₀))·(u − u₀) ds is a function all the same,
and it generates a symplectic map that differs from f by no more than the homotopy operator makes of dθ. The integral is
a Gauss–Legendre sum; with any number of nodes that sum is a function, so its gradient, which is known from f and its
Jacobian, generates an exactly symplectic map. Poincaré's lemma: Arnold (1989), section 36.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.numeric.map_shape import of_any_form
from canon.numeric.mixed_variables import Pattern
from canon.numeric.precision import UNIT

Array = np.ndarray
INNER: Final = 30
OUTER: Final = 40
LEAST_BLOCK: Final = 32
CLOSE: Final = 1.0
"""So many roundings apart, two iterates are taken for the same."""

FASTER: Final = 0.1
SMALL: Final = 1e-10
"""Iterates that differ by less than this, and by no less than those before, are as close as rounding lets them."""


@dataclass(frozen=True, eq=False)
class NearbyMap:
    """A map with its Jacobian: `values` takes points (N, 2n) to (N, 2n), `jacobians` to (N, 2n, 2n)."""

    values: Callable[[Array], Array]
    jacobians: Callable[[Array], Array]


@dataclass(frozen=True, eq=False)
class Rays:
    """Phase points z on rays, and the block ∂y/∂v of f's Jacobian there or nearby."""

    z: Array
    block: Array

    def of(self, rows: Array) -> Rays:
        """Those of some rows alone."""
        return Rays(self.z[rows], self.block[rows])


@dataclass(frozen=True, eq=False)
class RepairedMap:
    """The symplectic map near f with a generating function of some types, by rays from a centre.

    It is called with one phase point (2n,), with points (N, 2n), or with a pair (q, p), and returns the same. Where its
    equations are not solved (beyond a caustic, or where f has no value) it is nan.

    **Arguments:** the map `near`; the `pattern` of the mixed variables; the `centre` z₀ from which rays start (2n,);
    `nodes` in (0, 1) and `weights` of the quadrature; `lengths` (2n,) over which the variables range.
    """

    near: NearbyMap
    pattern: Pattern
    centre: Array
    nodes: Array
    weights: Array
    lengths: Array

    def __call__(self, *arguments: Any) -> Any:
        """The image of a phase point, of points, or of a pair (q, p)."""
        return of_any_form(self.images, arguments)

    def images(self, points: Array) -> Array:
        """The images of points (N, 2n): y is found from v = ±∂F/∂x by Broyden's method, which starts at f's own."""
        pattern = self.pattern
        x, target = points[:, pattern.old_arguments], points[:, pattern.old_conjugates]
        images = np.full(points.shape, np.nan)
        if not len(points):
            return images
        with np.errstate(all="ignore"):
            near, M = self.near.values(points), self.near.jacobians(points)
            y = near[:, pattern.new_arguments]
            inverse = pattern.old_signs * self._block(M)
            active = np.flatnonzero(np.isfinite(y).all(axis=1) & np.isfinite(inverse).all(axis=(1, 2)))
            if not len(active):
                return images
            along = self._first_guess(points[active])
            left, step, previous = np.full(len(points), np.inf), np.zeros_like(y), np.zeros_like(y)
            unit = self.lengths[pattern.new_arguments]
            for iteration in range(OUTER):
                if not len(active):
                    break
                gradient, along = self.gradient(np.concatenate([x[active], y[active]], axis=1), along)
                off = gradient[:, : x.shape[1]] - pattern.old_signs * target[active]
                if iteration:
                    inverse[active] = _broyden(inverse[active], step[active], off - previous[active])
                move = -np.einsum("bij,bj->bi", inverse[active], off)
                size = (np.abs(move) / unit).max(axis=1)
                scale = (np.abs(y[active]) / unit).max(axis=1)
                converged = size <= CLOSE * UNIT * scale
                stalled = (size >= left[active]) & (size <= SMALL * (1 + scale))
                lost = ~np.isfinite(size)
                done = converged | stalled
                if done.any():
                    rows = active[done]
                    images[np.ix_(rows, pattern.new_arguments)] = y[rows]
                    images[np.ix_(rows, pattern.new_conjugates)] = pattern.new_signs * gradient[done, x.shape[1] :]
                keep = ~(done | lost)
                rows = active[keep]
                previous[rows], step[rows], left[rows] = off[keep], move[keep], size[keep]
                y[rows] += move[keep]
                active, along = rows, along.of(np.repeat(keep, len(self.nodes)))
        return images

    def gradient(self, u: Array, along: Rays) -> tuple[Array, Rays]:
        """∂F/∂u at mixed points u = (x, y) (N, 2n), and what belongs to the nodes on their rays.

        `along` holds first guesses of that, node after node, ray after ray.
        """
        count, size = u.shape
        start = self._mixed(self.centre[None, :])[0]
        ray = u - start
        on_rays = start + self.nodes[None, :, None] * ray[:, None, :]
        along, theta, derivative = self._one_form(on_rays.reshape(-1, size), along)
        theta = theta.reshape(count, -1, size)
        turned = np.einsum("bkij,bi->bkj", derivative.reshape(count, -1, size, size), ray)
        total = np.einsum("k,bkj->bj", self.weights, theta + self.nodes[None, :, None] * turned)
        return total, along

    def _mixed(self, points: Array) -> Array:
        """The mixed variables (x, y) of phase points and their images under f."""
        pattern = self.pattern
        images = self.near.values(points)
        return np.concatenate([points[:, pattern.old_arguments], images[:, pattern.new_arguments]], axis=1)

    def _first_guess(self, points: Array) -> Rays:
        """Phase points on straight lines from the centre: near those on the rays where f is nearly affine."""
        z = self.centre + self.nodes[None, :, None] * (points - self.centre)[:, None, :]
        z = z.reshape(-1, points.shape[1])
        return Rays(z, self._block(self.near.jacobians(z)))

    def _one_form(self, u: Array, begun: Rays) -> tuple[Rays, Array, Array]:
        """(z, θ, ∂θ/∂u) at mixed points u (N, 2n): f's equations in these variables, solved by Newton's method.

        Jacobians are expensive: that of the last solution serves until steps shrink by less than `FASTER`.
        """
        pattern, n = self.pattern, u.shape[1] // 2
        x, y = u[:, :n], u[:, n:]
        z, block = begun.z.copy(), begun.block.copy()
        z[:, pattern.old_arguments] = x
        unit = self.lengths[pattern.old_conjugates]
        rows = np.arange(len(z))
        values = np.full(z.shape, np.nan)
        left = np.full(len(z), np.inf)
        for iteration in range(INNER):
            values[rows] = self.near.values(z[rows])
            off = values[rows][:, pattern.new_arguments] - y[rows]
            move = -_solved(block[rows], off[:, :, None])[:, :, 0]
            size = (np.abs(move) / unit).max(axis=1)
            scale = (np.abs(z[rows][:, pattern.old_conjugates]) / unit).max(axis=1)
            stalled = (size >= left[rows]) & (size <= SMALL * (1 + scale))
            lost = ~np.isfinite(size)
            go_on = (size > CLOSE * UNIT * scale) & ~stalled & ~lost
            slow = (size > FASTER * left[rows])[go_on] if iteration else np.zeros(int(go_on.sum()), dtype=bool)
            z[rows[lost]] = np.nan
            left[rows] = size
            rows, move = rows[go_on], move[go_on]
            if not len(rows):
                break
            z[np.ix_(rows, pattern.old_conjugates)] += move
            if slow.any():
                block[rows[slow]] = self._block(self.near.jacobians(z[rows[slow]]))
        z[rows] = np.nan
        M = self.near.jacobians(z)
        return Rays(z, self._block(M)), *self._form_at(z, values, M)

    def _block(self, M: Array) -> Array:
        """∂y/∂v in Jacobians M."""
        return M[:, self.pattern.new_arguments[:, None], self.pattern.old_conjugates]

    def _form_at(self, z: Array, values: Array, M: Array) -> tuple[Array, Array]:
        """θ and ∂θ/∂u where f and its Jacobian are known."""
        pattern, n = self.pattern, z.shape[1] // 2
        x, v, y, w = (
            pattern.old_arguments,
            pattern.old_conjugates,
            pattern.new_arguments,
            pattern.new_conjugates,
        )
        theta = np.concatenate([pattern.old_signs * z[:, v], pattern.new_signs * values[:, w]], axis=1)
        by_y = _solved(M[:, y[:, None], v], np.broadcast_to(np.eye(n), (len(z), n, n)))
        by_x = -by_y @ M[:, y[:, None], x]
        across = M[:, w[:, None], v]
        old = pattern.old_signs[:, None] * np.concatenate([by_x, by_y], axis=2)
        new = pattern.new_signs[:, None] * np.concatenate([M[:, w[:, None], x] + across @ by_x, across @ by_y], axis=2)
        return theta, np.concatenate([old, new], axis=1)


def nearby(values: Callable[[Array], Array], jacobians: Callable[[Array], Array], *, padded: bool = False) -> NearbyMap:
    """The map with these values and Jacobians; `padded`, it is asked for few different numbers of points.

    (A compiled program is compiled anew for each number.)
    """

    def filled(function: Callable[[Array], Array]) -> Callable[[Array], Array]:
        def of_points(points: Array) -> Array:
            if not padded:
                return np.array(function(points))
            count = max(LEAST_BLOCK, 1 << (len(points) - 1).bit_length())
            many = np.concatenate([points, np.repeat(points[-1:], count - len(points), axis=0)])
            return np.array(function(many)[: len(points)])

        return of_points

    return NearbyMap(filled(values), filled(jacobians))


def quadrature(count: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss and Legendre on (0, 1)."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return (nodes + 1) / 2, weights / 2


def _solved(block: Array, right: Array) -> Array:
    """block⁻¹ right, nan where the block is singular or not finite."""
    finite: Any = np.isfinite(block).all(axis=(1, 2))
    usable = finite & (np.linalg.det(np.where(finite[:, None, None], block, 0.0)) != 0)
    found = np.full(right.shape, np.nan)
    if usable.any():
        found[usable] = np.linalg.solve(block[usable], right[usable])
    return found


def _broyden(inverse: Array, step: Array, change: Array) -> Array:
    """The inverse Jacobians corrected by a rank-one term, so that they take what changed to the step that was made."""
    taken = np.einsum("bij,bj->bi", inverse, change)
    row = np.einsum("bi,bij->bj", step, inverse)
    weight = np.einsum("bi,bi->b", step, taken)
    usable = np.abs(weight) > 1e-3 * np.einsum("bi,bi->b", step, step)
    correction = (step - taken)[:, :, None] * row[:, None, :] / np.where(usable, weight, 1.0)[:, None, None]
    return inverse + np.where(usable[:, None, None], correction, 0.0)
