"""The map that a generating function defines, solved for by Newton's method in the mixed variables, at many points.

With old arguments x and new ones y of F the equations are v = ±∂F/∂x and w = ±∂F/∂y; given (x, v) the first is solved
for y, and the second gives w. The steps are damped so that the next correction shrinks, a test that doesn't depend on
the units of the equations (Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 3.3). The Jacobian of the
map follows from the second derivatives of F at the solution. Conditioning: what F's second derivatives amplify is
stated with each image, as `errors` and `condition`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.numeric.mixed_variables import Pattern
from canon.numeric.precision import UNIT

Array = Any  # numpy arrays

ITERATIONS: Final = 120
HALVINGS: Final = 24
GENTLE: Final = 8
"""After so many halvings the step is shortened faster: next to a pole a start may be decades away."""

CRAWLING: Final = 12
"""After so many steps that were shortened faster, with a longer one to come, there is no solution this way: beyond a
fold all of them are shortened, and many have a longer one before them."""

CLOSE: Final = 8.0
"""So many roundings of the equations, or of y, are as good as solved."""


@dataclass(frozen=True)
class MixedDerivatives:
    """∂F/∂u (N, 2n) and ∂²F/∂u² (N, 2n, 2n) at mixed points u = (x, y), with bounds on their rounding.

    `inside` (N,) says where F is defined; elsewhere the numbers have no meaning.
    """

    gradient: Array
    hessian: Array
    gradient_bound: Array
    hessian_bound: Array
    inside: Array


Derivatives = Callable[[Array, Array], MixedDerivatives]
"""Takes mixed points u (N, 2n), and which of the points to be solved for they belong to (N,)."""


@dataclass(frozen=True)
class MixedSolution:
    """What Newton's method found at N points.

    `u` (N, 2n), the mixed variables; `solved` (N,); `images` (N, 2n), nan where not solved, with estimates `errors` of
    what is left of the equations and what rounding makes of them; `M` (N, 2n, 2n), the map's Jacobian, with a bound
    `M_errors` on its rounding; `condition` (N,), the largest relative error of an image in units of roundoff;
    `iterations` (N,).
    """

    u: Array
    solved: Array
    images: Array
    errors: Array
    M: Array
    M_errors: Array
    condition: Array
    iterations: Array


def solve_mixed(derivatives: Derivatives, pattern: Pattern, z: Array, start: Array) -> MixedSolution:
    """Images of phase points z (N, 2n) under the map of a generating function.

    **Arguments:** `derivatives` of F; the `pattern` of its type; `z`; `start` (N, n), first guesses of the new
    arguments y.
    """
    count, size = z.shape
    n = size // 2
    x, v = z[:, pattern.old_arguments], z[:, pattern.old_conjugates]
    sign = pattern.old_signs
    y = np.array(start, dtype=float)
    solved, iterations, crawled = np.zeros(count, dtype=bool), np.zeros(count, dtype=int), np.zeros(count, dtype=int)

    def at(rows: Array, new: Array) -> tuple[Array, Array, Array, Array]:
        found = derivatives(np.concatenate([x[rows], new], axis=1), rows)
        off = sign * found.gradient[:, :n] - v[rows]
        block = sign[:, None] * found.hessian[:, :n, n:]
        noise = found.gradient_bound[:, :n] + UNIT * np.abs(v[rows])
        inside = found.inside & np.isfinite(off).all(axis=1) & np.isfinite(block).all(axis=(1, 2))
        return off, block, noise, inside

    with np.errstate(all="ignore"):
        rows = np.arange(count)
        off, block, noise, inside = at(rows, y)
        rows, off, block, noise = rows[inside], off[inside], block[inside], noise[inside]
        for _ in range(ITERATIONS):
            if not len(rows):
                break
            move = -_solved(block, off)
            size_of = np.abs(y[rows]) + UNIT
            close = np.all(np.abs(move) <= CLOSE * UNIT * size_of, axis=1)
            close |= np.all(np.abs(off) <= CLOSE * noise, axis=1)
            solved[rows[close]] = True
            go_on = ~close & np.isfinite(move).all(axis=1) & (crawled[rows] < CRAWLING)
            rows, off, block, noise, move = rows[go_on], off[go_on], block[go_on], noise[go_on], move[go_on]
            iterations[rows] += 1
            rows, off, block, noise = _damped(at, y, rows, off, block, noise, move, crawled)
        u = np.concatenate([x, y], axis=1)
        return _solution(derivatives(u, np.arange(count)), pattern, u, v, solved, iterations)


def _damped(
    at: Callable[[Array, Array], tuple[Array, Array, Array, Array]],
    y: Array,
    rows: Array,
    off: Array,
    block: Array,
    noise: Array,
    move: Array,
    crawled: Array,
) -> tuple[Array, Array, Array, Array]:
    """One step for each of the rows, halved until the next correction is shorter; rows without such a step are dropped.

    It changes `y` in place, and counts in `crawled` where the step was a very small part, and the next one is longer.
    """
    before = _length(move, y[rows])
    waiting = np.arange(len(rows))
    kept = np.zeros(len(rows), dtype=bool)
    part = 1.0
    new_off, new_block, new_noise = off.copy(), block.copy(), noise.copy()
    for attempt in range(HALVINGS):
        if not len(waiting):
            break
        trial = y[rows[waiting]] + part * move[waiting]
        t_off, t_block, t_noise, inside = at(rows[waiting], trial)
        following = _length(_solved(block[waiting], t_off), y[rows[waiting]])
        small = np.all(np.abs(t_off) <= CLOSE * t_noise, axis=1)
        good = inside & ((following <= (1 - part / 4) * before[waiting]) | small)
        chosen = waiting[good]
        y[rows[chosen]] = trial[good]
        new_off[chosen], new_block[chosen], new_noise[chosen] = t_off[good], t_block[good], t_noise[good]
        kept[chosen] = True
        if attempt > GENTLE:  # towards a pole the next step is shorter than this one, towards a fold it is longer
            ahead = _length(_solved(t_block[good], t_off[good]), y[rows[chosen]])
            crawled[rows[chosen]] += ahead >= before[chosen]
        waiting = waiting[~good]
        part /= 2 if attempt < GENTLE else 16
    return rows[kept], new_off[kept], new_block[kept], new_noise[kept]


def _length(move: Array, y: Array) -> Array:
    sizes = np.abs(y)
    return np.max(np.abs(move) / (sizes + sizes.max(axis=1, keepdims=True) * 1e-3 + 1e-12), axis=1)


def jacobians(pattern: Pattern, hessian: Array, bound: Array) -> tuple[Array, Array]:
    """(M, E) from the second derivatives of F: M = ∂(Q,P)/∂u (∂(q,p)/∂u)⁻¹, and a bound on its rounding."""
    count, size, _ = hessian.shape
    n = size // 2
    old, new, inverse = np.zeros((3, count, size, size))
    off_old, off_new = np.zeros((2, count, size, size))
    old[:, :n, :n] = np.eye(n)
    old[:, n:] = pattern.old_signs[:, None] * hessian[:, :n]
    off_old[:, n:] = bound[:, :n]
    new[:, :n, n:] = np.eye(n)
    new[:, n:] = pattern.new_signs[:, None] * hessian[:, n:]
    off_new[:, n:] = bound[:, n:]
    # in the order (x, v) the inverse has a block of exact zeros, which a factorisation of the whole would blur
    block = _inverse(old[:, n:, n:])
    inverse[:, :n, :n], inverse[:, n:, n:] = np.eye(n), block
    inverse[:, n:, :n] = -block @ old[:, n:, :n]
    M = new @ inverse
    left = np.abs(np.eye(size) - old @ inverse) + (size + 2) * UNIT * (np.abs(old) @ np.abs(inverse) + np.eye(size))
    off = off_new + np.abs(M) @ off_old + size * UNIT * np.abs(new)
    E = off @ np.abs(inverse) + np.abs(new) @ (np.abs(inverse) @ left) + UNIT * np.abs(M)
    rows = np.argsort(np.concatenate([pattern.new_arguments, pattern.new_conjugates]))
    columns = np.argsort(np.concatenate([pattern.old_arguments, pattern.old_conjugates]))
    return M[:, rows][:, :, columns], E[:, rows][:, :, columns]


def _solution(
    found: MixedDerivatives, pattern: Pattern, u: Array, v: Array, solved: Array, iterations: Array
) -> MixedSolution:
    count, size = u.shape
    n = size // 2
    images, errors = np.full((count, size), np.nan), np.full((count, size), np.inf)
    images[:, pattern.new_arguments] = u[:, n:]
    images[:, pattern.new_conjugates] = pattern.new_signs * found.gradient[:, n:]
    block = np.abs(_inverse(found.hessian[:, :n, n:]))
    noise = found.gradient_bound + UNIT * np.abs(found.gradient)
    left = np.abs(pattern.old_signs * found.gradient[:, :n] - v)
    off_y = np.einsum("bij,bj->bi", block, noise[:, :n] + left) + UNIT * np.abs(u[:, n:])
    errors[:, pattern.new_arguments] = off_y
    across = np.einsum("bij,bj->bi", np.abs(found.hessian[:, n:, n:]), off_y)
    errors[:, pattern.new_conjugates] = noise[:, n:] + across
    M, M_errors = jacobians(pattern, found.hessian, found.hessian_bound)
    usable = solved & found.inside & np.isfinite(images).all(axis=1) & np.isfinite(M).all(axis=(1, 2))
    sizes = np.maximum(np.abs(images), 1e-3 * np.abs(images).max(axis=1, keepdims=True))
    condition = np.where(usable, (errors / np.maximum(sizes, 1e-300)).max(axis=1) / UNIT, np.inf)
    images[~usable] = np.nan
    return MixedSolution(u, usable, images, errors, M, M_errors, condition, iterations)


def _inverse(matrix: Array) -> Array:
    """Inverses, nan where there is none."""
    finite = np.isfinite(matrix).all(axis=(1, 2))
    regular = finite & (np.linalg.det(np.where(finite[:, None, None], matrix, 0.0)) != 0)
    found = np.full(matrix.shape, np.nan)
    if regular.any():
        found[regular] = np.linalg.inv(matrix[regular])
    return found


def _solved(block: Array, right: Array) -> Array:
    return np.einsum("bij,bj->bi", _inverse(block), right)
