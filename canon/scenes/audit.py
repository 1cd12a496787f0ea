"""`canon.audit`: of a map, and of a scene, whose map is a step of the integrator that runs it."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from canon.claims.audit import audit as audit_map
from canon.claims.audit_report import AuditReport
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.mechanics.phase_space import PhaseSpace
    from canon.mechanics.transformation import Transformation
    from canon.scenes.scene import Scene


def audit(
    map: Transformation | Scene | str | os.PathLike[str] | Callable[..., Any],  # noqa: A002 - the field's own word
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
      complex step or by extrapolated differences. Or a scene, read or as a file's path: its map is a step of the
      integrator that runs it, of the length that the run has, from the time at which the scene begins.
    - `dimension`: 2n, for a function; or `space`, whose variables' names the report then uses.
    - `domain`: where to sample: (low, high) for all variables, one such pair for each, a table by name, or an array
      of points (N, 2n). Default: (−1, 1), and (0.1, 2) for positive variables; of a scene the states of its run.
    - `samples`, `seed`: how many random points, and which.
    - `scale`: the valence that is expected. Friction of one rate λ for all makes it exp(−2λh) in a step of length h.
    - `parameters`: values of a transformation's parameters, by name.
    - `loops`: closed loops around which ∮ p dq is compared before and after the map, as `loop_invariant` takes them.
    - `surfaces`: pairs of a surface and its `periodic`, as `surface_invariant` takes them.

    **Returns:** an `AuditReport`. Its verdict is `refuted` only for formulas, and functions that jax can trace, whose
    failure balls confirm at an exact point: a black box that fails plainly is `undecided`, with the evidence in
    `failures`.

    **Raises:** `InputError` where there is no map to audit: a wrong shape, complex values, an exception or no finite
    value at every point tried, a parameter without a value; a scene that can't be read, or whose state is not (q, p).
    """
    subject: Any = map
    if not _is_scene(subject):
        return audit_map(
            subject, dimension=dimension, space=space, domain=domain, samples=samples, seed=seed, scale=scale,
            parameters=parameters, loops=loops, surfaces=surfaces,
        )  # fmt: skip
    if parameters or dimension is not None or space is not None:
        raise InputError("a scene has its own variables and parameters: leave dimension, space and parameters out")
    step, states = step_of(subject)
    if domain is None:
        rows = np.unique(np.linspace(0, len(states) - 1, max(samples, 1)).round().astype(int))
        domain = states[rows]
    return audit_map(
        step, dimension=states.shape[1], domain=domain, samples=samples, seed=seed, scale=scale, loops=loops,
        surfaces=surfaces,
    )  # fmt: skip


def step_of(scene: Any) -> tuple[Callable[[Any, Any], tuple[Any, Any]], np.ndarray]:
    """A step of the integrator that runs a scene, as a map of (q, p), and the states (N, 2n) of that run.

    **Raises:** `InputError` where the state is not (q, p), or is held by constraints.
    """
    from canon.numeric.integrate import flow_map
    from canon.scenes.reader import read_scene
    from canon.scenes.simulate import simulate

    read = read_scene(scene) if isinstance(scene, str | os.PathLike) else scene
    if read.model.brackets:
        raise InputError(
            "the state of rigid bodies and of skates is not (q, p): the monitor 'symplecticity' has their brackets"
        )
    if read.model.constraints:
        raise InputError("the states of a scene with constraints fill no phase space: there is no step to audit")
    result = simulate(replace(read, settings=replace(read.settings, monitors=())))
    run = result.planned.run
    if len(run.states) != 2:
        raise InputError("the state of this scene is not (q, p): there is no symplectic condition to audit")
    stepped = flow_map(result.problem.value, result.choice.method, steps=1, h=run.step, t0=run.t0)
    return lambda q, p: stepped((q, p)), np.hstack([result.q, result.p])


def _is_scene(subject: Any) -> bool:
    """Whether something is a scene, or a path of one: known without loading what scenes need."""
    return isinstance(subject, str | os.PathLike) or type(subject).__module__ == "canon.scenes.scene"
