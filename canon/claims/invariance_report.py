"""What was found of an integral invariant: the integral before and after a map, beside rounding, and what that says."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

from canon.display import text_in_html
from canon.errors import CanonError
from canon.numeric.images import Comparison


class NotInvariant(CanonError):
    """An integral that was required to be invariant was not seen to be: `report` says by how much."""

    def __init__(self, report: Invariance) -> None:
        super().__init__(report)
        self.report = report

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        return str(self.report)


@dataclass(frozen=True)
class Invariance:
    """The numerical evidence on one integral invariant of a map.

    **Fields:** `name` of the integral, as "∮ p dq"; `found`, the integrals `before` and `after` the map (each with
    its `value`, `bound`, `nodes`, `resolved`), and the `factor` by which the map should multiply it: the valence to the
    power of the order.
    """

    name: str
    found: Comparison

    @property
    def before(self) -> float:
        """The integral before the map."""
        return self.found.before.value

    @property
    def after(self) -> float:
        """The integral after the map."""
        return self.found.after.value

    @property
    def difference(self) -> float:
        """After, less `factor` times before."""
        return self.found.difference

    @property
    def bound(self) -> float:
        """What rounding explains of the difference."""
        return self.found.bound

    @property
    def resolved(self) -> bool:
        """Whether the nodes resolve the loop or surface, and its image."""
        return self.found.resolved

    @property
    def preserved(self) -> bool | None:
        """Whether the difference is within its bound; None where that isn't known."""
        return self.found.preserved

    @property
    def verdict(self) -> Literal["supported", "undecided"]:
        """`supported` where it is preserved; floats refute nothing, so `undecided` otherwise."""
        return "supported" if self.preserved else "undecided"

    def __bool__(self) -> bool:
        """**Raises:** `TypeError`: evidence is no truth value."""
        raise TypeError(f"evidence is neither true nor false: look at .preserved ({self.preserved}), or .require()")

    def require(self) -> Invariance:
        """This report, if the integral is preserved; **raises** `NotInvariant` otherwise."""
        if not self.preserved:
            raise NotInvariant(self)
        return self

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        factor = "" if self.found.factor == 1 else f", {float(self.found.factor):g} times which is expected"
        lines = [
            f"{self.verdict}: {self.name} {self._words()}",
            f"  before {self.before:.15g}{factor}",
            f"  after  {self.after:.15g}",
            f"  difference {self.difference:.2g}  (bound {self.bound:.2g})",
        ]
        for when, integral in (("before", self.found.before), ("after", self.found.after)):
            count = integral.nodes if isinstance(integral.nodes, int) else " × ".join(map(str, integral.nodes))
            told = (
                "resolved" if integral.resolved else f"not resolved: the last nodes added changed {integral.change:.2g}"
            )
            lines.append(f"  {when} the map, {count} nodes: {told}")
        return "\n".join(lines)

    def _words(self) -> str:
        if self.preserved is None:
            return "is not resolved, so that nothing is known of it"
        return "is preserved" if self.preserved else "changes by more than rounding"

    def as_record(self) -> dict[str, Any]:
        """The report as data for JSON: numbers that are not finite are text."""
        record: dict[str, Any] = {
            "integral": self.name,
            "verdict": self.verdict,
            "preserved": self.preserved,
            "factor": self.found.factor,
            "difference": _number(self.difference),
            "bound": _number(self.bound),
        }
        for when, integral in (("before", self.found.before), ("after", self.found.after)):
            record[when] = {
                "value": _number(integral.value),
                "bound": _number(integral.bound),
                "nodes": integral.nodes if isinstance(integral.nodes, int) else list(integral.nodes),
                "resolved": integral.resolved,
                "change": _number(integral.change),
                "tail": _number(integral.tail),
            }
        return record


def _number(x: float) -> float | str:
    return x if math.isfinite(x) else str(x)
