"""How far a function's values jump over tiny steps: its noise, which no type of number need show.

A network in float32 whose output is added to float64, or an iteration that stops at a tolerance, returns float64 and is
far less precise. Moré and Wild, SIAM Journal on Scientific Computing 33 (2011) 1292: high differences of values at
equal small steps are nothing but noise, once the function's own have died away.
"""

from __future__ import annotations

from collections.abc import Callable
from math import comb
from typing import Final

import numpy as np

Array = np.ndarray

STEPS: Final = (1e-5, 1e-6)
"""The small steps, as parts of the lengths over which variables range. What is not noise falls by 10⁵ from one to the
other, and by 10 at least if the function is only steep."""
NODES: Final = 9
ORDERS: Final = (4, 5)
AGREE: Final = 4.0
"""Noise is the same at both steps, and in differences of both orders, within this factor."""
PLAIN: Final = 256.0
"""So many roundings of the values are plain rounding, of a function with many terms."""


def noise_of(evaluate: Callable[[Array], Array], points: Array, lengths: Array, unit: float) -> Array:
    """The noise (2n,) of a map's values in the units of each, a standard deviation; 0 where it is rounding to `unit`.

    **Arguments:** `evaluate`, of points (N, 2n); a few `points`; the `lengths` (2n,) over which the variables range.
    """
    directions = lengths * np.random.default_rng(2).uniform(0.5, 1.0, points.shape)
    nodes = np.arange(NODES) - NODES // 2
    found, values = [], np.zeros(0)
    with np.errstate(all="ignore"):
        for step in STEPS:
            moved = points[None] + step * nodes[:, None, None] * directions[None]
            values = evaluate(moved.reshape(-1, points.shape[1])).reshape(moved.shape)
            found += [
                np.sqrt(np.mean(np.diff(values, order, axis=0) ** 2, axis=0) / comb(2 * order, order))
                for order in ORDERS
            ]
        sizes = np.stack(found)
        least = sizes.min(axis=0)
        plain = PLAIN * unit * np.abs(values).max(axis=0)
        noisy = (sizes.max(axis=0) <= AGREE * least) & (least > plain)
        return np.median(np.where(noisy, least, 0.0), axis=0)
