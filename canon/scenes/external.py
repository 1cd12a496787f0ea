"""A scene run by heyoka, another package's Taylor method: a reference through the same interface, if it is installed.

It takes the whole of Hamilton's equations, in steps of its own. What follows neighbours of the orbit by the very steps
that made it (the tangent map, loops, the way back) is not to be had from it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.numeric.external import Grid, external_grid
from canon.numeric.hamilton_equations import hamilton_equations
from canon.numeric.integrate import Run
from canon.numeric.integrators.stepper import Stepper
from canon.numeric.integrators.traits import Traits
from canon.numeric.planner import Planned
from canon.numeric.run_difference import agreement, distance
from canon.scenes.methods import Choice
from canon.scenes.problem import Problem
from canon.scenes.scene import Scene
from canon.scenes.values import text_of

NAME: Final = "heyoka"
SOURCE: Final = "Biscani and Izzo (2021), Mon. Not. R. Astron. Soc. 504, 2614"
LOOSER: Final = 2.0**-42
"""The tolerance of the run by which the error is estimated, beside 2^−52 of the one that is shown."""
WHY: Final = "asked for: an external reference, with Taylor polynomials in steps of its own"


@dataclass(frozen=True)
class External:
    """heyoka's method, as far as it can be named: it has no step of a given length."""

    traits: Traits
    name: str = NAME
    source: str = SOURCE

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """**Raises:** `InputError`: heyoka chooses each step by itself."""
        raise InputError("heyoka chooses each step by itself: it has none that could be looked at, or repeated")


def run_externally(scene: Scene) -> tuple[Problem, Choice, Planned]:
    """The scene's run, to the precision of doubles; its error is estimated from a second one with a looser tolerance.

    **Raises:** `InputError` where heyoka is not installed, a step is asked for, or the state is not (q, p).
    """
    model, settings = scene.model, scene.settings
    if model.brackets or model.constraints or model.gliders:
        raise InputError(
            "heyoka runs what Hamilton's equations say in q and p: no rigid bodies, skates, rods, strings or surfaces",
            "integrator",
        )
    if settings.step is not None:
        raise InputError("heyoka chooses each step by itself: ask for an accuracy in place of a step", "integrator")
    times = settings.start + settings.duration * (np.arange(settings.samples) / max(settings.samples - 1, 1))
    force = tuple(sp.Add(*column) for column in zip(*(f.force for f in model.frictions), strict=True))
    try:
        grids = list[Grid]()
        for tolerance in (None, LOOSER):
            grids.append(
                external_grid(model.H, (model.q, model.p, model.t), scene.q, scene.p, times.tolist(), force, tolerance)
            )
            if grids[-1].interrupted:
                break
    except InputError as error:
        raise error.at("integrator") from None
    interrupted = grids[-1].interrupted
    run, other = _run(grids[0], times), _run(grids[-1], times)
    if len(grids) == 1:
        good, error = run.completed, None
    else:
        good = max(agreement(run, other), 1) if run.completed < settings.samples else run.completed
        error = distance(run, other, good) if other.completed >= good else None
    reached = not interrupted and (settings.accuracy is None or (error is not None and error <= settings.accuracy))
    traits = Traits(grids[0].order, symplectic=False, symmetric=False, volume_preserving=False)
    reason = "" if reached or interrupted else "rounding keeps it from going further"
    compiling = sum(grid.compile_seconds for grid in grids)
    planned = Planned(run, good, error, (), reached, reason, interrupted=interrupted, compile_seconds=compiling)
    equations = hamilton_equations(model.H, model.q, model.p, model.t, force)
    return Problem(equations, "not split", (("H", text_of(model.H)),)), Choice(External(traits), WHY), planned


def _run(grid: Grid, times: np.ndarray) -> Run:
    samples, good = len(times), len(grid.q)
    rows = [np.full((samples, grid.q.shape[1]), np.nan) for _ in range(2)]
    rows[0][:good], rows[1][:good] = grid.q, grid.p
    span = float(times[-1] - times[0])
    step = span / max(grid.steps, 1)
    ended = good < samples
    return Run(float(times[0]), span, step, samples, 1, 1, good - 1, False, None, (rows[0], rows[1]), ended, grid.steps)
