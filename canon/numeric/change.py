"""In which order of the power series about a centre two maps begin to differ."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from canon.numeric.precision import UNIT

Array = np.ndarray
HALVINGS: Final = 24
DIRECTIONS: Final = 16
PLATEAU: Final = 1e3
"""Differences of fewer roundings than this tell nothing about an order."""

WHOLE: Final = 0.25
"""A slope that is further from a whole number is no order."""


@dataclass(frozen=True)
class ChangeOrder:
    """Two maps differ by O(distance^`order`); `slope` is what was measured.

    Both are None where too little was above rounding.
    """

    order: int | None
    slope: float | None


def order_of_change(
    one: Callable[[Array], Array], other: Callable[[Array], Array], centre: Array, points: Array, lengths: Array
) -> ChangeOrder:
    """The slope of the largest difference on points that approach the centre by halves, above the rounding plateau.

    It is taken at the smallest distances that tell, for there the lowest order rules.
    """
    offsets = points[:DIRECTIONS] - centre
    telling: list[float] = []
    for level in range(HALVINGS):
        z = centre + offsets / 2.0**level
        first, second = one(z), other(z)
        sizes = np.abs(first - second) / lengths
        finite = np.isfinite(sizes).all(axis=1)
        if not finite.all():
            telling.clear()
            continue
        if sizes.max() <= PLATEAU * UNIT * (1 + (np.abs(first) / lengths).max()):
            break
        telling.append(float(sizes.max()))
    if len(telling) < 2:
        return ChangeOrder(None, None)
    slope = float(np.log2(telling[-2] / telling[-1]))
    whole = round(slope)
    return ChangeOrder(whole if abs(slope - whole) <= WHOLE and whole >= 0 else None, slope)
