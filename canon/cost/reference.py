"""The end of a scene's orbit by something that shares nothing with what is measured, and how far it may be off."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import sympy as sp

from canon.cost.taylor import reference
from canon.errors import BudgetExceeded, InputError
from canon.numeric.adaptive import integrate_adaptively
from canon.numeric.gradient import gradient
from canon.numeric.integrate import integrate
from canon.numeric.integrators import catalogue
from canon.numeric.integrators.constrained import Held
from canon.numeric.integrators.problem import Field, Splitting
from canon.numeric.pair_sum import PairSum
from canon.scenes.model import Model
from canon.scenes.problem import problem_of
from canon.scenes.scene import Scene

DOUBLE: Final = 2.0**-52
TOLERANCE: Final = 1e-14
FINE_STEPS: Final = (20_000, 40_000)
FINEST: Final = "suzuki_umeno8"
"""Of order 8, and none of those that `canon cost simulate` compares by itself or a planner chooses."""
ROUNDING: Final = 1e-7
"""Differences below this that no longer fall are rounding."""
DOUBLINGS: Final = tuple(4_000 * 2**k for k in range(9))


@dataclass(frozen=True)
class Reference:
    """The end state (q, p), `off` by about so much relative to its largest components, and `source`, in words."""

    q: np.ndarray
    p: np.ndarray
    off: float
    source: str


def reference_of(scene: Scene, *, seconds: float, compared: Sequence[str] = ()) -> Reference:
    """The end of the scene's orbit: by Taylor series of 34 digits; where these do not reach, by the closed form; else
    in double precision by a method that isn't compared, its error estimated by a second run.

    **Arguments:** `seconds`, which the series may take; `compared`, methods that it must not be one of.

    **Raises:** `InputError` where nothing gets to the end.
    """
    model, settings = scene.model, scene.settings
    span = (settings.start, settings.start + settings.duration)
    if ordinary(model):
        try:
            rates = equations(model)
            end, off = reference(
                rates, (*model.q, *model.p), model.t, (*scene.q, *scene.p), span, seconds=seconds
            )  # fmt: skip
            source = "Taylor series with 34 digits a step, beside 26"
            return Reference(end[: model.n], end[model.n :], max(off, DOUBLE), source)
        except (BudgetExceeded, InputError, ZeroDivisionError, OverflowError):
            pass
    exact = problem_of(model)
    if exact.exact:
        run = integrate(
            exact.value, catalogue.method("verlet"), (np.array(scene.q), np.array(scene.p)),
            duration=settings.duration, steps=1, t0=settings.start,
        )  # fmt: skip
        q, p = (np.asarray(slot) for slot in run.state)
        return Reference(q, p, 16 * DOUBLE, f"{exact.kind}, in double precision")
    return _by_another_method(scene, seconds, FINEST not in compared)


def ordinary(model: Model) -> bool:
    """Whether the motion is Hamilton's equations in q and p, and friction: nothing rigid, held or gliding."""
    return not (model.rigid or model.constraints or model.gliders or model.brackets)


def equations(model: Model) -> list[sp.Expr]:
    """q̇ and ṗ (2n,) as formulas, sums over pairs written out."""
    H = model.H.replace(lambda x: isinstance(x, PairSum), lambda x: x.written_out())
    forces = [sp.Add(*column) for column in zip(*(f.force for f in model.frictions), strict=True)]
    velocities, slopes = gradient(H, model.p), gradient(H, model.q)
    forces = forces or [sp.S.Zero] * model.n
    return [*velocities, *(force - slope for slope, force in zip(slopes, forces, strict=True))]


def _by_another_method(scene: Scene, seconds: float, splits: bool) -> Reference:
    """Two runs in double precision, the second finer, and their difference."""
    settings = scene.settings
    value = problem_of(scene.model, exact=False).value
    state = (np.array(scene.q), np.array(scene.p))
    times = [settings.start, settings.start + settings.duration]
    ends: list[tuple[np.ndarray, np.ndarray]] = []
    if splits and isinstance(value, Splitting):
        return _by_fine_splitting(scene, value, state, seconds)
    if isinstance(value, (Splitting, Field)):
        source = f"DOP853 at {TOLERANCE:g}, in double precision"
        for relative in (10 * TOLERANCE, TOLERANCE):
            run = integrate_adaptively(value, state, times, relative=relative, absolute=relative)
            ends.append((np.asarray(run.states[0])[-1], np.asarray(run.states[1])[-1]))
    else:
        assert isinstance(value, Held)
        source = f"rattle_8 with {FINE_STEPS[1]} steps, in double precision"
        for steps in FINE_STEPS:
            run = integrate(
                value, catalogue.method("rattle_8"), state, duration=settings.duration, steps=steps,
                t0=settings.start, compensated=True,
            )  # fmt: skip
            ends.append((np.asarray(run.state[0]), np.asarray(run.state[1])))
    return _of_two(ends, state, source)


def _by_fine_splitting(
    scene: Scene, value: Splitting, state: tuple[np.ndarray, np.ndarray], seconds: float
) -> Reference:
    """Runs of a splitting of order 8 whose additions keep what they round, until two of them differ no less than those
    before. An adaptive method loses four digits more over a hundred periods, in the phase.
    """
    settings, best, begun = scene.settings, np.inf, time.monotonic()
    ends: list[tuple[np.ndarray, np.ndarray]] = []
    for steps in DOUBLINGS:
        run = integrate(
            value, catalogue.method(FINEST), state, duration=settings.duration, steps=steps, t0=settings.start,
            compensated=True,
        )  # fmt: skip
        new = (np.asarray(run.state[0]), np.asarray(run.state[1]))
        if run.completed < run.samples:
            continue
        off = distance(ends[-1], new, state) if ends else np.inf
        if off >= best and best < ROUNDING:
            break
        ends, best = [*ends[-1:], new], off
        if len(ends) == 2 and time.monotonic() - begun > seconds:
            break
    return _of_two(ends, state, f"{FINEST}, its rounding kept, in double precision")


def _of_two(ends: list[tuple[np.ndarray, np.ndarray]], state: tuple[np.ndarray, np.ndarray], source: str) -> Reference:
    off = distance(ends[0], ends[1], state) if len(ends) == 2 else np.inf
    if not np.isfinite(off):
        raise InputError("no reference gets to the end of this scene: does the orbit run into a singularity?")
    return Reference(*ends[1], max(off, DOUBLE), source)


def distance(
    found: tuple[np.ndarray, np.ndarray], exact: tuple[np.ndarray, np.ndarray], start: tuple[np.ndarray, np.ndarray]
) -> float:
    """The largest difference of two end states, each slot in units of its largest component, at the end or before."""
    worst = 0.0
    for a, b, c in zip(found, exact, start, strict=True):
        size = max(float(np.abs(b).max(initial=0.0)), float(np.abs(c).max(initial=0.0)))
        off = float(np.abs(a - b).max(initial=0.0))
        worst = max(worst, off / size if size > 0 else off)
        if not np.isfinite(off):
            return float("inf")
    return worst
