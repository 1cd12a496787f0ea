"""A scene run in coordinates in which a collision with its centre is no singularity: for close approaches.

Of a body that a fixed centre attracts by −k/r, with other forces or without. The steps have one length in a fictitious
time, of which a thousandth part of an orbit near the centre takes as many as any other; the states are those at the
scene's times (`canon.numeric.regularised_orbit`), and so are those of neighbours that monitors carry along.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.interruption import underway
from canon.numeric.engines import settled
from canon.numeric.hamilton_equations import hamilton_equations
from canon.numeric.integrate import Run
from canon.numeric.integrators.catalogue import method
from canon.numeric.integrators.stepper import Method, Stepper
from canon.numeric.integrators.traits import Traits
from canon.numeric.levi_civita import Regularised, regularised
from canon.numeric.planner import Planned
from canon.numeric.progress import Trial
from canon.numeric.regularised_neighbours import RegularisedNeighbours
from canon.numeric.regularised_orbit import RegularisedOrbit, reached, regularised_orbit, unbegun
from canon.numeric.run_difference import agreement, distance
from canon.numeric.step_search import KEEP_EVERY, Watch
from canon.scenes.identity import identity_of
from canon.scenes.methods import Choice
from canon.scenes.problem import Problem
from canon.scenes.regularised_progress import FINISHED, Halfway, kept, restored, resumable
from canon.scenes.saved import Arrays, engine_for
from canon.scenes.scene import Scene, Settings
from canon.scenes.values import text_of

NAME: Final = "regularised"
COARSEST: Final = 0.12
"""The first run's step, in units of its pace: twenty-six a turn."""
FEWEST: Final = 100
"""Steps of the first run, at least."""
ROUNDING: Final = 1e-7
"""Of two differences below it, a later one that is larger is rounding's."""
MOST_RUNS: Final = 14
SOURCE: Final = "Levi-Civita (1920), Acta Math. 42, 99; Kustaanheimo and Stiefel (1965), J. reine angew. Math. 218, 204"
_SPACES: Final = {1: "Levi-Civita's", 2: "Levi-Civita's", 3: "Kustaanheimo and Stiefel's"}


@dataclass(frozen=True)
class InSquares:
    """The method that makes the steps, as one for the scene's own coordinates, where it has no step of given length.

    They are of motion about a `centre`, and `step` in the fictitious time.
    """

    inner: Method
    kepler: Regularised
    centre: tuple[float, ...]
    step: float = math.nan

    @property
    def name(self) -> str:
        return f"{NAME} {self.inner.name}"

    @property
    def source(self) -> str:
        return f"{SOURCE}; {self.inner.source}"

    @property
    def traits(self) -> Traits:
        """Of the steps between given times nothing is known but their order: they are cut by the times."""
        return Traits(self.inner.traits.order, None, None, None)

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """**Raises:** `InputError`: its steps are equal in another time."""
        raise InputError("steps in a fictitious time are none of equal time, which could be looked at or repeated")

    def neighbours(self, t0: float, duration: float) -> RegularisedNeighbours:
        """What these steps do to neighbours of the orbit from t0 on."""
        return RegularisedNeighbours(self.kepler, self.inner, self.centre, self.step, t0, duration)


def run_regularised(
    scene: Scene,
    *,
    watch: Watch | None = None,
    keep: Callable[[Arrays], None] | None = None,
    resume: Arrays | None = None,
) -> tuple[Problem, Choice, Planned, Arrays]:
    """The scene's run to its accuracy, by runs with twice as many steps each; the error is the last two's difference.
    With it comes what it can be gone on with; `watch`, `keep` and `resume` are as in `canon.scenes.simulate`.

    **Raises:** `InputError` where the scene isn't one body with such a centre, a step or a budget is asked for, or what
    is to be resumed is damaged, or of another scene.
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
    named = InSquares(chosen, kepler, tuple(centre.tolist()))
    identity = identity_of(scene, named.name)
    times = settings.start + settings.duration * (np.arange(settings.samples) / max(settings.samples - 1, 1))
    engine = settled(settings.engine if resume is None else engine_for(resume, settings.engine))

    def unmoved(step: float) -> Run:
        span = float(times[-1] - times[0])
        return unbegun(kepler, chosen, begin, scene.p, span, step, engine=engine)

    if resume is None:
        pace = kepler.pace(float(kepler.state(begin, scene.p)[0][-1]), settings.duration)
        halfway = Halfway(engine, COARSEST * pace)
    else:
        halfway = restored(resume, identity, _rows(times, len(centre)), unmoved)
    first = replace(_rows(times, len(centre)), stored=tuple(np.array([x]) for x in (scene.q, scene.p)))
    pressed, due = underway(), time.monotonic() + KEEP_EVERY

    def stop(run: Run) -> bool:
        nonlocal due
        try:
            if watch is not None:
                watch(min(reached(run) / settings.duration, 1.0))
        except KeyboardInterrupt:
            return True
        if keep is not None and time.monotonic() > due:
            shown = halfway.runs[-1] if halfway.runs else first
            keep(kept(replace(halfway, current=run), shown, identity))
            due = time.monotonic() + KEEP_EVERY
        return pressed()

    partial, looked = None, 0.0
    while partial is None and not halfway.over:
        before = time.process_time()
        orbit = regularised_orbit(
            kepler, chosen, begin, scene.p, times.tolist(), step=halfway.step, engine=engine, begun=halfway.current,
            stop=stop,
        )  # fmt: skip
        run, spent = _run(orbit, times, centre, scene.q), time.process_time() - before
        looked = looked or before + spent - begun
        if orbit.interrupted:
            partial, halfway = run, replace(halfway, current=orbit.run)
        elif FEWEST * orbit.length > orbit.reach:
            # so short a way is one to the last state alone, whatever the step
            halfway = replace(halfway, step=orbit.reach / FEWEST, current=None)
        else:
            halfway = _after(halfway, run, Trial(orbit.steps, math.inf, spent), settings)
    planned = _planned(halfway, partial, settings, looked)
    if keep is not None and partial is not None:
        keep(kept(halfway, planned.run, identity))
    step = halfway.step if planned.run is partial else 2 * halfway.step
    why = f"asked for: {_SPACES[model.n]} coordinates, in which a collision with the centre is no singularity"
    choice = Choice(replace(named, step=step), why)
    return _problem(scene, kepler), choice, planned, resumable(halfway, identity)


def _after(halfway: Halfway, run: Run, trial: Trial, settings: Settings) -> Halfway:
    """One run farther: with what it says of the error, and whether another one is to be made."""
    runs, trials = halfway.runs, halfway.trials
    whole = bool(runs) and run.completed == runs[-1].completed == settings.samples
    difference = distance(run, runs[-1]) if whole else math.inf
    if len(runs) > 1 and trials[-1].difference < min(difference, ROUNDING):
        return replace(halfway, current=None, over=True)  # both are rounding's, and the run before was as good
    trials = (*trials, replace(trial, difference=difference))
    over = difference <= (settings.accuracy or 0.0) or len(trials) == MOST_RUNS
    return Halfway(halfway.engine, halfway.step / 2, (*runs[1 - FINISHED :], run), trials, None, over)


def _planned(halfway: Halfway, partial: Run | None, settings: Settings, looked: float) -> Planned:
    """What is to be told: of the last run, unless the one that was interrupted has come further."""
    runs, trials, further = halfway.runs, halfway.trials, partial
    if partial is not None and runs and partial.completed <= runs[-1].completed:
        further = None
    if further is not None:
        return Planned(further, further.completed, None, trials, False, interrupted=True, compile_seconds=looked)
    run, error = runs[-1], trials[-1].difference
    good = run.completed if run.completed == settings.samples else max(agreement(run, runs[0]), 1)
    fine = partial is None and error <= (settings.accuracy or 0.0)
    return Planned(
        run,
        good,
        error if math.isfinite(error) else None,
        trials,
        fine,
        "" if fine or partial is not None else "rounding keeps it from going further",
        interrupted=partial is not None,
        compile_seconds=looked,
    )


def _problem(scene: Scene, kepler: Regularised) -> Problem:
    model = scene.model
    return Problem(
        hamilton_equations(model.H, model.q, model.p, model.t),
        f"K = r (H − E) = T(w) + V(u), in {_SPACES[model.n]} coordinates",
        (("K", text_of(kepler.K)),),
    )


def is_regularised(scene: Scene) -> bool:
    """Whether the scene is one that `run_regularised` takes."""
    try:
        kepler, centre = _kepler(scene)
        kepler.state(np.array(scene.q) - centre, scene.p)
    except InputError:
        return False
    return True


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
    """The orbit as a run of the scene, whose steps are as long as those were on average."""
    blank, good = _rows(times, len(centre)), len(orbit.q)
    rows = tuple(x.copy() for x in blank.stored)
    rows[0][:good], rows[1][:good] = orbit.q + centre, orbit.p
    rows[0][0] = begin
    ended = good < len(times)
    mean = blank.duration / max(orbit.steps, 1)
    return replace(blank, step=mean, done=good - 1, stored=rows, ended=ended, taken=orbit.steps, engine=orbit.engine)


def _rows(times: np.ndarray, n: int) -> Run:
    """A run at these times, of which nothing is computed."""
    span, samples = float(times[-1] - times[0]), len(times)
    rows = (np.full((samples, n), np.nan), np.full((samples, n), np.nan))
    return Run(float(times[0]), span, span / max(samples - 1, 1), samples, 1, 1, 0, False, None, rows, True, 1)
