"""The audit of a map by numbers: symplectic condition, brackets, volume and invariants, each beside its rounding."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from numbers import Integral
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.claims.audit_conclusion import conclude
from canon.claims.audit_report import AuditFailed, AuditReport
from canon.claims.audit_run import AuditRun
from canon.claims.audit_subject import AuditSubject, checked_parameters, formulas_as_map
from canon.claims.implicit_map import ImplicitMap
from canon.claims.invariance import checked_valence, loop_invariant, surface_invariant
from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.numeric.points import DEFAULT, DEFAULT_POSITIVE, points_of

if TYPE_CHECKING:
    from canon.mechanics.phase_space import PhaseSpace
    from canon.mechanics.transformation import Transformation

__all__ = ["AuditFailed", "AuditReport", "audit"]

Array = np.ndarray
MOST_SAMPLES: Final = 10**9
LARGEST: Final = 100_000
"""The most dimensions of a phase space whose variables are named."""


def audit(
    map: Transformation | Callable[..., Any],  # noqa: A002 - the field's own word
    *,
    dimension: int | None = None,
    space: PhaseSpace | None = None,
    domain: Any = None,
    samples: int = 1000,
    seed: int = 0,
    scale: float = 1.0,
    parameters: Mapping[str, float] | None = None,
    loops: Sequence[Any] = (),
    surfaces: Sequence[tuple[Any, Sequence[bool]]] = (),
) -> AuditReport:
    """Numerical evidence on whether a map is symplectic: M J Mᵀ = scale J for its Jacobian M, at many points.

    **Arguments:**

    - `map`: a `Transformation`, given by formulas or by a generating function (whose equations are solved), or a Python
      function of one phase point z = (q₁…q_n, p₁…p_n) of shape (2n,), of a pair (q, p), or of points (…, 2n), which
      returns the same. A function that jax can trace has derivatives by forward-mode AD; any other has them by the
      complex step or by extrapolated differences.
    - `dimension`: 2n, for a function; or `space`, whose variables' names the report then uses.
    - `domain`: where to sample: (low, high) for all variables, one such pair for each, a table by name, or an array
      of points (N, 2n). Default: (−1, 1), and (0.1, 2) for variables assumed positive.
    - `samples`, `seed`: how many random points, and which.
    - `scale`: the valence that is expected.
    - `parameters`: values of a transformation's parameters, by name.
    - `loops`: closed loops around which ∮ p dq is compared before and after the map, as `loop_invariant` takes them.
    - `surfaces`: pairs of a surface and its `periodic`, as `surface_invariant` takes them.

    **Returns:** an `AuditReport`. Its verdict is `refuted` only for formulas, and functions that jax can trace, whose
    failure balls confirm at an exact point: a black box that fails plainly is `undecided`, with the evidence in
    `failures`.

    **Raises:** `InputError` where there is no map to audit: a wrong shape, complex values, an exception or no finite
    value at every point tried, a parameter without a value.
    """
    from canon.mechanics.transformation import Transformation

    start = time.monotonic()
    samples = whole_number(samples, "samples", 1, MOST_SAMPLES)
    checked_valence(scale)
    parameters = checked_parameters(parameters)
    for curves, name in ((loops, "loops"), (surfaces, "surfaces")):
        if not isinstance(curves, (list, tuple)):
            raise InputError(f"a list is needed, not {type(curves).__name__}", name)
    for pair in surfaces:
        if not isinstance(pair, (list, tuple)) or len(pair) != 2:
            raise InputError("each is a pair of a surface and its `periodic`, as (disc, (False, True))", "surfaces")
    if isinstance(map, Transformation) and map.direction == "implicit":
        subject = _solved_for(map, parameters, scale)
    elif isinstance(map, Transformation):
        subject = formulas_as_map(map, parameters, scale)
    else:
        if parameters:
            raise InputError("a function has its parameters already; `parameters` are for formulas", "parameters")
        names = variables(dimension, space)
        subject = AuditSubject(map, names, [DEFAULT] * len(names), scale)
    where = points_of(domain, subject.names, subject.defaults)
    run = AuditRun(subject, where, seed)
    run.audit(samples)
    report = conclude(run, samples if where.given is None else len(where.given), start)
    found = [loop_invariant(map, loop, scale=scale, parameters=parameters) for loop in loops]
    found += [
        surface_invariant(map, surface, periodic=periodic, scale=scale, parameters=parameters)
        for surface, periodic in surfaces
    ]
    return replace(report.with_integrals(found), seconds=time.monotonic() - start) if found else report


def _solved_for(transformation: Transformation, parameters: Mapping[str, float], scale: float) -> AuditSubject:
    """The map of a generating function as one of points, by Newton's method."""
    generating = transformation.generating_function
    assert generating is not None
    variables = transformation.space.old
    defaults = [DEFAULT_POSITIVE if symbol.is_positive else DEFAULT for symbol in variables]
    solved = ImplicitMap(generating, parameters)
    return AuditSubject(solved, [symbol.name for symbol in variables], defaults, scale, kind="generating function")


def variables(dimension: int | None = None, space: PhaseSpace | None = None) -> tuple[str, ...]:
    """The names of the entries of a phase point: the space's own, or q1, …, p1, … (q, p in two dimensions).

    **Raises:** `InputError` where neither gives an even dimension, or they contradict each other.
    """
    from canon.mechanics.phase_space import PhaseSpace

    if space is not None:
        instance_of(space, PhaseSpace, "space")
    size = 2 * space.n if space is not None and dimension is None else dimension
    if size is None:
        raise InputError("the dimension of phase space is needed: dimension=2n", "dimension")
    if not isinstance(size, Integral) or size < 2 or size % 2:
        raise InputError(f"a phase space has an even dimension 2n, not {size!r}", "dimension")
    if size > LARGEST:
        raise InputError(f"a map of up to {LARGEST} dimensions can be audited, not of {size}", "dimension")
    if space is not None and size != 2 * space.n:
        raise InputError(f"{size} is not the dimension {2 * space.n} of the space", "dimension")
    if space is not None:
        return tuple(symbol.name for symbol in space.old)
    size = int(size)
    return ("q", "p") if size == 2 else tuple(f"{x}{k}" for x in "qp" for k in range(1, size // 2 + 1))
