"""A scene run in coordinates in which a collision with its centre is no singularity: for close approaches.

Of a body that a fixed centre attracts by −k/r, with other forces or without. The steps have one length in a fictitious
time, of which a thousandth part of an orbit near the centre takes as many as any other; the states are those at the
scene's times (`canon.numeric.regularised_orbit`). What follows neighbours of the orbit by steps of equal time (the
tangent map, loops, the way back) is not to be had from them.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.interruption import underway
from canon.numeric.hamilton_equations import hamilton_equations
from canon.numeric.integrate import Run
from canon.numeric.integrators.catalogue import method
from canon.numeric.integrators.stepper import Method, Stepper
from canon.numeric.integrators.traits import Traits
from canon.numeric.levi_civita import Regularised, regularised
from canon.numeric.planner import Planned
from canon.numeric.progress import Trial
from canon.numeric.regularised_orbit import RegularisedOrbit, regularised_orbit
from canon.numeric.run_difference import agreement, distance
from canon.scenes.methods import Choice
from canon.scenes.problem import Problem
from canon.scenes.scene import Scene
from canon.scenes.values import text_of

NAME: Final = "regularised"
COARSEST: Final = 0.12
"""The first run's step, in units of its pace: twenty-six a turn."""
FEWEST: Final = 100
"""Steps of the first run, at least."""
ROUNDING: Final = 1e-7
"""Of two differences below it, a later one that is larger is rounding's."""
MOST_RUNS: Final = 14


@dataclass(frozen=True)
class InSquares:
    """The method that makes the steps, as one for the scene's own coordinates, where it has no step of given length."""

    inner: Method
    source: str

    @property
    def name(self) -> str:
        return f"{NAME} {self.inner.name}"

    @property
    def traits(self) -> Traits:
        """Of the steps between given times nothing is known but their order: they are cut by the times."""
        return Traits(self.inner.traits.order, None, None, None)

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """**Raises:** `InputError`: its steps are equal in another time."""
        raise InputError("steps in a fictitious time are none of equal time, which could be looked at or repeated")


def run_regularised(scene: Scene) -> tuple[Problem, Choice, Planned]:
    """The scene's run to its accuracy, by runs with twice as many steps each; the error is the last two's difference.

    **Raises:** `InputError` where the scene isn't one body with such a centre, or a step or a budget is asked for.
    """
    model, settings = scene.model, scene.settings
    if settings.accuracy is None:
        raise InputError(
            "regularised steps are of a fictitious time: ask for an accuracy, not for a step or a budget", "integrator"
        )
    begun = time.process_time()
    kepler, centre = _kepler(scene)
    begin = np.array(scene.q) - centre
    chosen = method("stormer12" if kepler.problem.nystrom else "sofroniou_spaletta10")
    times = settings.start + settings.duration * (np.arange(settings.samples) / max(settings.samples - 1, 1))
    step = COARSEST * kepler.pace(float(kepler.state(begin, scene.p)[0][-1]), settings.duration)
    runs, trials, pressed, interrupted = list[Run](), list[Trial](), underway(), False
    looked = 0.0
    while not interrupted and len(runs) < MOST_RUNS and (not trials or trials[-1].difference > settings.accuracy):
        before = time.process_time()
        orbit = regularised_orbit(
            kepler, chosen, begin, scene.p, times.tolist(), step=step, engine=settings.engine, stop=pressed
        )
        if not orbit.interrupted and FEWEST * orbit.length > orbit.reach:
            step = orbit.reach / FEWEST  # so short a way is one to the last state alone, whatever the step
            continue
        interrupted, step = orbit.interrupted, step / 2
        run, spent = _run(orbit, times, centre, scene.q), time.process_time() - before
        whole = bool(runs) and run.completed == runs[-1].completed == settings.samples
        difference = distance(run, runs[-1]) if whole else math.inf
        if len(runs) > 1 and trials[-1].difference < min(difference, ROUNDING):
            break  # both differences are rounding's, and the run before was as good
        looked = looked or before + spent - begun
        runs.append(run)
        trials.append(Trial(orbit.steps, difference, spent))
    error = trials[-1].difference
    run, before_it = runs[-1], runs[max(len(runs) - 2, 0)]
    reached = not interrupted and error <= settings.accuracy
    planned = Planned(
        run,
        run.completed if run.completed == settings.samples else max(agreement(run, before_it), 1),
        error if math.isfinite(error) else None,
        tuple(trials),
        reached,
        "" if reached or interrupted else "rounding keeps it from going further",
        interrupted=interrupted,
        compile_seconds=looked,
    )
    space = "Kustaanheimo and Stiefel's" if model.n == 3 else "Levi-Civita's"
    why = f"asked for: {space} coordinates, in which a collision with the centre is no singularity"
    problem = Problem(
        hamilton_equations(model.H, model.q, model.p, model.t),
        f"K = r (H − E) = T(w) + V(u), in {space} coordinates",
        (("K", text_of(kepler.K)),),
    )
    return problem, Choice(_named(chosen), why), planned


def is_regularised(scene: Scene) -> bool:
    """Whether the scene is one that `run_regularised` takes."""
    try:
        kepler, centre = _kepler(scene)
        kepler.state(np.array(scene.q) - centre, scene.p)
    except InputError:
        return False
    return True


def _named(chosen: Method) -> InSquares:
    source = "Levi-Civita (1920), Acta Math. 42, 99; Kustaanheimo and Stiefel (1965), J. reine angew. Math. 218, 204"
    return InSquares(chosen, f"{source}; {chosen.source}")


def _kepler(scene: Scene) -> tuple[Regularised, np.ndarray]:
    """The scene's motion about the nearest of the centres that attract, and where that is."""
    model = scene.model
    if model.brackets or model.constraints or model.gliders or model.frictions or model.beside or model.n > 3:
        raise InputError(
            "regularised steps are of one body and of forces that have a potential: no friction, no constraints",
            "integrator",
        )
    reason = InputError("regularised steps are about a centre that attracts by −k/r, and there is none")
    for centre in sorted(_centres(model.H, model.q), key=lambda c: (float(np.hypot.reduce(scene.q - c)), *c)):
        moved = model.H.xreplace({x: x + sp.Float(c, precision=53) for x, c in zip(model.q, centre, strict=True) if c})
        side = scene.q[0] - centre[0]
        try:
            return _regularised(
                moved, model.q, model.p, model.t, scene.settings.start, math.copysign(1.0, side)
            ), centre
        except InputError as error:
            reason = error
    raise reason.at("integrator")


@lru_cache(maxsize=16)
def _regularised(
    H: sp.Expr, q: tuple[sp.Symbol, ...], p: tuple[sp.Symbol, ...], t: sp.Symbol, start: float, side: float
) -> Regularised:
    """The same problem for the same Hamiltonian: then its programs are compiled once."""
    return regularised(H, q, p, t, t0=start, sign=side)


def _centres(H: Any, q: Sequence[sp.Symbol]) -> list[np.ndarray]:
    """The points c of all 1/|q − c| in a formula."""
    found = dict[tuple[float, ...], np.ndarray]()
    for power in H.atoms(sp.Pow):
        base = power.base
        if isinstance(base, sp.Abs):
            base = base.args[0] ** 2
        slopes = [sp.expand(base.diff(x)) for x in q]
        if power.exp.is_negative and all(not (slope.diff(x).free_symbols) for slope, x in zip(slopes, q, strict=True)):
            pairs = [(slope.subs(x, 0), slope.diff(x)) for slope, x in zip(slopes, q, strict=True)]
            if all(first.is_number and second.is_positive for first, second in pairs):
                centre = np.array([-float(first / second) + 0.0 for first, second in pairs])
                found[tuple(centre.tolist())] = centre
    return [*found.values()]


def _run(orbit: RegularisedOrbit, times: np.ndarray, centre: np.ndarray, begin: Sequence[float]) -> Run:
    samples, good = len(times), len(orbit.q)
    rows = [np.full((samples, orbit.q.shape[1]), np.nan) for _ in range(2)]
    rows[0][:good], rows[1][:good] = orbit.q + centre, orbit.p
    rows[0][0] = begin
    span = float(times[-1] - times[0])
    mean, stored, ended = span / max(orbit.steps, 1), (rows[0], rows[1]), good < samples
    return Run(
        float(times[0]), span, mean, samples, 1, 1, good - 1, False, None, stored, ended, orbit.steps, orbit.engine
    )
