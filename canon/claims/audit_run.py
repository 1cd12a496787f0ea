"""An audit under way: what has been found in the points so far.

Points are examined one by one in every respect (brackets, det M, condition, invariants), or swept: compared with their
bounds by a compiled loop, which picks the worst of them to be examined.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from canon.claims.audit_subject import AuditSubject
from canon.numeric.differences import kinks, misfits
from canon.numeric.differentiable import Differentiable, differentiable
from canon.numeric.noise import noise_of
from canon.numeric.points import Points
from canon.numeric.precision import NAMES, UNIT
from canon.numeric.residuals import Residuals, brackets, determinants, invariants, weighted_mean
from canon.numeric.sweep import SUSPECTS, Sweeper, sweeper
from canon.numeric.sweep_word import RESOLVED, Sweep
from canon.numeric.worst import Tally

Array = np.ndarray

BLOCK: Final = 2000
"""So many points are examined at once."""

FIRST: Final = 1000
"""Among so many points there must be some in the domain, for the map to be tried at."""

BEFORE_A_SWEEP: Final = 256
"""So many points are examined beside those that a sweep finds to be the worst."""

FEW: Final = 2000
"""So many points, or fewer, are all examined."""

LOOKS: Final = 4096
"""So many entries of Jacobians are looked at from both sides, to see whether the map bends there."""

CORNERED: Final = frozenset(["abs", "max", "min", "sign", "floor", "ceil", "round", "rem", "select"])

SLACK: Final = 1e-6
"""jax's derivatives and differences of values may differ by this part of them without a warning."""

COMPARED: Final = 3
"""At so many points the noise of values is measured for that."""


@dataclass
class AuditRun:
    """An audit under way: what has been found so far of a subject, at the points of `where` that a seed means."""

    subject: AuditSubject
    where: Points
    seed: int
    map: Differentiable | None = None
    checked: bool = False
    tallies: dict[str, Tally] = field(default_factory=dict)
    audited: int = 0
    examined: int = 0
    unresolved: int = 0
    failing: int = 0
    missing: int = 0
    missing_point: Array | None = None
    rough: int = 0
    rough_point: Array | None = None
    bent: int = 0
    bent_point: Array | None = None
    looked_at: int = 0
    outside: int = 0
    valence: float | None = None
    valence_error: float = 0.0
    valences: tuple[float, float] = (np.inf, -np.inf)
    dets: tuple[float, float] = (np.inf, -np.inf)
    condition: float = 0.0
    doubts: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def audit(self, samples: int) -> None:
        """Audit so many points, or all that are given."""
        count = samples if self.where.given is None else len(self.where.given)
        start = 0
        while start < count:
            index = np.arange(start, min(start + (BLOCK if start else FIRST), count), dtype=np.uint64)
            if self.map is None:
                self._open(index)
            if self._worth_sweeping(count - start):
                index = index[:BEFORE_A_SWEEP]
                worst = self._sweep(start + len(index), count)
                self.examine(index, worst)
                return
            self.examine(index)
            start += len(index)

    def _open(self, index: Array) -> None:
        """Find out what the map is, at points of these indices, if any of them lies in its domain."""
        points = self.where.at(index, self.seed)
        inside = points[self.subject.inside(points)]
        if len(inside):
            self.map = differentiable(
                self.subject.function, inside, self.where.lengths, rounded_numbers=self.subject.rounded_numbers
            )

    def _worth_sweeping(self, count: int) -> bool:
        return self.map is not None and self.map.program is not None and count > FEW

    # -- points one by one -------------------------------------------------------------------------------

    def examine(self, index: Array, worst: Array | None = None) -> None:
        """Examine the points of these indices, and of the `worst`, which a sweep has counted already."""
        points = self.where.at(index if worst is None else np.concatenate([index, worst]), self.seed)
        within = self.subject.inside(points)
        inside, count = points[within], int(within[: len(index)].sum())
        self.outside += len(index) - count
        if not len(inside):
            return
        assert self.map is not None
        values = self.map.evaluate(inside)
        M, E = self.map.linearise(inside)
        if not self.checked:
            self._check(inside, M, E)
        finite = np.asarray(np.isfinite(values).all(axis=1))
        smooth = finite & np.asarray(np.isfinite(M).all(axis=(1, 2)))
        self._leave_out(inside[:count], finite[:count], smooth[:count])
        self._look_for_kinks(inside[:count][smooth[:count]])
        if smooth.any():
            self._tally(inside[smooth], M[smooth], E[smooth], int(smooth[:count].sum()))

    def _leave_out(self, points: Array, finite: Array, smooth: Array) -> None:
        self.missing += int(len(points) - finite.sum())
        self.rough += int((finite & ~smooth).sum())
        if not finite.all() and self.missing_point is None:
            self.missing_point = points[~finite][0]
        if (finite & ~smooth).any() and self.rough_point is None:
            self.rough_point = points[finite & ~smooth][0]

    def _look_for_kinks(self, points: Array) -> None:
        """Look at the two sides of points, of so many as that costs little; formulas without corners need no look."""
        assert self.map is not None
        program = self.map.program
        cornered = program is None or any(operation.name in CORNERED for operation in program.operations)
        points = points[: max(0, LOOKS // points.shape[1] ** 2 - self.looked_at)]
        if not cornered or not self.map.steady or not len(points):
            return
        bent = self.bends_at(points)
        self.looked_at += len(points)
        self.bent += int(bent.sum())
        if bent.any() and self.bent_point is None:
            self.bent_point = points[bent][0]

    def bends_at(self, points: Array) -> Array:
        """At which points (N, 2n) differences to the two sides differ, by more than the map's own noise."""
        assert self.map is not None
        return kinks(self.map.evaluate, points, self.where.lengths, self.map.unit, self.map.noise)

    def _check(self, points: Array, M: Array, E: Array) -> None:
        """Look for hidden state, low precision, and derivatives that are not those of the values."""
        assert self.map is not None
        self.checked = True
        if not self.map.steady:
            self.doubts.append("two evaluations at the same point differ: the map depends on hidden state")
        if self.map.unit > UNIT:
            self.notes.append(
                f"the map computes in {NAMES[self.map.unit]}: its rounding is {self.map.unit:.1g} where float64's is "
                "1.1e-16, and so are the bounds"
            )
        if self.map.noise:
            self.notes.append(
                f"the map's values jump by about {self.map.noise:.1g} over tiny steps, as where part of it computes in "
                "float32, or stops at a tolerance: the estimated errors allow for that"
            )
        if self.map.kind == "jax":
            self._compare_derivatives(points, M, E)

    def _compare_derivatives(self, points: Array, M: Array, E: Array) -> None:
        """Compare derivatives with differences of values, at each of the first points along a direction of its own."""
        assert self.map is not None
        count = max(1, min(len(points), LOOKS // points.shape[1] ** 2))
        points, M, E = points[:count], M[:count], E[:count]
        evaluate, lengths, unit = self.map.evaluate, self.where.lengths, self.map.unit
        usable = np.isfinite(M).all(axis=(1, 2)) & np.isfinite(E).all(axis=(1, 2))
        if not usable.any():
            return
        points, M, E = points[usable], M[usable], E[usable]
        noise = noise_of(evaluate, points[:COMPARED], lengths, unit)
        wrong = misfits(evaluate, points, M, E, lengths, unit, noise, unseen=SLACK)
        if wrong.any():
            wrong[wrong] = ~self.bends_at(points[wrong])  # there any derivative is one of several
        if wrong.any():
            self.doubts.append(
                "the derivatives are not those of the values (a rounding, a stopped gradient, or a custom derivative) "
                f"at {int(wrong.sum())} of {len(points)} points, for instance at {self.place(points[wrong][0])}"
            )

    def _tally(self, points: Array, M: Array, E: Array, counted: int) -> None:
        """Take points into account; of these the first `counted` have not been counted by a sweep."""
        expected = self.subject.scale
        with np.errstate(all="ignore"):
            found = brackets(M, E)
            at_points, errors = found.valence()
            if self.valence is None:
                leading = counted or len(points)
                self.valence, self.valence_error = weighted_mean(at_points[:leading], errors[:leading])
            families = found.residuals(expected)
            about_c = found.residuals(self.valence, self.valence_error)
            fitted = [Residuals("symplectic", r.sizes, r.bounds) for r in about_c]
            det, det_bound, condition = determinants(M, E, self.where.lengths)
            target = abs(expected) ** (M.shape[1] // 2)
            volume = Residuals("volume", np.abs(np.abs(det) - target), det_bound)
            orders = invariants(M, E, expected)
        exceeds = np.zeros(len(points), dtype=bool)
        for residuals in families:
            exceeds |= (residuals.sizes > residuals.bounds).any(axis=(1, 2))
        for residuals in (*families, *fitted, volume, *orders):
            self.tallies.setdefault(residuals.name, Tally(residuals.name)).add(residuals, points, typical=counted)
        self.examined += len(points)
        resolved = np.einsum("bii->bi", found.QP_bound).max(axis=1) <= RESOLVED * abs(expected)
        self.audited += counted
        self.failing += int(exceeds[:counted].sum())
        self.unresolved += int((~resolved[:counted]).sum())
        if resolved.any():
            values, dets = at_points[resolved], det[resolved]
            self.valences = (min(self.valences[0], values.min()), max(self.valences[1], values.max()))
            self.dets = (min(self.dets[0], dets.min()), max(self.dets[1], dets.max()))
            self.condition = max(self.condition, float(condition[resolved].max()))

    # -- points by the million ---------------------------------------------------------------------------

    def _sweep(self, start: int, count: int) -> Array:
        """Sweep the points from `start` to `count`; **returns** the indices of the worst of every block."""
        assert self.map is not None
        assert self.map.program is not None
        loop = sweeper(
            self.map.program,
            self.where,
            self.seed,
            self.subject.scale,
            count=count - start,
            admits=self.subject.membership,
            rounded_numbers=self.subject.rounded_numbers,
        )
        worst, suspects = [np.zeros(0, dtype=int)], [np.zeros(0, dtype=int)]
        for begin in range(start, count, loop.block):
            length = min(loop.block, count - begin)
            found = self._swept(loop, begin, length)
            worst.append(begin + self._count(found, begin, length))
            suspects.append(begin + found.exceeds)
            last = begin + length == count
            if last or sum(map(len, suspects)) >= SUSPECTS:
                waiting = np.concatenate(suspects)
                full = len(waiting) if last else len(waiting) // SUSPECTS * SUSPECTS
                worst.append(self._suspected(loop, waiting[:full]))
                suspects = [waiting[full:]]
            if sum(map(len, worst)) >= BLOCK:
                self.examine(np.zeros(0, dtype=np.uint64), np.unique(np.concatenate(worst)).astype(np.uint64))
                worst = [np.zeros(0, dtype=int)]
        return np.unique(np.concatenate(worst)).astype(np.uint64)

    def _swept(self, loop: Sweeper, begin: int, length: int) -> Sweep:
        if self.where.given is not None:
            return loop.given(self.where.given[begin : begin + length])
        return loop.generated(begin, length)

    def _count(self, found: Sweep, begin: int, length: int) -> Array:
        """Count what a sweep found; **returns** the positions of the points with the largest residuals."""
        missing, rough = found.undefined, found.rough
        self.outside += len(found.outside)
        self.missing += len(missing)
        self.rough += len(rough)
        if len(missing) and self.missing_point is None:
            self.missing_point = self._points([begin + missing[0]])[0]
        if len(rough) and self.rough_point is None:
            self.rough_point = self._points([begin + rough[0]])[0]
        usable = length - len(found.outside) - len(missing) - len(rough)
        self.audited += usable
        if not usable:
            return np.zeros(0, dtype=int)
        return np.array([int(half.argmax()) for half in (found.QQ, found.PP, found.QP)])

    def _suspected(self, loop: Sweeper, index: Array) -> Array:
        """Compare points with their whole bounds; **returns** the indices of those that exceed them most."""
        worst = []
        for start in range(0, len(index), SUSPECTS):
            part = index[start : start + SUSPECTS]
            found = loop.bounded(part.astype(np.uint64))
            self.failing += len(found.exceeds)
            self.unresolved += len(found.unresolved)
            worst.append(part[int(found.ratio.argmax())])
        return np.array(worst, dtype=int)

    def _points(self, index: Sequence[int] | Array) -> Array:
        return self.where.at(np.asarray(index, dtype=np.uint64), self.seed)

    def place(self, point: Sequence[float] | Array) -> str:
        """A point by the variables' names."""
        return ", ".join(f"{name} = {x:.6g}" for name, x in zip(self.subject.names, point, strict=True))
