"""Any map of phase space as something with derivatives: a Jacobian at each point, and how far its entries may be off.

A map that jax can trace has forward-mode derivatives, and a running bound on their rounding. What only numpy can
evaluate has complex-step derivatives where the function continues analytically, and extrapolated central differences
elsewhere; their errors are estimates, and are called so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np

from canon.errors import InputError
from canon.numeric.differences import central_differences, complex_step, neighbours
from canon.numeric.map_shape import PointMap, point_map
from canon.numeric.precision import UNIT, UNIT_32, double
from canon.numeric.rounding import Unbounded, with_rounding

Method = Literal["forward-mode AD", "complex step", "central differences"]
Array = np.ndarray
Linearise = Callable[[Array], tuple[Array, Array]]

TRIAL_POINTS: Final = 3


@dataclass(frozen=True)
class Differentiable:
    """A map z -> Z of points (q_1…q_n, p_1…p_n) with its Jacobian M = dZ/dz.

    `evaluate` takes points (N, 2n) to values (N, 2n); `linearise` takes them to (M, E), both (N, 2n, 2n), where E
    is for each entry of M a bound (`errors` = "bound") or an estimate ("estimate") of its error. `steady` is False
    where two evaluations at one point differed; `unit` is the unit roundoff of the least precise type that was seen.
    """

    dimension: int
    kind: Literal["jax", "numpy"]
    method: Method
    errors: Literal["bound", "estimate"]
    evaluate: Callable[[Array], Array]
    linearise: Linearise
    unit: float
    form: str
    steady: bool
    said: Callable[[], str]

    @property
    def first_exception(self) -> str:
        """What the map raised first, empty if it has raised nothing."""
        return self.said()


def differentiable(function: Callable[..., Any], points: Array, lengths: Array) -> Differentiable:
    """The map that a Python function stands for, with derivatives.

    **Arguments:** `function`, of z (2n,), of a pair (q, p), or of points (…, 2n); `points` (N, 2n) at which it is
    tried; `lengths` (2n,), over which each variable ranges: central differences take steps of a fraction of it.

    **Raises:** `InputError` where the function raises at every point tried, or returns a wrong shape or complex
    numbers.
    """
    mapped = point_map(function, points)
    traced = _traced(mapped, points)
    if traced is not None:
        return traced
    unit = UNIT_32 if mapped.single else UNIT
    trial = points[mapped.usable[:TRIAL_POINTS]]
    M, E = central_differences(mapped.evaluate, trial, lengths, unit)
    common: dict[str, Any] = {
        "dimension": points.shape[1],
        "kind": "numpy",
        "errors": "estimate",
        "evaluate": mapped.evaluate,
        "unit": unit,
        "form": mapped.form,
        "steady": mapped.steady,
        "said": mapped.said,
    }
    stepped = complex_step(mapped, trial)
    if not mapped.single and np.all(np.abs(stepped - M) <= 4 * E + 1e-9 * np.abs(M)):
        return Differentiable(
            method="complex step",
            linearise=neighbours(lambda z: complex_step(mapped, z), unit),
            **common,
        )
    return Differentiable(
        method="central differences",
        linearise=lambda z: central_differences(mapped.evaluate, z, lengths, unit),
        **common,
    )


def _traced(mapped: PointMap, points: Array) -> Differentiable | None:
    """The map with jax's derivatives; None where jax cannot trace the function."""
    import jax
    import jax.numpy as jnp

    size = points.shape[1]
    with double():
        example = jnp.zeros(size)
        try:
            shape = jax.eval_shape(mapped.one, example)
        except Exception:  # a function of numpy may raise anything when it is given a tracer
            return None
        if shape.shape != (size,):
            return None
        if np.issubdtype(shape.dtype, np.complexfloating):
            raise InputError("the map returns complex numbers: an audit is of a real map")
        single = "f32[" in str(jax.make_jaxpr(mapped.one)(example))
        jacobian = jax.jacfwd(mapped.one)
        try:
            program, bounded = with_rounding(jacobian, example), True
        except Unbounded:
            program, bounded = jacobian, False
        compiled: Any = jax.jit(jax.vmap(program))
        values = jax.jit(jax.vmap(mapped.one))

    def evaluate(z: Array) -> Array:
        with double():
            return np.asarray(values(z), dtype=float)

    def linearise(z: Array) -> tuple[Array, Array]:
        with double():
            M, E = compiled(z)
            return np.asarray(M, dtype=float), np.asarray(E, dtype=float)

    def differentiated(z: Array) -> Array:
        with double():
            return np.asarray(compiled(z), dtype=float)

    unit = UNIT_32 if single else UNIT
    return Differentiable(
        dimension=size,
        kind="jax",
        method="forward-mode AD",
        errors="bound" if bounded else "estimate",
        evaluate=evaluate,
        linearise=linearise if bounded else neighbours(differentiated, unit),
        unit=unit,
        form=mapped.form,
        steady=mapped.steady,
        said=mapped.said,
    )
