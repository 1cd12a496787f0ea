"""What an audit of a map found: evidence beside its rounding bounds, and a verdict that claims no more than that."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

from canon.display import list_in_html, status_in_html, table_in_html
from canon.errors import CanonError
from canon.expected import instance_of, listed
from canon.numeric.worst import Defect

if TYPE_CHECKING:
    from canon.claims.invariance_report import Invariance


class AuditFailed(CanonError):
    """A map that was required to pass its audit did not: `report` says where, and by how much."""

    def __init__(self, report: AuditReport) -> None:
        super().__init__(report)
        self.report = report

    def __str__(self) -> str:
        return str(self.report)


@dataclass(frozen=True)
class AuditReport:
    """The numerical evidence on M J Mᵀ = scale J for one map.

    **Fields:**

    - `verdict`: `supported`, if no residual exceeds its bound; `refuted`, if the map is given by formulas, or by a
      function that jax can trace, and balls confirm a residual at an exact point (`witness`); otherwise `undecided`,
      damning evidence or not (`failures`).
    - `map`: "formulas", "jax function" or "numpy function"; `derivatives`: how M was found; `errors`: whether the
      bounds on M are running bounds ("bound") or estimates ("estimate").
    - `brackets`: the worst of {Q,Q}, {P,P} and {Q,P}, each apart; `symplectic`: the worst of M J Mᵀ − c J with the
      fitted `valence` c; `volume`: |det M| − |scale|ⁿ; `invariants`: the integral invariants of orders 1 to n.
    - `determinant`: the least and the largest det M; `condition`: the largest condition number of M,
      with each variable in units of the length over which it is sampled. Both are of the resolved points, nan where
      there is none.
    - `samples`, `audited`: points tried, and points at which everything was finite; `failing`: those of the latter
      where a bracket exceeds its bound; `unresolved`: those whose bound on {Q,P} is too large to tell anything, of the
      points whose whole bound was computed. No bracket of an audited point exceeds its own bound unseen; `examined`
      counts the points, the first ones and the worst of the others, of which the rest (det M, condition, invariants,
      typical sizes) is known.
    - `integrals`: ∮ p dq and ∬ dp∧dq before and after the map, where the audit was asked for them.
    - `failures`: brackets and integrals that exceed their bounds; `doubts`: other reasons why the verdict isn't
      `supported` (hidden state, wrong derivatives, too few points); `notes`: what else was noticed.
    """

    verdict: Literal["supported", "refuted", "undecided"]
    map: str
    dimension: int
    scale: float
    derivatives: str
    errors: str
    domain: str
    seed: int
    samples: int
    audited: int
    examined: int
    failing: int
    unresolved: int
    valence: float
    valence_range: tuple[float, float]
    symplectic: Defect
    brackets: Mapping[str, Defect]
    volume: Defect
    determinant: tuple[float, float]
    condition: float
    invariants: tuple[Defect, ...]
    variables: tuple[str, ...]
    integrals: tuple[Invariance, ...] = ()
    failures: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    witness: Mapping[str, Any] | None = None
    seconds: float = field(default=0.0, compare=False)

    def with_integrals(self, found: Sequence[Invariance]) -> AuditReport:
        """The report with integral invariants: one that changes is a failure, one that isn't resolved a note."""
        from canon.claims.invariance_report import Invariance

        found = listed(found, "integral invariants, as of loop_invariant,", "found")
        for item in found:
            instance_of(item, Invariance, "found")
        changed = tuple(
            f"{item.name} changes by {item.difference:.2g} (bound {item.bound:.2g})"
            for item in found
            if item.preserved is False
        )
        unknown = tuple(f"{item.name} is not resolved" for item in found if item.preserved is None)
        return replace(
            self,
            verdict="undecided" if changed and self.verdict == "supported" else self.verdict,
            integrals=(*self.integrals, *found),
            failures=(*self.failures, *changed),
            notes=(*self.notes, *unknown),
        )

    @property
    def worst(self) -> Defect:
        """The bracket that exceeds its bound by the largest factor."""
        return max(self.brackets.values(), key=lambda d: d.size / d.bound if d.bound else math.inf if d.size else 0.0)

    def __bool__(self) -> bool:
        """False if refuted; evidence is no truth value otherwise. **Raises:** `TypeError` then."""
        if self.verdict == "refuted":
            return False
        raise TypeError(f"the map is {self.verdict}, which is neither true nor false: look at .verdict, or .require()")

    def require(self) -> AuditReport:
        """This report, if its verdict is `supported`; **raises** `AuditFailed` otherwise."""
        if self.verdict != "supported":
            raise AuditFailed(self)
        return self

    def at(self, defect: Defect) -> str:
        """Where a defect is worst, by the variables' names."""
        instance_of(defect, Defect, "defect")
        return ", ".join(f"{name} = {x:.6g}" for name, x in zip(self.variables, defect.point, strict=True))

    def __str__(self) -> str:
        scale = "" if self.scale == 1 else f" with valence {self.scale:g}"
        kind = "rounding bounds" if self.errors == "bound" else "estimated errors"
        lines = [
            f"{self.verdict}: symplectic{scale}, dimension {self.dimension}, "
            f"at {self.audited} of {self.samples} points in {self.domain}",
            f"  {self.map}, {self.derivatives}, {kind}",
            *(f"  fails: {text}" for text in self.failures),
            *(f"  in doubt: {text}" for text in self.doubts),
        ]
        if self.witness is not None:
            place = ", ".join(f"{key} = {value}" for key, value in self.witness.items())
            lines.append(f"  confirmed in balls at {place}")
        lines += [f"  {defect}" for defect in self.brackets.values()]
        lines.append(f"  valence c {self.valence:.12g}, at single points {_span(self.valence_range, '.12g')}")
        lines.append(f"  M J Mᵀ − c J {self.symplectic.size:.2g}  (bound {self.symplectic.bound:.2g})")
        lines.append(f"  det M     {_span(self.determinant, '.12g')}  (bound {self.volume.bound:.2g})")
        lines.append(f"  condition of M {_most(self.condition)}")
        if self.invariants:
            shown = ", ".join(f"{d.size:.2g} (bound {d.bound:.2g})" for d in self.invariants)
            lines.append(f"  integral invariants of orders 1 to {len(self.invariants)}: {shown}")
        for item in self.integrals:
            lines.append(f"  {item.name} {item.before:.12g}, after the map {item.after:.12g} (bound {item.bound:.2g})")
        lines += [f"  note: {text}" for text in self.notes]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        first, *rest = str(self).split("\n")
        measured = [*self.brackets.values(), self.symplectic, self.volume, *self.invariants]
        names = [
            *(defect.label for defect in self.brackets.values()),
            "M J Mᵀ − c J",
            "|det M|",
            *(f"invariant {k + 1}" for k in range(len(self.invariants))),
        ]
        rows = [
            (name, f"{d.size:.2g}", f"{d.bound:.2g}", "yes" if d.size <= d.bound else "no, " + self.at(d))
            for name, d in zip(names, measured, strict=True)
        ]
        table = table_in_html(("residual", "largest", "bound", "within it"), rows)
        told = [line.strip() for line in rest if line.strip().startswith(("fails", "in doubt", "confirmed", "note"))]
        return f"<div>{status_in_html(self.verdict, first.partition(': ')[2])}{table}{list_in_html(told)}</div>"

    def as_record(self) -> dict[str, Any]:
        """The report as data for JSON: numbers that are not finite are text."""
        return {
            "verdict": self.verdict,
            "map": self.map,
            "dimension": self.dimension,
            "scale": self.scale,
            "derivatives": self.derivatives,
            "errors": self.errors,
            "domain": self.domain,
            "seed": self.seed,
            "samples": self.samples,
            "audited": self.audited,
            "examined": self.examined,
            "failing": self.failing,
            "unresolved": self.unresolved,
            "valence": {"fitted": _number(self.valence), "range": [_number(x) for x in self.valence_range]},
            "symplectic": self._defect(self.symplectic),
            "brackets": {name: self._defect(defect) for name, defect in self.brackets.items()},
            "volume": self._defect(self.volume),
            "determinant": [_number(x) for x in self.determinant],
            "condition": _number(self.condition),
            "invariants": [self._defect(defect) for defect in self.invariants],
            "integrals": [item.as_record() for item in self.integrals],
            "failures": list(self.failures),
            "doubts": list(self.doubts),
            "notes": list(self.notes),
            "witness": None if self.witness is None else {key: str(value) for key, value in self.witness.items()},
            "seconds": round(self.seconds, 6),
        }

    def _defect(self, defect: Defect) -> dict[str, Any]:
        return {
            "entry": defect.label,
            "residual": _number(defect.size),
            "bound": _number(defect.bound),
            "at": {name: _number(x) for name, x in zip(self.variables, defect.point, strict=True)},
            "largest": _number(defect.largest),
            "typical": _number(defect.typical),
            "typical_bound": _number(defect.typical_bound),
        }


def _number(x: float) -> float | str:
    return x if math.isfinite(x) else str(x)


def _span(ends: tuple[float, float], form: str) -> str:
    if math.isnan(ends[0]):
        return "not resolved"
    low, high = (format(x, form) for x in ends)
    return low if low == high else f"{low} to {high}"


def _most(condition: float) -> str:
    return "not resolved" if math.isnan(condition) else f"at most {condition:.3g}"
