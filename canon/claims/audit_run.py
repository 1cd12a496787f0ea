"""An audit under way: what has been found in the blocks of points so far, and the report in the end."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Final

import numpy as np

from canon.claims.audit_report import AuditReport
from canon.claims.audit_subject import AuditSubject
from canon.errors import InputError
from canon.numeric.differences import central_differences
from canon.numeric.differentiable import Differentiable, differentiable
from canon.numeric.points import Points
from canon.numeric.precision import UNIT_32
from canon.numeric.residuals import Residuals, brackets, determinants, invariants
from canon.numeric.worst import Tally

Array = np.ndarray

BLOCK: Final = 2000
COMPARED: Final = 3
SLACK: Final = 1e-6
"""Derivatives and differences of values may differ by this part without a warning."""

RESOLVED: Final = 1e-2
"""A bracket {Q,P} whose error's bound is a larger part of the scale tells nothing."""

LEAST: Final = 0.5
"""The part of the points at which the map must be finite for a verdict of `supported`."""

ENOUGH: Final = 0.9
"""The part of the audited points that must be resolved for a verdict of `supported`."""


@dataclass
class AuditRun:
    """An audit under way: what has been found in the blocks so far."""

    subject: AuditSubject
    where: Points
    map: Differentiable | None = None
    tallies: dict[str, Tally] = field(default_factory=dict)
    audited: int = 0
    unresolved: int = 0
    undefined: list[Array] = field(default_factory=list)
    missing: int = 0
    rough: int = 0
    rough_point: Array | None = None
    valence: float | None = None
    valences: tuple[float, float] = (np.inf, -np.inf)
    dets: tuple[float, float] = (np.inf, -np.inf)
    condition: float = 0.0
    failures: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    outside: int = 0
    first: bool = True

    def add(self, points: Array) -> None:
        """Audit a further block."""
        inside = points[self.subject.admits(points)]
        self.outside += len(points) - len(inside)
        if not len(inside):
            return
        if self.map is None:
            self.map = differentiable(self.subject.function, inside, self.where.lengths)
        count = len(inside)
        padded = np.concatenate([inside, np.repeat(inside[-1:], len(points) - count, axis=0)])
        if self.audited + self.missing + self.rough and len(padded) < BLOCK:
            padded = np.concatenate([padded, np.repeat(padded[-1:], BLOCK - len(padded), axis=0)])
        values = self.map.evaluate(padded)[:count]
        M, E = (array[:count] for array in self.map.linearise(padded))
        if self.first:
            self.first = False
            self._check(padded, M, E)
        finite = np.isfinite(values).all(axis=1)
        smooth = finite & np.isfinite(M).all(axis=(1, 2))
        self.missing += int(count - finite.sum())
        if not finite.all() and not self.undefined:
            self.undefined.append(inside[~finite][0])
        if (finite & ~smooth).any():
            self.rough += int((finite & ~smooth).sum())
            self.rough_point = inside[finite & ~smooth][0]
        if smooth.any():
            self._tally(inside[smooth], M[smooth], E[smooth])

    def _check(self, points: Array, M: Array, E: Array) -> None:
        """Look for hidden state, low precision, and derivatives that are not those of the values."""
        assert self.map is not None
        if not self.map.steady:
            self.doubts.append("two evaluations at the same point differ: the map depends on hidden state")
        if self.map.unit == UNIT_32:
            self.notes.append(
                f"the map computes in float32: its rounding is {UNIT_32:.1g} where float64's is 1.1e-16, "
                "and so are the bounds"
            )
        if self.map.kind == "jax":
            self._compare_derivatives(points, M, E)

    def _compare_derivatives(self, points: Array, M: Array, E: Array) -> None:
        """Compare the derivative along one direction with differences of values, at the first few points."""
        assert self.map is not None
        evaluate, count = self.map.evaluate, len(points)
        direction = self.where.lengths * np.cos(np.arange(1, points.shape[1] + 1))
        compared = False
        for z, slope, off in zip(points[:COMPARED], M, E, strict=False):

            def along(s: Array, z: Array = z) -> Array:
                # points enough for the program that is compiled already
                return evaluate(np.repeat(z + s * direction, count, axis=0))[:1]

            difference, error = central_differences(along, np.zeros((1, 1)), np.full(1, 0.1), self.map.unit)
            gap = np.abs(slope @ direction - difference[0, :, 0])
            size = np.abs(slope) @ np.abs(direction)
            if np.all(gap <= error[0, :, 0] + off @ np.abs(direction) + SLACK * size):
                return
            compared = compared or bool(np.all(np.isfinite(gap)))
        if compared:
            self.doubts.append(
                "the derivatives are not those of the values: a rounding, a stopped gradient, or a custom derivative"
            )

    def _tally(self, points: Array, M: Array, E: Array) -> None:
        expected = self.subject.scale
        with np.errstate(all="ignore"):
            found = brackets(M, E)
            at_points, errors = found.valence()
            if self.valence is None:
                weights = 1 / np.maximum(errors, 1e-300) ** 2
                weights = np.ones_like(errors) if not np.isfinite(weights.sum()) or not weights.sum() else weights
                self.valence = float((weights * at_points).sum() / weights.sum())
            families = found.residuals(expected)
            fitted = [Residuals("symplectic", r.sizes, r.bounds) for r in found.residuals(self.valence)]
            lengths = self.where.lengths
            det, det_bound, condition = determinants(M, E, lengths)
            target = abs(expected) ** (M.shape[1] // 2)
            volume = Residuals("volume", np.abs(np.abs(det) - target), det_bound)
            orders = invariants(M, E, expected)
        for residuals in (*families, *fitted, volume, *orders):
            self.tallies.setdefault(residuals.name, Tally(residuals.name)).add(residuals, points)
        self.audited += len(points)
        resolved = np.einsum("bii->bi", found.QP_bound).max(axis=1) <= RESOLVED * abs(expected)
        self.unresolved += int((~resolved).sum())
        if resolved.any():
            values, dets = at_points[resolved], det[resolved]
            self.valences = (min(self.valences[0], values.min()), max(self.valences[1], values.max()))
            self.dets = (min(self.dets[0], dets.min()), max(self.dets[1], dets.max()))
            self.condition = max(self.condition, float(condition[resolved].max()))

    def report(self, samples: int, seed: int, start: float) -> AuditReport:
        """What was found, with the verdict."""
        if self.map is None:
            raise InputError(f"none of {samples} points lies in the domain of the formulas", "domain")
        self._describe_gaps(samples)
        if not self.audited:
            raise InputError(
                "there is no point at which the map and its derivatives are finite: " + "; ".join(self.notes)
            )
        defects = {name: tally.defect() for name, tally in self.tallies.items()}
        families = {name: defects[name] for name in ("{Q,Q}", "{P,P}", "{Q,P}")}
        witness = None
        for defect in families.values():
            if defect.exceeds:
                place = ", ".join(f"{x} = {v:.6g}" for x, v in zip(self.subject.names, defect.point, strict=True))
                self.failures.append(
                    f"{defect.label} is off by {defect.size:.3g}, bound {defect.bound:.2g}, at {place}"
                )
                witness = witness or self._confirmed(defect.name)
        if self.unresolved > (1 - ENOUGH) * self.audited:
            self.doubts.append(f"bounds are too large to tell anything at {self.unresolved} of {self.audited} points")
        elif self.unresolved:
            self.notes.append(f"bounds are too large to tell anything at {self.unresolved} of {self.audited} points")
        if self.audited < LEAST * samples:
            self.doubts.append(f"only {self.audited} of {samples} points could be audited")
        assert self.valence is not None
        self._describe_valence(any(d.exceeds for d in families.values()), defects["symplectic"].exceeds)
        return AuditReport(
            verdict="refuted" if witness else "undecided" if self.failures or self.doubts else "supported",
            map=self.subject.kind or f"{self.map.kind} function of {self.map.form}",
            dimension=self.map.dimension,
            scale=self.subject.scale,
            derivatives=self.map.method,
            errors=self.map.errors,
            domain=str(self.where),
            seed=seed,
            samples=samples,
            audited=self.audited,
            unresolved=self.unresolved,
            valence=self.valence,
            valence_range=(float(self.valences[0]), float(self.valences[1])),
            symplectic=defects["symplectic"],
            brackets=families,
            volume=defects["volume"],
            determinant=(float(self.dets[0]), float(self.dets[1])),
            condition=self.condition,
            invariants=tuple(d for name, d in defects.items() if name.startswith("order")),
            variables=tuple(self.subject.names),
            failures=tuple(self.failures),
            doubts=tuple(self.doubts),
            notes=tuple(self.notes),
            witness=witness,
            seconds=time.monotonic() - start,
        )

    def _describe_gaps(self, samples: int) -> None:
        assert self.map is not None
        if self.outside:
            self.notes.append(f"{self.outside} of {samples} points lie outside the domain of the formulas")
        if self.missing:
            raised = self.map.first_exception
            what = f"raises ({raised}) or has no finite value" if raised else "has no finite value"
            self.notes.append(
                f"the map {what} at {self.missing} of {samples} points ({self.missing / samples:.3g}), "
                f"for instance at {self._place(self.undefined[0])}"
            )
        if self.rough_point is not None:
            self.notes.append(
                f"the map is not differentiable at {self.rough} points, for instance at {self._place(self.rough_point)}"
            )

    def _describe_valence(self, fails: bool, fails_fitted: bool) -> None:
        if fails and not fails_fitted and self.valence:
            self.notes.append(f"all brackets agree with valence {self.valence:.12g} instead of {self.subject.scale:g}")

    def _place(self, point: Sequence[float] | Array) -> str:
        return ", ".join(f"{name} = {x:.6g}" for name, x in zip(self.subject.names, point, strict=True))

    def _confirmed(self, name: str) -> Mapping[str, Any] | None:
        """The witness in balls of a family's worst bracket, if the map is given by formulas."""
        if self.subject.transformation is None:
            return None
        from canon.claims.confirm import certified_failure

        tally = self.tallies[name]
        n = len(self.subject.names) // 2
        i, j = tally.index
        row, column = (i if name[1] == "Q" else i + n), (j if name[3] == "Q" else j + n)
        expected = self.subject.exact_scale if name == "{Q,P}" and i == j else Fraction(0)
        found = certified_failure(
            self.subject.transformation, row, column, expected, tally.point, self.subject.parameters
        )
        return None if found is None else found.as_table()
