"""Assertions for the test suites of integrators, tracking codes and learned maps.

Each raises `AssertionError` with what fails, where, and by how much beside the rounding that is to be expected there.
The map is a function of a phase point z (2n,), of a pair (q, p), or of points (…, 2n), of numpy or jax; or a
`Transformation` given by formulas. `options` are those of `canon.audit`: `domain`, `samples`, `seed`, `space`,
`parameters`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, Final

import numpy as np

from canon.claims.audit import AuditReport, audit
from canon.errors import InputError

__all__ = [
    "assert_canonical",
    "assert_order",
    "assert_reversible",
    "assert_symplectic",
    "assert_volume_preserving",
]

Array = np.ndarray

PLATEAU: Final = 1e4
"""Differences of fewer roundings than this tell nothing about an order."""


def assert_symplectic(map: Any, *, dimension: int | None = None, **options: Any) -> AuditReport:  # noqa: A002
    """The map's Jacobian satisfies M J Mᵀ = J, all brackets, at every sample. **Returns** the audit's report."""
    return assert_canonical(map, dimension=dimension, scale=1.0, what="symplectic", **options)


def assert_canonical(
    map: Any,  # noqa: A002
    *,
    dimension: int | None = None,
    scale: float = 1.0,
    what: str = "canonical",
    **options: Any,
) -> AuditReport:
    """The map's Jacobian satisfies M J Mᵀ = scale J at every sample: canonical with that valence.

    **Returns:** the audit's report. **Raises:** `AssertionError` unless the audit's verdict is `supported`.
    """
    report = audit(map, dimension=dimension, scale=scale, **options)
    if report.verdict != "supported":
        valence = "" if scale == 1 else f" with valence {scale:g}"
        reasons = "; ".join(report.failures + report.doubts)
        raise AssertionError(f"{_name(map)} is not {what}{valence}: {reasons}\n{report}")
    return report


def assert_volume_preserving(map: Any, *, dimension: int | None = None, **options: Any) -> AuditReport:  # noqa: A002
    """|det M| = 1 at every sample (Liouville). **Returns** the audit's report."""
    report = audit(map, dimension=dimension, **options)
    found = report.volume
    if found.exceeds:
        raise AssertionError(
            f"{_name(map)} does not preserve volume: |det M| is off by {found.size:.3g}, bound {found.bound:.2g}, "
            f"at {report.at(found)}"
        )
    if report.doubts:
        raise AssertionError(f"{_name(map)}: volume could not be audited: {'; '.join(report.doubts)}")
    return report


def assert_reversible(
    map: Callable[..., Any],  # noqa: A002
    *,
    dimension: int,
    involution: Callable[[Array], Array] | None = None,
    domain: Any = None,
    samples: int = 1000,
    seed: int = 0,
) -> None:
    """R f R f = 1 at every sample, with R (q, p) = (q, −p), or another `involution` of points (N, 2n)."""
    from canon.claims.audit import variables
    from canon.numeric.differentiable import differentiable
    from canon.numeric.points import DEFAULT, points_of
    from canon.numeric.reversal import momentum_reversal, reversal_residuals
    from canon.numeric.worst import Tally

    names = variables(dimension)
    where = points_of(domain, names, [DEFAULT] * dimension)
    points = np.concatenate(list(where.blocks(samples, samples, seed)))
    mapped = differentiable(map, points, where.lengths)
    if not mapped.steady:
        raise AssertionError(f"{_name(map)} depends on hidden state: two evaluations at the same point differ")
    residuals = reversal_residuals(mapped, points, involution or momentum_reversal)
    missing = ~np.isfinite(residuals.sizes).all(axis=1)
    if missing.any():
        raise AssertionError(
            f"{_name(map)} has no finite value at {missing.sum()} of {len(points)} points or their images, "
            f"for instance from {_place(names, points[missing][0])}"
        )
    tally = Tally("reversal")
    tally.add(residuals, points)
    found = tally.defect()
    if found.exceeds:
        variable = names[tally.index[0]]
        raise AssertionError(
            f"{_name(map)} is not reversible: {variable} comes back off by {found.size:.3g}, "
            f"bound {found.bound:.2g}, from {_place(names, found.point)}"
        )


def assert_order(
    step: Callable[[Array, float], Any],
    order: int,
    *,
    start: Sequence[float] | Array,
    duration: float = 1.0,
    steps: int = 8,
    refinements: int = 5,
    tolerance: float = 0.25,
    exact: Sequence[float] | Array | None = None,
) -> float:
    """An integrator's order, measured on the user's problem, is at least `order − tolerance`.

    The problem is integrated over `duration` in `steps`, 2·`steps`, 4·`steps`, … steps. The order is the slope of the
    errors, against `exact` or between neighbours (self-convergence), as long as these are above the rounding plateau.
    Choose a non-linear problem: methods may be better than they are on linear ones.

    **Arguments:** `step(z, h)`, one step from z. **Returns:** the order measured at the finest steps that tell.

    **Raises:** `AssertionError` where it is less; `InputError` where too few errors are above the plateau.
    """
    from canon.numeric.precision import double

    ends = []
    with double():
        for level in range(refinements + 1):
            count = steps * 2**level
            z: Any = np.asarray(start, dtype=float)
            for _ in range(count):
                z = step(z, duration / count)
            ends.append(np.asarray(z, dtype=float))
    if not np.all(np.isfinite(ends)):
        raise AssertionError(f"{_name(step)} does not stay finite over the duration {duration:g}")
    if exact is None:
        errors = [float(np.linalg.norm(b - a)) for a, b in pairwise(ends)]
    else:
        errors = [float(np.linalg.norm(end - np.asarray(exact, dtype=float))) for end in ends]
    plateau = PLATEAU * float(np.finfo(float).eps) * (1 + float(np.linalg.norm(ends[-1])))
    telling = [error for error in errors if error > plateau]
    if len(telling) < 2:
        raise InputError(
            f"{len(telling)} errors are above the rounding plateau {plateau:.2g}, two are needed: take fewer steps"
        )
    measured = float(np.log2(telling[-2] / telling[-1]))
    if measured < order - tolerance:
        shown = ", ".join(f"{error:.3g}" for error in telling)
        raise AssertionError(
            f"{_name(step)} has order {measured:.2f}, not {order}: at halved steps its errors are {shown}"
        )
    return measured


def _name(map: Any) -> str:  # noqa: A002
    return getattr(map, "__name__", type(map).__name__)


def _place(names: Sequence[str], point: Sequence[float] | Array) -> str:
    return ", ".join(f"{name} = {x:.6g}" for name, x in zip(names, point, strict=True))
