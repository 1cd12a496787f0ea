"""Any map of phase space as something with derivatives: a Jacobian at each point, and how far its entries may be off.

A map that jax can trace has forward-mode derivatives, and a running bound on their rounding. What only numpy can
evaluate, or jax without derivatives (a `custom_vjp`, a call to Python), has complex-step derivatives where the function
continues analytically, and extrapolated central differences elsewhere; their errors are estimates, and are called so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final, Literal

import numpy as np

from canon.errors import NoValue
from canon.numeric.compiled_jacobian import LARGEST_TAKEN_APART, compiled_jacobian
from canon.numeric.differences import central_differences, complex_step, misfits, neighbours
from canon.numeric.emit import run
from canon.numeric.map_shape import MOST_TRIALS, TRIALS, PointMap, point_map, shown
from canon.numeric.noise import noise_of
from canon.numeric.precision import UNIT
from canon.numeric.running_bound import run_bounded
from canon.numeric.scalar_program import Unscalar, values_and_jacobian
from canon.numeric.traced import Source, Traced, traced
from canon.program import Program

Method = Literal["forward-mode AD", "complex step", "central differences"]
Array = np.ndarray
Linearise = Callable[[Array], tuple[Array, Array]]

TRIAL_POINTS: Final = 3
CLOSE: Final = 1e-9
"""The part of M by which complex steps may miss differences where it is asked whether a map continues analytically."""

SHORTER: Final = (1e-3, 2e-5)
"""First steps of differences, as parts of the lengths, where the usual ones are too long for the map."""

USELESS: Final = 1e-2
"""A bound that is this part of the derivatives leaves two digits: an estimate tells more."""


@dataclass(frozen=True)
class Differentiable:
    """A map z -> Z of points (q_1…q_n, p_1…p_n) with its Jacobian M = dZ/dz.

    `evaluate` takes points (N, 2n) to values (N, 2n); `linearise` takes them to (M, E), both (N, 2n, 2n), where E
    is for each entry of M a bound (`errors` = "bound") or an estimate ("estimate") of its error. `steady` is False
    where two evaluations at one point differed; `unit` is the unit roundoff of the least precise type that was seen,
    `noise` by how much values jump over tiny steps beyond their rounding, for which E allows;
    `program`, of values and Jacobian, where the function is a straight-line program.
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
    noise: float = 0.0
    program: Program | None = None

    @property
    def first_exception(self) -> str:
        """What the map raised first, empty if it has raised nothing."""
        return self.said()


def differentiable(
    function: Callable[..., Any], points: Array, lengths: Array, *, rounded_numbers: bool = False
) -> Differentiable:
    """The map that a Python function stands for, with derivatives.

    **Arguments:** `function`, of z (2n,), of a pair (q, p), or of points (…, 2n); `points` (N, 2n) at which it is
    tried; `lengths` (2n,), over which each variable ranges: central differences take steps of a fraction of it;
    `rounded_numbers`, whether the function's numbers are rounded from exact ones, as those of formulas are.

    **Raises:** `InputError` where the function raises at every point tried, or returns a wrong shape or complex
    numbers.
    """
    program = traced(function, points.shape[1]) if callable(function) else None
    if program is not None and program.has_derivatives(points.shape[1]):
        return _of_jax(program, points, rounded_numbers)
    if program is not None:
        import jax

        function = jax.jit(function)
    mapped = point_map(function, points)
    unit = mapped.unit
    trial = points[mapped.usable[:TRIAL_POINTS]]
    noise = noise_of(mapped.evaluate, trial, lengths, unit) if mapped.steady else np.zeros(points.shape[1])
    common: dict[str, Any] = {
        "dimension": points.shape[1],
        "kind": "numpy" if program is None else "jax",
        "errors": "estimate",
        "evaluate": mapped.evaluate,
        "unit": unit,
        "form": mapped.form,
        "steady": mapped.steady and (program is None or program.steady),
        "said": mapped.said,
        "noise": float(noise.max()),
    }
    if unit == UNIT and _continues(mapped, trial, lengths, noise):
        return Differentiable(method="complex step", linearise=_stepped(mapped, lengths, noise), **common)
    return Differentiable(
        method="central differences",
        linearise=_differenced(mapped, lengths, unit, noise),
        **common,
    )


def _stepped(mapped: PointMap, lengths: Array, noise: Array) -> Linearise:
    """M by complex steps, where the map has a finite real value, nan elsewhere.

    Whether it continues analytically is asked at every point: where complex steps don't fit the values, as where |p|
    comes in beyond some p, differences take their place.
    """
    stepping = neighbours(lambda z, stretch: complex_step(mapped, z, lengths, stretch), UNIT)
    differences = _differenced(mapped, lengths, UNIT, noise)

    def linearised(points: Array) -> tuple[Array, Array]:
        M = np.full((*points.shape, points.shape[1]), np.nan)
        E = M.copy()
        real = np.asarray(np.isfinite(mapped.evaluate(points)).all(axis=1))
        if not real.any():
            return M, E
        M[real], E[real] = stepping(points[real])
        bad = real & ~np.asarray(np.isfinite(M).all(axis=(1, 2)))
        bad[real] |= misfits(mapped.evaluate, points[real], M[real], E[real], lengths, UNIT, noise)
        if bad.any():
            M[bad], E[bad] = differences(points[bad])
        return M, E

    return linearised


def _continues(mapped: PointMap, points: Array, lengths: Array, noise: Array) -> bool:
    """Whether complex steps are the map's derivatives at these points: it continues analytically, as far as seen."""
    M = complex_step(mapped, points, lengths)
    if not np.isfinite(M).all():
        return False
    return not misfits(mapped.evaluate, points, M, np.abs(M) * CLOSE, lengths, UNIT, noise).any()


def _differenced(mapped: PointMap, lengths: Array, unit: float, noise: Array) -> Linearise:
    """M by differences; at points where the map folds within their steps, by shorter ones, else M isn't known."""

    def linearised(points: Array) -> tuple[Array, Array]:
        M, E = central_differences(mapped.evaluate, points, lengths, unit, noise=noise)
        left = np.arange(len(points))
        for first in (*SHORTER, 0.0):
            bad = misfits(mapped.evaluate, points[left], M[left], E[left], lengths, unit, noise)
            left = left[bad]
            if not len(left):
                break
            if first:
                M[left], E[left] = central_differences(
                    mapped.evaluate, points[left], lengths, unit, noise=noise, first=first
                )
        E[left] = np.inf
        return M, E

    return linearised


def _of_jax(traced: Traced, points: Array, rounded_numbers: bool) -> Differentiable:
    """The map with jax's derivatives."""
    size = points.shape[1]
    unit = traced.unit
    try:
        if unit > UNIT or size > LARGEST_TAKEN_APART:
            raise Unscalar("too large, or float32")
        program = _taken_apart(traced.source, size) if traced.source else values_and_jacobian(traced.one, size)
        evaluate, linearise, bounded = _run_directly(program, rounded_numbers)
    except Unscalar:
        program = None
        evaluate, linearise, bounded = compiled_jacobian(traced.one, size, unit)
    if bounded and _says_nothing(linearise, points[:TRIAL_POINTS]):
        program = None
        evaluate, linearise, bounded = compiled_jacobian(traced.one, size, unit, bounds=False)
    tries = (points[:TRIALS], points[:MOST_TRIALS])
    if not any(np.isfinite(evaluate(trial)).all(axis=1).any() for trial in tries):
        raise NoValue(f"the map has no finite value at any of {len(tries[1])} points tried, as at {shown(points[0])}")
    return Differentiable(
        dimension=size,
        kind="jax",
        method="forward-mode AD",
        errors="bound" if bounded else "estimate",
        evaluate=evaluate,
        linearise=linearise,
        unit=unit,
        form=traced.form,
        steady=traced.steady,
        said=lambda: "",
        program=program,
    )


@lru_cache(maxsize=64)
def _taken_apart(source: Source, size: int) -> Program:
    """Values and Jacobian of a program: taking it apart costs more than running it at a thousand points."""
    return values_and_jacobian(source.one, size)


def _run_directly(program: Program, rounded_numbers: bool) -> tuple[Callable[[Array], Array], Linearise, bool]:
    """Values and Jacobian of a straight-line program, run by numpy: nothing is compiled."""
    size = program.inputs
    values = program.select(program.outputs[:size])

    def evaluate(z: Array) -> Array:
        with np.errstate(all="ignore"):
            return np.stack([np.broadcast_to(row, len(z)) for row in run(values, list(z.T))], axis=1)

    def linearise(z: Array) -> tuple[Array, Array]:
        with np.errstate(all="ignore"):
            pairs = run_bounded(program, list(z.T), rounded_numbers=rounded_numbers)[size:]
        M, E = (np.stack([np.broadcast_to(pair[k], len(z)) for pair in pairs], axis=1) for k in (0, 1))
        return M.reshape(-1, size, size), E.reshape(-1, size, size)

    return evaluate, linearise, True


def _says_nothing(linearise: Linearise, points: Array) -> bool:
    """Whether a bound is larger than the derivatives wherever these are finite: over thousands of steps it grows as if
    every rounding had pushed the same way.
    """
    M, E = linearise(points)
    finite = np.isfinite(M).all(axis=(1, 2))
    with np.errstate(all="ignore"):
        useful = E.max(axis=(1, 2)) < USELESS * np.abs(M).max(axis=(1, 2))
    return bool(finite.any() and not (finite & useful).any())
