"""What a repair did: the symplectic matrix or map near the one that was given, and how far it had to move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from canon.claims.audit_report import AuditReport
from canon.display import text_in_html
from canon.numeric.repaired_map import RepairedMap

Array = np.ndarray


@dataclass(frozen=True, eq=False)
class MatrixRepair:
    """The symplectic matrix near a matrix.

    **Fields:** `matrix` (2n, 2n); the `method` by which it was found; its `distance` from the matrix that was given
    (Frobenius), and `distances`, those of all methods that found one; `defect_before` and `defect`, the worst entries
    of |M J Mᵀ − J| of the two, and the `bound` on the latter's rounding.
    """

    matrix: Array
    method: str
    distance: float
    distances: Mapping[str, float]
    defect_before: float
    defect: float
    bound: float

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:
        return np.array(self.matrix, dtype=dtype)

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        others = ", ".join(f"{name} {size:.3g}" for name, size in self.distances.items())
        return (
            f"symplectic matrix by {_METHODS[self.method]}, {self.distance:.3g} away ({others})\n"
            f"  M J Mᵀ − J was {self.defect_before:.3g}, is {self.defect:.2g}  (bound {self.bound:.2g})"
        )


_METHODS = {"cayley": "Cayley's transform", "polar": "the symplectic polar factor"}


@dataclass(frozen=True, eq=False)
class MapRepair:
    """The symplectic map near a map.

    **Fields:**

    - `map`: the repaired map, a function of one phase point, of points (N, 2n), or of a pair (q, p). The repair itself
      can be called in its place.
    - `types`: the type of generating function in each degree of freedom, the best conditioned of those `compared`;
      `condition`: the most by which it amplifies errors.
    - `before`, `after`: the audits of the map that was given and of the repaired one.
    - `points` (N, 2n), and `shifts` (N, 2n), by which their images moved; `moved` (N,), the same in units of the
      lengths over which the variables range. nan where the repaired map has no value: `unsolved` points.
    - `order`: the order of the series about `centre` in which the change begins, as far as it can be measured
      (`slope`); None where nothing moved beyond rounding, or the slope is no whole number.
    - `nodes`: of the quadrature; `notes`: what else was noticed.
    """

    map: RepairedMap
    types: tuple[int, ...]
    compared: int
    condition: float
    before: AuditReport
    after: AuditReport
    points: Array
    shifts: Array
    lengths: Array
    centre: tuple[float, ...]
    order: int | None
    slope: float | None
    nodes: int
    notes: tuple[str, ...] = ()

    def __call__(self, *arguments: Any) -> Any:
        """The repaired map's image of a point, of points, or of a pair (q, p)."""
        return self.map(*arguments)

    @property
    def moved(self) -> Array:
        """How far each image moved: the largest of its shifts, in units of the variables' lengths."""
        return (np.abs(self.shifts) / self.lengths).max(axis=1)

    @property
    def unsolved(self) -> int:
        """At how many points the repaired map has no value."""
        return int(np.isnan(self.moved).sum())

    @property
    def largest(self) -> float:
        """The largest of `moved`."""
        return float(np.nanmax(self.moved))

    @property
    def typical(self) -> float:
        """The median of `moved`."""
        return float(np.nanmedian(self.moved))

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        kinds = str(self.types[0]) if len(set(self.types)) == 1 else f"({', '.join(map(str, self.types))})"
        among = f"best of {self.compared}" if self.compared else "as asked"
        worst = self.points[int(np.nanargmax(self.moved))]
        place = ", ".join(f"{name} = {x:.6g}" for name, x in zip(self.before.variables, worst, strict=True))
        if self.order is not None:
            order = f"the change begins in order {self.order} of the series"
        elif self.slope is not None:
            order = f"the change grows as the power {self.slope:.2f} of the distance"
        else:
            order = "too little moved beyond rounding to tell in which order"
        lines = [
            f"symplectic map by a generating function of type {kinds} ({among}), condition {self.condition:.3g}",
            f"  moved by at most {self.largest:.3g}, typically {self.typical:.3g} "
            f"(in units of the variables' ranges), most at {place}",
            f"  {order} about the centre",
            f"  before: {self.before.verdict}, M J Mᵀ − J up to {_worst(self.before)}",
            f"  after:  {self.after.verdict}, M J Mᵀ − J up to {_worst(self.after)}",
            *(f"  note: {text}" for text in self.notes),
        ]
        return "\n".join(lines)


def _worst(report: AuditReport) -> str:
    defect = report.worst
    return f"{defect.size:.2g} (bound {defect.bound:.2g})"
