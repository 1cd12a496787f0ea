"""Derivatives of functions that can only be evaluated: the complex step, and Richardson's extrapolation.

Squire and Trapp, SIAM Review 40 (1998) 110; Ridders, Advances in Engineering Software 4 (1982) 75.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from canon.numeric.map_shape import PointMap
from canon.numeric.precision import double
from canon.numeric.warnings_raised import warnings_raised

Array = np.ndarray

LEVELS: Final = 8
FIRST_STEP: Final = 0.05
"""The longest step, as a fraction of the length over which a variable ranges; each next one is half of it."""

SAFETY: Final = 4.0
NOISE: Final = 16.0
"""How much of the function's rounding, over the step, is granted to an extrapolated difference."""

AT_ONCE: Final = 2**17
"""So many numbers are evaluated at once."""

PROBES: Final = 3
PROBE_STEPS: Final = (4e-3, 1e-4, 3e-6, 1e-7, 3e-9)
"""Derivatives are tried by differences along one direction, of so many steps, the longest this part of the lengths."""
TOGETHER: Final = 256
"""So many points are tried with all steps at once."""
REACH: Final = 0.02
"""Over such a step M must change the values by no more than this part of their range."""
UNSEEN: Final = 1e-11
"""They may differ by this part of their size without notice."""

KINK_STEP: Final = 1e-4
"""The step at which differences to two sides are compared, and then at a sixteenth of it."""
KINK: Final = 1e-3
"""A kink's slopes differ by at least this part of their size: less is taken for curvature."""

TINY_STEP: Final = 1e-30
TINIEST: Final = 1e-250
STRETCHES: Final = (1.1, 1.3)
"""Of the complex step, for other roundings: no powers of 2."""
ULPS: Final = 8


def central_differences(
    evaluate: Callable[[Array], Array],
    points: Array,
    lengths: Array,
    unit: float,
    *,
    at_once: bool = False,
    noise: Array | float = 0.0,
    first: float = FIRST_STEP,
    levels: int = LEVELS,
) -> tuple[Array, Array]:
    """(M, E) at points (N, m): central differences at so many steps, extrapolated to step 0 entry by entry. The longest
    step is the part `first` of the lengths, each next one half of it.

    M and E are (N, k, m) for a function that takes points (N, m) to values (N, k).
    The estimate E is what the best two neighbours in Neville's table differ by, times a safety factor, plus the
    function's rounding over the step, and its `noise` (k,) beyond that. With `at_once` the function may be given more
    points than N together.
    """
    columns: list[tuple[Array, Array]] = []
    with np.errstate(all="ignore"):
        for k in range(points.shape[1]):
            best: Array | float = np.nan
            error: Array | float = np.inf
            above: list[Array] = []
            moved = np.repeat(points[None], 2 * levels, axis=0)
            steps = first * lengths[k] / 2.0 ** np.arange(levels)
            moved[:levels, :, k] += steps[:, None]
            moved[levels:, :, k] -= steps[:, None]
            values = _values(evaluate, moved, at_once)
            for level in range(levels):
                width = (moved[level, :, k] - moved[levels + level, :, k])[:, None]
                high, low = values[level], values[levels + level]
                row = [(high - low) / width]
                rounding = (2 * unit * (np.abs(high) + np.abs(low)) + noise) / width
                for j, old in enumerate(above, 1):
                    row.append(row[-1] + (row[-1] - old) / (4.0**j - 1))
                    spread = np.maximum(np.abs(row[-1] - row[-2]), np.abs(row[-1] - old))
                    estimate = SAFETY * spread + NOISE * rounding
                    better = estimate < error
                    best, error = np.where(better, row[-1], best), np.where(better, estimate, error)
                above = row
            columns.append((np.asarray(best), np.asarray(error)))
    return np.stack([best for best, _ in columns], axis=2), np.stack([error for _, error in columns], axis=2)


def _values(evaluate: Callable[[Array], Array], sets: Array, at_once: bool) -> Array:
    """The values at several sets of points (K, N, m); small sets may be evaluated `at_once`."""
    if at_once and sets.size <= AT_ONCE:
        found = evaluate(sets.reshape(-1, sets.shape[2]))
        return found.reshape(*sets.shape[:2], -1)
    return np.stack([evaluate(points) for points in sets])


def misfits(
    evaluate: Callable[[Array], Array],
    points: Array,
    M: Array,
    E: Array,
    lengths: Array,
    unit: float,
    noise: Array | float = 0.0,
    *,
    unseen: float = UNSEEN,
) -> Array:
    """At which points (N, m) the Jacobian M, off by at most E, isn't that of the values: (N,).

    It is tried along one direction that differs from point to point, by differences and an estimate of their error. A
    complex step doesn't see what a function does with |x|, or with x.real, and that may begin anywhere. Steps tell
    nothing of a map that folds many times within them: there M would take the values far beyond their range, and
    shorter steps are tried. Less than the part `unseen` of M isn't told.
    """
    directions = lengths * np.random.default_rng(1).choice([-1.0, -0.7, 0.7, 1.0], points.shape)
    with np.errstate(all="ignore"):
        expected = np.einsum("bij,bj->bi", M, directions)
        reach = np.einsum("bij,bj->bi", np.abs(M), np.abs(directions))
        off = np.einsum("bij,bj->bi", E, np.abs(directions)) + unseen * reach
        # far from the origin, the points themselves are rounded
        rounding = np.einsum("bij,bj->bi", np.abs(M), np.abs(points)) * unit * 2**PROBES
        values = evaluate(points)
        ranges = np.where(len(points) > 2, np.nanmax(values, axis=0) - np.nanmin(values, axis=0), 0.0)
        ranges = np.where(ranges > 0, ranges, np.nanmax(np.abs(values), axis=0))
    suspects, wrong = np.arange(len(points)), np.zeros(len(points), dtype=bool)
    before: tuple[Array, Array] | None = None
    for step in PROBE_STEPS:
        z, d = points[suspects], directions[suspects]

        def along(s: Array, z: Array = z, d: Array = d) -> Array:
            times = len(s) // len(z)
            return evaluate(np.tile(z, (times, 1)) + s * np.tile(d, (times, 1)))

        origin = np.zeros((len(z), 1))
        found = central_differences(
            along, origin, np.ones(1), unit, at_once=len(z) <= TOGETHER, noise=noise, first=step, levels=PROBES
        )
        slopes, errors = (array[:, :, 0] for array in found)
        with np.errstate(all="ignore"):
            errors = errors + rounding[suspects] / step
            if before is not None:
                same = np.abs(slopes - before[0]) <= errors + before[1]
                slopes, errors = np.where(same, before[0], slopes), np.where(same, before[1], errors)
            told = reach[suspects] * step <= REACH * ranges
            wrong[suspects] = (told & (np.abs(expected[suspects] - slopes) > errors + off[suspects])).any(axis=1)
        again = wrong[suspects] | ~told.all(axis=1)
        suspects, before = suspects[again], (slopes[again], np.where(told, errors, -np.inf)[again])
        if not len(suspects):
            break
    return wrong


def kinks(
    evaluate: Callable[[Array], Array], points: Array, lengths: Array, unit: float, noise: Array | float = 0.0
) -> Array:
    """At which points (N, m) differences to the two sides differ along some variable, however short the step: (N,).

    Curvature makes them differ by an amount that falls with the step; a kink's stays, and a jump's grows.
    """
    found = np.zeros(len(points), dtype=bool)
    with np.errstate(all="ignore"):
        here = evaluate(points)
        for k in range(points.shape[1]):
            gaps = []
            for step in (KINK_STEP * lengths[k], KINK_STEP * lengths[k] / 16):
                moved = np.repeat(points[None], 2, axis=0)
                moved[0, :, k] -= step
                moved[1, :, k] += step
                below, above = _values(evaluate, moved, True)
                ahead = (above - here) / (moved[1, :, k] - points[:, k])[:, None]
                behind = (here - below) / (points[:, k] - moved[0, :, k])[:, None]
                steep = np.abs(ahead) + np.abs(behind)
                place = np.abs(points[:, k])[:, None]  # it rounds too where the function takes it in fewer digits
                rounding = unit * (np.abs(below) + np.abs(here) + np.abs(above) + steep * place)
                granted = NOISE * (rounding + 2 * np.asarray(noise)) / step
                gaps.append(np.abs(ahead - behind))
            bent = (gaps[1] > granted) & (gaps[1] > gaps[0] / 2)
            found |= np.any(bent & (gaps[1] > KINK * steep), axis=1)
    return found


def complex_step(mapped: PointMap, points: Array, lengths: Array, stretch: float = 1.0) -> Array:
    """Im f(z + ih e_k)/h at points (N, 2n), exact to rounding for an analytic f; nan where f does not take that.

    h is tiny beside the length (2n,) over which a variable ranges: momenta of an electron in SI units are tiny, too.
    Another `stretch` of h, one that is no power of 2, gives the same derivatives with other roundings. Where f has no
    real value, as a root of a negative number, it has a complex one all the same: leave such points out.
    """
    steps = np.maximum(TINY_STEP * np.where(lengths > 0, lengths, 1.0) * stretch, TINIEST)
    count, size = points.shape
    M = np.empty((count, size, size))
    with double(), warnings_raised():  # numpy only warns where a complex number's imaginary part is dropped
        for k in range(size):
            moved = points.astype(complex)
            moved[:, k] += 1j * steps[k]
            M[:, :, k] = np.imag(_complex_values(mapped, moved)) / steps[k]
    return M


def _complex_values(mapped: PointMap, points: Array) -> Array:
    """Values at complex points, nan where the function raises."""
    if mapped.many is not None:
        try:
            return np.array(mapped.many(points.copy()))
        except Exception:  # then point by point, to see where
            pass
    values = np.full(points.shape, complex(np.nan, np.nan))
    for k, point in enumerate(points):
        try:
            values[k] = mapped.one(point.copy())
        except Exception:  # a user's function may raise anything when it is given complex numbers
            continue
    return values


def neighbours(jacobian: Callable[[Array, float], Array], unit: float) -> Callable[[Array], tuple[Array, Array]]:
    """The Jacobian with an estimate of its error: how much it differs at two points a few roundings away.

    `jacobian` takes points and the stretch of a step, by which its roundings may differ where the map is linear, so
    that they don't depend on the point. That shows how the conditioning of the program at the point amplifies rounding,
    and how many roundings there are. Two draws may agree by chance: an entry is granted what its like at half of the
    points differ by, as a part of its size. `ULPS` roundings of the entry itself are added.
    """

    def linearise(points: Array) -> tuple[Array, Array]:
        M = jacobian(points, 1.0)
        rng = np.random.default_rng(0)
        spread = np.zeros_like(M)
        with np.errstate(all="ignore"):
            for stretch in STRETCHES:
                moved = points * (1 + 4 * unit * rng.choice([-1.0, 1.0], points.shape))
                spread = np.maximum(spread, np.abs(jacobian(moved, stretch) - M))
            part = spread / np.abs(M)
            part[~np.isfinite(part)] = 0.0
            usable = np.isfinite(M).all(axis=(1, 2))
            if usable.any():
                spread = np.maximum(spread, np.median(part[usable], axis=0) * np.abs(M))
        return M, ULPS * unit * np.abs(M) + SAFETY * spread

    return linearise
