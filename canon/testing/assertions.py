"""Assertions for the test suites of integrators, tracking codes and learned maps.

Each raises `AssertionError` with what fails, where, and by how much beside the rounding that is to be expected there.
The map is a function of a phase point z (2n,), of a pair (q, p), or of points (…, 2n), of numpy or jax; or a
`Transformation` given by formulas. One that raises, or isn't finite, wherever it is tried fails as well; what is no
real map of phase points, by its shape or type, is an `InputError`. `options` are those of `canon.audit`: `domain`,
`samples`, `seed`, `space`, `parameters`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from canon.claims.audit import AuditReport, audit
from canon.errors import NoValue
from canon.expected import function, whole_number

__all__ = [
    "assert_canonical",
    "assert_reversible",
    "assert_symplectic",
    "assert_volume_preserving",
]

Array = np.ndarray


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
    with _failing(map):
        report = audit(map, dimension=dimension, scale=scale, **options)
    if report.verdict != "supported":
        valence = "" if scale == 1 else f" with valence {float(scale):g}"
        reasons = "; ".join(report.failures + report.doubts)
        raise AssertionError(f"{name_of(map)} is not {what}{valence}: {reasons}\n{report}")
    return report


def assert_volume_preserving(map: Any, *, dimension: int | None = None, **options: Any) -> AuditReport:  # noqa: A002
    """|det M| = 1 at every sample (Liouville). **Returns** the audit's report."""
    with _failing(map):
        report = audit(map, dimension=dimension, **options)
    found = report.volume
    if not found.typical_bound < abs(report.scale) ** (report.dimension // 2):
        raise AssertionError(
            f"{name_of(map)}: volume could not be audited: at half of the points |det M| is known to "
            f"± {found.typical_bound:.2g} only"
        )
    if found.exceeds:
        raise AssertionError(
            f"{name_of(map)} does not preserve volume: |det M| is off by {found.size:.3g}, bound {found.bound:.2g}, "
            f"at {report.at(found)}"
        )
    if report.doubts:
        raise AssertionError(f"{name_of(map)}: volume could not be audited: {'; '.join(report.doubts)}")
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
    from canon.numeric.points import DEFAULT, MOST_POINTS, points_of
    from canon.numeric.reversal import momentum_reversal, reversal_residuals
    from canon.numeric.worst import Tally

    names = variables(dimension)
    samples = whole_number(samples, "samples", 1, MOST_POINTS)
    if involution is not None:
        function(involution, "an involution of points (N, 2n)", "involution")
    where = points_of(domain, names, [DEFAULT] * dimension)
    points = np.concatenate(list(where.blocks(samples, samples, seed)))
    with _failing(map):
        mapped = differentiable(map, points, where.lengths)
    if not mapped.steady:
        raise AssertionError(f"{name_of(map)} depends on hidden state: two evaluations at the same point differ")
    residuals = reversal_residuals(mapped, points, involution or momentum_reversal)
    missing = ~np.isfinite(residuals.sizes).all(axis=1)
    if missing.any():
        raise AssertionError(
            f"{name_of(map)} has no finite value at {missing.sum()} of {len(points)} points or their images, "
            f"for instance from {place_of(names, points[missing][0])}"
        )
    tally = Tally("reversal")
    tally.add(residuals, points)
    found = tally.defect()
    if found.exceeds:
        variable = names[tally.index[0]]
        raise AssertionError(
            f"{name_of(map)} is not reversible: {variable} comes back off by {found.size:.3g}, "
            f"bound {found.bound:.2g}, from {place_of(names, found.point)}"
        )


@contextmanager
def _failing(map: Any) -> Iterator[None]:  # noqa: A002
    """A map that has no value anywhere fails the test: nothing is wrong with what the assertion was given."""
    try:
        yield
    except NoValue as reason:
        raise AssertionError(f"{name_of(map)}: {reason.message}") from reason


def name_of(map: Any) -> str:  # noqa: A002
    """What a failure calls the map."""
    return getattr(map, "__name__", type(map).__name__)


def place_of(names: Sequence[str], point: Sequence[float] | Array) -> str:
    """A phase point in words."""
    return ", ".join(f"{name} = {x:.6g}" for name, x in zip(names, point, strict=True))
