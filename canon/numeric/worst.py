"""Where a condition is violated most, over as many points as there are, in bounded memory."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from canon.numeric.residuals import Residuals

Array = np.ndarray
KEPT: Final = 100_000
"""So many points' residuals are kept for their median."""


@dataclass(frozen=True)
class Defect:
    """The worst residual of a condition: the one that exceeds its own bound by the largest factor.

    **Arguments:** `name` of the condition; `label` of the entry that is worst ("{Q1,P2}"); its `size`, and the `bound`
    on its rounding there; the `point`; `largest`, the largest residual anywhere; `typical` and `typical_bound`, the
    medians over points.
    """

    name: str
    label: str
    size: float
    bound: float
    point: tuple[float, ...]
    largest: float
    typical: float
    typical_bound: float

    @property
    def exceeds(self) -> bool:
        """Whether the residual is more than rounding explains."""
        return self.size > self.bound

    def __str__(self) -> str:
        return f"{self.label:<9} {self.size:9.2g}  (bound {self.bound:.2g}; typical {self.typical:.2g})"


@dataclass
class Tally:
    """The worst of one condition so far; `add` block by block, then ask for the `defect`."""

    name: str
    excess: float = -1.0
    largest: float = 0.0
    index: tuple[int, ...] = ()
    size: float = 0.0
    bound: float = 0.0
    point: tuple[float, ...] = ()
    sizes: list[Array] = field(default_factory=list)
    bounds: list[Array] = field(default_factory=list)
    kept: int = 0

    def add(self, residuals: Residuals, points: Array, *, typical: int | None = None) -> None:
        """Take the residuals at further points into account; for the medians only the first `typical` of them."""
        if not residuals.sizes.size:
            return
        flat = residuals.sizes.reshape(len(points), -1)
        limits = residuals.bounds.reshape(len(points), -1)
        with np.errstate(all="ignore"):
            ratio = np.where(flat == 0, 0.0, np.where(np.isinf(limits), 0.0, flat / limits))
        ratio = np.nan_to_num(ratio, nan=0.0, posinf=np.inf)
        k = int(np.argmax(ratio))
        row, entry = divmod(k, flat.shape[1])
        if ratio.flat[k] > self.excess:
            self.excess = float(ratio.flat[k])
            self.size, self.bound = float(flat[row, entry]), float(limits[row, entry])
            self.index = tuple(int(i) for i in np.unravel_index(entry, residuals.sizes.shape[1:]))
            self.point = tuple(float(x) for x in points[row])
        self.largest = max(self.largest, float(flat.max()))
        if self.kept < KEPT:
            self.sizes.append(flat[:typical].max(axis=1))
            self.bounds.append(limits[:typical].max(axis=1))
            self.kept += len(self.sizes[-1])

    def defect(self) -> Defect:
        """What was found."""
        return Defect(
            self.name,
            _label(self.name, self.index),
            self.size,
            self.bound,
            self.point,
            self.largest,
            float(np.median(np.concatenate(self.sizes))),
            float(np.median(np.concatenate(self.bounds))),
        )


def _label(name: str, index: tuple[int, ...]) -> str:
    """`{Q,P}` at (0, 1) is `{Q1,P2}`; other conditions keep their name."""
    if not name.startswith("{"):
        return name
    first, second = name[1:-1].split(",")
    return f"{{{first}{index[0] + 1},{second}{index[1] + 1}}}"
