"""From an audit's findings to its report: what fails, what is in doubt, and the verdict."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Final

import numpy as np

from canon.claims.audit_report import AuditReport
from canon.claims.audit_run import AuditRun
from canon.errors import InputError

LEAST: Final = 0.5
"""The part of the points at which the map must be finite for a verdict of `supported`."""

ENOUGH: Final = 0.9
"""The part of the audited points that must be resolved for a verdict of `supported`."""

FAMILIES: Final = ("{Q,Q}", "{P,P}", "{Q,P}")


def conclude(run: AuditRun, samples: int, start: float) -> AuditReport:
    """The report of an audit of `samples` points that began at the time `start`.

    **Raises:** `InputError` where there is no point at which the map and its derivatives are finite.
    """
    if run.map is None:
        raise InputError(f"none of {samples} points lies in the domain of the formulas", "domain")
    notes, doubts, failures = [*run.notes, *_gaps(run, samples)], [*run.doubts], []
    if not run.examined:
        raise InputError("there is no point at which the map and its derivatives are finite: " + "; ".join(notes))
    defects = {name: tally.defect() for name, tally in run.tallies.items()}
    families = {name: defects[name] for name in FAMILIES}
    witness = None
    for defect in families.values():
        if defect.exceeds:
            failures.append(
                f"{defect.label} is off by {defect.size:.3g}, bound {defect.bound:.2g}, at {run.place(defect.point)}"
            )
            # what differs from one evaluation to the next is no map that could be refuted
            witness = witness or (_confirmed(run, defect.name) if run.map.steady else None)
            bent = _bent(run, defect.point)
            if bent and bent not in doubts:
                doubts.append(bent)
    if run.failing and not failures:
        doubts.append(f"brackets exceed their bounds at {run.failing} points, by less than rounding tells")
    elif run.failing and run.failing < run.audited:
        notes.append(f"brackets exceed their bounds at {run.failing} of {run.audited} points")
    if run.bent_point is not None and _mostly_bent(run):
        doubts.append(_bends(run))
    if run.unresolved:
        vague = f"bounds are too large to tell anything at {run.unresolved} of {run.audited} points"
        (doubts if run.unresolved > (1 - ENOUGH) * run.audited else notes).append(vague)
    if run.audited < LEAST * samples:
        doubts.append(f"only {run.audited} of {samples} points could be audited")
    assert run.valence is not None
    if failures and not defects["symplectic"].exceeds and run.valence:
        notes.append(f"all brackets agree with valence {_apart(run.valence, run.subject.scale)}")
    return AuditReport(
        verdict="refuted" if witness else "undecided" if failures or doubts else "supported",
        map=run.subject.kind or f"{run.map.kind} function of {run.map.form}",
        dimension=run.map.dimension,
        scale=run.subject.scale,
        derivatives=run.map.method,
        errors=run.map.errors,
        domain=str(run.where),
        seed=run.seed,
        samples=samples,
        audited=run.audited,
        examined=run.examined,
        failing=run.failing,
        unresolved=run.unresolved,
        valence=run.valence,
        valence_range=_range(run.valences),
        symplectic=defects["symplectic"],
        brackets=families,
        volume=defects["volume"],
        determinant=_range(run.dets),
        condition=run.condition if run.condition else math.nan,
        invariants=tuple(d for name, d in defects.items() if name.startswith("order")),
        variables=tuple(run.subject.names),
        failures=tuple(failures),
        doubts=tuple(doubts),
        notes=tuple(notes),
        witness=witness,
        seconds=time.monotonic() - start,
    )


def _range(ends: tuple[float, float]) -> tuple[float, float]:
    """The least and the largest value at points that are resolved; nan where none is."""
    low, high = map(float, ends)
    return (low, high) if low <= high else (math.nan, math.nan)


def _apart(valence: float, scale: float) -> str:
    """A valence beside the one that was expected, so that they can be told apart."""
    if f"{valence:.12g}" != f"{scale:.12g}":
        return f"{valence:.12g} instead of {scale:.12g}"
    sign = "+" if valence > scale else "−"
    return f"{scale:.12g} {sign} {abs(valence - scale):.2g} instead of {scale:.12g}"


def _bent(run: AuditRun, point: tuple[float, ...]) -> str:
    """What to say of a point at which the map fails because it has no derivative there; nothing elsewhere."""
    assert run.map is not None
    if not run.map.steady or not run.bends_at(np.array([point]))[0]:
        return ""
    return f"the map is not differentiable at {run.place(point)}: its differences to the two sides differ"


def _gaps(run: AuditRun, samples: int) -> list[str]:
    """Where the map could not be audited."""
    assert run.map is not None
    found = []
    if run.outside:
        found.append(f"{run.outside} of {samples} points lie outside the domain of the formulas")
    if run.missing_point is not None:
        raised = run.map.first_exception
        what = f"raises ({raised}) or has no finite value" if raised else "has no finite value"
        found.append(
            f"the map {what} at {run.missing} of {samples} points ({run.missing / samples:.3g}), "
            f"for instance at {run.place(run.missing_point)}"
        )
    if run.rough_point is not None:
        found.append(
            f"the map is not differentiable at {run.rough} points, for instance at {run.place(run.rough_point)}"
        )
    if run.bent_point is not None and not _mostly_bent(run):
        found.append(_bends(run))
    return found


def _mostly_bent(run: AuditRun) -> bool:
    """Whether the map has no derivative at most points, so that the derivatives found there are none."""
    return 2 * run.bent > run.looked_at


def _bends(run: AuditRun) -> str:
    """Where the map bends, and at how many points."""
    assert run.bent_point is not None
    return (
        f"the map seems not to be differentiable at {run.bent} of {run.looked_at} points that were looked at, "
        f"for instance at {run.place(run.bent_point)}: its differences to the two sides differ"
    )


def _confirmed(run: AuditRun, name: str) -> Mapping[str, Any] | None:
    """The witness in balls of a family's worst bracket, if the map is given by formulas or by a jax program."""
    subject, tally = run.subject, run.tallies[name]
    n = len(subject.names) // 2
    i, j = tally.index
    row, column = (i if name[1] == "Q" else i + n), (j if name[3] == "Q" else j + n)
    if subject.transformation is not None:
        from canon.claims.confirm import certified_failure

        expected = subject.exact_scale if name == "{Q,P}" and i == j else Fraction(0)
        found = certified_failure(subject.transformation, row, column, expected, tally.point, subject.parameters)
        return None if found is None else found.as_table()
    assert run.map is not None
    if run.map.program is None:
        return None
    from canon.claims.confirm import confirmed_by_program

    values = run.map.program.select(run.map.program.outputs[: 2 * n])
    if not confirmed_by_program(values, row, column, subject.exact_scale, tally.point, tally.bound):
        return None
    return {name: str(Fraction(x)) for name, x in zip(subject.names, tally.point, strict=True)}
