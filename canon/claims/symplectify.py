"""The symplectic map or matrix near one that is not quite symplectic: a truncated series, a fit, a tracked map."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, overload

import numpy as np

from canon.claims.audit import audit, variables
from canon.claims.audit_subject import AuditSubject, checked_parameters, formulas_as_map
from canon.claims.repair_report import MapRepair, MatrixRepair
from canon.errors import InputError
from canon.expected import listed, real_array, whole_number
from canon.numeric.change import order_of_change
from canon.numeric.differentiable import differentiable
from canon.numeric.mixed_variables import Conditioned, Pattern, best_conditioned, condition_of
from canon.numeric.points import DEFAULT, MOST_POINTS, Points, points_of
from canon.numeric.precision import UNIT
from canon.numeric.repaired_map import NearbyMap, RepairedMap, nearby, quadrature
from canon.numeric.symplectic_matrix import nearest, symplectic_defect

if TYPE_CHECKING:
    from canon.mechanics.phase_space import PhaseSpace
    from canon.mechanics.transformation import Transformation

__all__ = ["MapRepair", "MatrixRepair", "symplectify"]

Array = np.ndarray
NODES: Final = (4, 8, 16, 32, 64)
TRIED: Final = 16
RESOLVED: Final = 64.0
AUDITED: Final = 50
AUDITED_BLACK_BOX: Final = 4
"""At so few points a map is audited after its repair if each of its Jacobians costs dozens of evaluations."""

CONDITIONED: Final = 1e8
"""Beyond this condition half of the digits would be lost."""


@overload
def symplectify(map: Array | Sequence[Sequence[float]], *, method: str = "nearest") -> MatrixRepair: ...


@overload
def symplectify(
    map: Transformation | Callable[..., Any],
    *,
    dimension: int | None = None,
    space: PhaseSpace | None = None,
    domain: Any = None,
    samples: int = 200,
    seed: int = 0,
    parameters: Mapping[str, float] | None = None,
    centre: Sequence[float] | None = None,
    type: int | Sequence[int] | None = None,
) -> MapRepair: ...


def symplectify(
    map: Any,
    *,
    method: str = "nearest",
    dimension: int | None = None,
    space: PhaseSpace | None = None,
    domain: Any = None,
    samples: int = 200,
    seed: int = 0,
    parameters: Mapping[str, float] | None = None,
    centre: Sequence[float] | None = None,
    type: int | Sequence[int] | None = None,
) -> MapRepair | MatrixRepair:
    """The symplectic map near a map, or the symplectic matrix near a matrix, and how far it had to move.

    A matrix goes through Cayley's transform, or becomes the symplectic factor of its generalised polar decomposition:
    the `nearest` of the two, or the one that `method` names ("cayley", "polar").

    A map gets a generating function: in mixed variables u its other variables θ(u) would be ∂F/∂u if it were
    symplectic; F is made of θ by integration along rays from the `centre`, and generates the map that is returned. It
    is symplectic to rounding, agrees with the map at the centre, and is the map itself where that is symplectic; of a
    series truncated after order k it changes order k + 1 first. Among the types 1 to 4 in each degree of freedom the
    one is taken that is best conditioned at the sample points (of all 4ⁿ, up to 5 degrees of freedom), unless `type` is
    given.

    **Arguments:** `map`, a matrix (2n, 2n), a `Transformation` given by formulas, or a function as for `audit`;
    `dimension`, `space`, `domain`, `samples`, `seed` and `parameters` as for `audit`; `centre`, a phase point (2n,), by
    default the middle of the domain.

    **Returns:** a `MatrixRepair` or a `MapRepair`, which can be called as the map.

    **Raises:** `InputError` where there is no symplectic matrix near, or every type meets a caustic in the domain.
    """
    from canon.mechanics.transformation import Transformation

    if _is_matrix(map):
        return _repaired_matrix(_matrix(map), method)
    if not isinstance(method, str) or method != "nearest":
        raise InputError("a method is for a matrix; for a map there is `type`", "method")
    if isinstance(map, Transformation):
        subject = formulas_as_map(map, checked_parameters(parameters), 1.0)
        names: Sequence[str] = subject.names
    else:
        names = variables(dimension, space)
        subject = AuditSubject(map, names, [DEFAULT] * len(names), 1.0)
    where = points_of(domain, names, subject.defaults)
    points = _samples(subject, where, samples, seed)
    lengths = where.lengths
    mapped = differentiable(subject.function, points, lengths, rounded_numbers=subject.rounded_numbers)
    if not mapped.steady:
        raise InputError(
            "two evaluations at the same point differ: a map with hidden state has no symplectic neighbour"
        )
    if mapped.unit > UNIT:
        raise InputError("the map computes in float32, too coarse for its equations to be solved: give one in float64")
    near = nearby(mapped.evaluate, lambda z: mapped.linearise(z)[0], padded=mapped.kind == "jax")
    start = _centre(centre, where, near)
    usable, jacobians = _regular(points, near, lengths)
    if np.all(np.linalg.det(jacobians) < 0):
        raise InputError(
            "no symplectic map is near this one: its determinant is negative at every sample, theirs is 1", "map"
        )
    chosen = _chosen(type, jacobians, len(names) // 2)
    repaired, notes = _resolved(near, Pattern(chosen.types), start, usable, lengths)
    images = repaired(points)
    shifts = images - near.values(points)
    if not np.isfinite(shifts).all(axis=1).any():
        raise InputError(
            "the repaired map's equations have no solution at any sample: choose a smaller domain, or another centre"
        )
    lost = int((~np.isfinite(repaired(usable)).all(axis=1)).sum()) if np.isnan(shifts).any() else 0
    if lost:
        notes.append(f"no value at {lost} of {len(usable)} points: their rays from the centre meet a caustic")
    if len(usable) < len(points):
        notes.append(f"the map itself is not differentiable at {len(points) - len(usable)} of {len(points)} points")
    differences = mapped.method == "central differences"
    if differences:
        notes.append("the map's derivatives are differences: what is made of them is symplectic to their error")
    change = order_of_change(near.values, repaired, start, usable, lengths)
    audited = usable[: AUDITED_BLACK_BOX if differences else AUDITED]
    options: dict[str, Any] = {"domain": audited, "space": space, "dimension": len(names)}
    return MapRepair(
        map=repaired,
        types=chosen.types,
        compared=chosen.compared,
        condition=chosen.condition,
        before=audit(subject.function, **options),
        after=audit(repaired, **options),
        points=points,
        shifts=shifts,
        lengths=lengths,
        centre=tuple(float(x) for x in start),
        order=change.order,
        slope=change.slope,
        nodes=len(repaired.nodes),
        notes=tuple(notes),
    )


def _is_matrix(map: Any) -> bool:  # noqa: A002
    return isinstance(map, (np.ndarray, list, tuple)) or (hasattr(map, "tolist") and hasattr(map, "shape"))


def _matrix(map: Any) -> Array:  # noqa: A002
    M = np.array(real_array(map.tolist() if hasattr(map, "tolist") else map, "map"))
    if M.ndim != 2 or M.shape[0] != M.shape[1] or M.shape[0] % 2 or not M.size:
        raise InputError(f"a matrix (2n, 2n) is expected, not of shape {M.shape}", "map")
    if not np.all(np.isfinite(M)):
        raise InputError("the matrix has entries that are not finite", "map")
    return M


def _repaired_matrix(M: Array, method: str) -> MatrixRepair:
    best, found = nearest(M, method)
    size, bound = symplectic_defect(best.matrix)
    return MatrixRepair(
        matrix=best.matrix,
        method=best.method,
        distance=best.distance,
        distances={candidate.method: candidate.distance for candidate in found},
        defect_before=symplectic_defect(M)[0],
        defect=size,
        bound=bound,
    )


def _samples(subject: AuditSubject, where: Points, samples: int, seed: int) -> Array:
    samples = whole_number(samples, "samples", 1, MOST_POINTS)
    points = np.concatenate(list(where.blocks(samples, max(samples, 1), seed)))
    inside = points[subject.inside(points)]
    if not len(inside):
        raise InputError(f"none of {len(points)} points lies in the domain of the formulas", "domain")
    return inside


def _centre(centre: Sequence[float] | None, where: Points, near: NearbyMap) -> Array:
    start = (where.low + where.high) / 2 if centre is None else real_array(centre, "centre")
    if start.shape != where.low.shape or not np.all(np.isfinite(start)):
        raise InputError(f"a phase point of shape {where.low.shape} is expected", "centre")
    if not np.all(np.isfinite(near.values(start[None, :]))) or not np.all(np.isfinite(near.jacobians(start[None, :]))):
        raise InputError("the map or its derivatives have no finite value there: give another one", "centre")
    return start


def _regular(points: Array, near: NearbyMap, lengths: Array) -> tuple[Array, Array]:
    """The points at which the map is differentiable, and its Jacobians there in units of the lengths."""
    M = near.jacobians(points)
    finite = np.isfinite(M).all(axis=(1, 2)) & np.isfinite(near.values(points)).all(axis=1)
    if not finite.any():
        raise InputError("the map is differentiable at none of the sample points", "domain")
    return points[finite], M[finite] * lengths / lengths[:, None]


def _chosen(type: int | Sequence[int] | None, M: Array, n: int) -> Conditioned:  # noqa: A002
    if type is None:
        chosen = best_conditioned(M)
    else:
        types = (type,) * n if isinstance(type, int) else listed(type, "types", "type")
        for each in types:
            whole_number(each, "type")
        if len(types) != n or not {*types} <= {1, 2, 3, 4}:
            raise InputError(f"a type is 1, 2, 3 or 4, or one of these for each of {n} degrees of freedom", "type")
        chosen = Conditioned(types, condition_of(types, M), 0)
    if chosen.condition > CONDITIONED:
        what = "every type of generating function" if type is None else f"type {type}"
        raise InputError(
            f"{what} meets a caustic among the sample points (condition {chosen.condition:.2g}): "
            "choose a smaller domain" + ("" if type is None else ", or leave the type to the choice")
        )
    return chosen


def _resolved(
    near: NearbyMap, pattern: Pattern, centre: Array, points: Array, lengths: Array
) -> tuple[RepairedMap, list[str]]:
    """The repaired map with nodes enough that more of them change nothing."""
    tried = points[:TRIED]
    repaired = RepairedMap(near, pattern, centre, *quadrature(NODES[0]), lengths)
    images = repaired(tried)
    for count in NODES[1:]:
        before = images
        repaired = RepairedMap(near, pattern, centre, *quadrature(count), lengths)
        images = repaired(tried)
        change = np.abs(images - before) / lengths
        scale = 1 + np.nanmax(np.abs(images) / lengths, initial=0.0)
        if not np.nanmax(change, initial=0.0) > RESOLVED * UNIT * scale:
            return repaired, []
    return repaired, [
        f"{NODES[-1]} nodes don't resolve the map on the rays from the centre: it may have moved more than it had to"
    ]
