"""Runs a scene: from its model to states, the monitors that were asked for, and what the run cost."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from typing import Final

import numpy as np

from canon.errors import InputError
from canon.numeric.attainable import attainable
from canon.numeric.engines import settled
from canon.numeric.gradient import gradient
from canon.numeric.observe import observe
from canon.numeric.operations import operations_per_step
from canon.numeric.planner import Planned, check_steps, run_for_accuracy, run_with_step
from canon.numeric.step_search import BUDGET_USED, Task
from canon.scenes.external import NAME as EXTERNAL
from canon.scenes.external import run_externally
from canon.scenes.identity import identity_of
from canon.scenes.methods import Choice, choose, chosen_for
from canon.scenes.monitors import Reading, read_monitors
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.price import price
from canon.scenes.on_surface import faults_at
from canon.scenes.problem import Problem, problem_of
from canon.scenes.regularised import NAME as REGULARISED
from canon.scenes.regularised import is_regularised, run_regularised
from canon.scenes.saved import Arrays, differing_versions, engine_for, integrator_of, restored, resumable, saved
from canon.scenes.scattering import Scattered, scattered
from canon.scenes.scene import Scene, Settings
from canon.scenes.string_events import Event, events_of

AS_A_WHOLE: Final = (EXTERNAL, REGULARISED)
"""What makes a run by steps that aren't of equal time."""

THROUGH: Final = f'; if it is a collision with the attracting centre, integrator = "{REGULARISED}" goes through it'
CLOSE: Final = f'; if close approaches to the attracting centre are to blame, integrator = "{REGULARISED}" may reach it'
HURRY: Final = 0.3
"""Seconds that monitors get after somebody has stopped the run."""

FINE: Final = 1e-10
"""Of such accuracies it is asked whether double precision can hold them at all."""


@dataclass(frozen=True)
class Result:
    """A run of a scene: the stored states q and p (samples, n) at `times`, and all that is known of them.

    `ok` says whether the accuracy was reached (where one was asked for), the whole duration was, and no monitor that
    must be conserved drifted; `messages` say what was not.
    """

    scene: Scene
    problem: Problem
    choice: Choice
    planned: Planned
    times: np.ndarray
    q: np.ndarray
    p: np.ndarray
    monitors: tuple[Reading, ...]
    operations: int | None
    seconds: tuple[float, float]
    messages: tuple[str, ...]
    ok: bool
    resumable: Arrays = field(default_factory=dict)
    scattering: dict[str, Scattered] = field(default_factory=dict)
    events: tuple[Event, ...] = ()


def simulate(
    scene: Scene,
    *,
    watch: Callable[[float], None] | None = None,
    keep: Callable[[Arrays], None] | None = None,
    resume: Arrays | None = None,
    warn: Callable[[str], None] | None = None,
) -> Result:
    """The scene's run. `watch` is told, now and then, which part of a run is done, and `keep` given the arrays with
    which it can be gone on with: given as `resume` they make a run that has every bit of one that wasn't interrupted.
    `warn` is told, before anything is run, that an accuracy cannot be had in double precision, and what can.

    **Raises:** `InputError` where the initial state is no state of the system, a method cannot solve the problem, or
    what is to be resumed is damaged or of another scene.
    """
    entered = time.monotonic()
    _check_start(scene)
    _check_constraints(scene)
    if scene.settings.step is not None:
        check_steps(scene.settings.duration, scene.settings.step)
    begun = time.process_time()
    settings = scene.settings
    if near := get_close_matches(settings.integrator or "", AS_A_WHOLE, 1, 0.8):
        if settings.integrator != near[0]:
            raise InputError(f"no integrator is called {settings.integrator!r}; there is {near[0]}", "integrator")
        if near[0] == REGULARISED:
            problem, choice, planned, going_on = run_regularised(scene, watch=watch, keep=keep, resume=resume)
        elif resume is not None:
            raise InputError(f"a run of {near[0]} is not gone on with: it is made anew, and as a whole")
        else:
            (problem, choice, planned), going_on = run_externally(scene), {}
    else:
        problem, choice, planned = _run(scene, entered, watch=watch, keep=keep, resume=resume, warn=warn)
        going_on = resumable(planned.progress, identity_of(scene, choice.method.name))
    run = planned.run
    state = (np.array(scene.q), np.array(scene.p))
    operations = None
    if settings.integrator not in AS_A_WHOLE:
        operations = operations_per_step(problem.value, choice.method, state, compensated=run.compensated)
    q, p = (np.asarray(slot)[: planned.good] for slot in run.states)
    times = run.times[: planned.good]
    value, method = problem.value, choice.method
    closed = tuple(each.closed for each in problem.beside)
    flow = Flow(scene.model, value, method, run, planned.good, planned.error, problem.closed, operations or 1, closed)
    until = time.monotonic() + HURRY if planned.interrupted else None
    monitors = read_monitors(settings.monitors, flow, times, q, p, until)
    running = max(time.process_time() - begun - planned.compile_seconds, 0.0)
    messages, ok = _judged(scene, planned, monitors)
    if resume is not None and (other := differing_versions(resume)):
        messages = (*messages, f"begun with {other}: the last bits may differ from those of one run")
    return Result(
        scene, problem, choice, planned, times, q, p, monitors, operations, (planned.compile_seconds, running),
        messages, ok, going_on, scattered(scene, p), events_of(flow),
    )  # fmt: skip


def _run(
    scene: Scene,
    entered: float,
    *,
    watch: Callable[[float], None] | None,
    keep: Callable[[Arrays], None] | None,
    resume: Arrays | None,
    warn: Callable[[str], None] | None,
) -> tuple[Problem, Choice, Planned]:
    """The run by an integrator of this package, begun at the monotonic time `entered`."""
    settings = scene.settings
    problem = problem_of(scene.model, exact=settings.integrator is None)
    choice = choose(problem, settings.accuracy, settings.integrator, "integrator")
    state = (np.array(scene.q), np.array(scene.p))
    looking = time.process_time()
    engine = settled(settings.engine) if resume is None else engine_for(resume, settings.engine)  # loads jax and LLVM
    task = Task(problem.value, choice.method, state, settings.duration, settings.samples, settings.start, engine)
    choice = chosen_for(problem, task, settings, choice, began_with=None if resume is None else integrator_of(resume))
    task = replace(task, method=choice.method)
    identity = identity_of(scene, choice.method.name)
    limit = _limit(task, settings)
    looked = time.process_time() - looking
    if limit is not None and warn is not None:
        warn(f"the accuracy {settings.accuracy:.1e} cannot be reached: {_words(limit)}")
    shared = {
        "duration": settings.duration,
        "samples": settings.samples,
        "exact": problem.exact,
        "engine": engine,
        "watch": watch,
        "t0": settings.start,
        "keep": None if keep is None else lambda progress: keep(saved(progress, identity)),
        "resume": None if resume is None else lambda task: restored(resume, identity, task.begin),
    }
    if settings.step is not None:
        planned = run_with_step(problem.value, choice.method, state, step=settings.step, **shared)
    else:
        left = None if settings.budget is None else settings.budget - (time.monotonic() - entered)
        reserve = price(settings.monitors, scene.model.n)
        planned = run_for_accuracy(
            problem.value, choice.method, state, accuracy=limit or settings.accuracy, budget=left, reserve=reserve,
            **shared,
        )  # fmt: skip
    if limit is not None:
        planned = replace(planned, reached=False, reason=_words(limit))
    return problem, choice, replace(planned, compile_seconds=planned.compile_seconds + looked)


def _limit(task: Task, settings: Settings) -> float | None:
    """What double precision can hold at best, where that is less than a fine accuracy that is asked for."""
    if settings.accuracy is None or settings.accuracy > FINE:
        return None
    least = attainable(task)
    return None if least is None or settings.accuracy >= least else least


def _words(limit: float) -> str:
    return (
        f"in double precision the rounding of the initial state alone grows to {limit:.1e}, which is aimed at; "
        f"ask for {2 * limit:.0e} or more, or shorten the run"
    )


def _check_start(scene: Scene) -> None:
    """Refuse an initial state at which the equations of motion are not finite."""
    model = scene.model
    rates = gradient(model.H, (*model.q, *model.p))
    values = observe(
        (model.H, *rates),
        (model.q, model.p, model.t),
        np.array([scene.settings.start]),
        np.array([scene.q]),
        np.array([scene.p]),
    )
    if not np.isfinite(values).all():
        raise InputError("the equations of motion are not finite at the initial state: is a body at a singularity?")


def _check_constraints(scene: Scene) -> None:
    """Refuse an initial state that is off its constraints."""
    q, p = scene.q, scene.p
    for model in scene.model.beside or (scene.model,):
        faults = faults_at(model, q[: len(model.q)], p[: len(model.p)], scene.settings.start)
        if faults:
            raise InputError(f"the initial state is not on its constraints: {'; '.join(faults)}")
        q, p = q[len(model.q) :], p[len(model.p) :]


def _judged(scene: Scene, planned: Planned, monitors: tuple[Reading, ...]) -> tuple[tuple[str, ...], bool]:
    """What to say of the run, and whether it is as it should be."""
    run, messages, ok = planned.run, [], True
    times = run.times
    if planned.good == run.samples and planned.interrupted:
        messages.append(f"interrupted before a finer run was finished: the last one is kept{_reached(planned)}")
        ok = False
    elif planned.interrupted or (planned.reason == BUDGET_USED and planned.good < run.samples):
        why = "interrupted" if planned.interrupted else "the budget was used"
        messages.append(f"{why} at t = {times[planned.good - 1]:.6g}: what was computed until then is kept")
        ok = False
    elif planned.good < run.samples:
        last, after = run.times[planned.good - 1], run.times[planned.good]
        if scene.settings.step is None:
            more = f", or needs more than the {run.total} steps that were tried"
        else:
            more = f", or a step of {run.step:.3g} is too long"
        messages.append(
            f"ended at t = {last:.6g}: before t = {after:.6g} the orbit runs into a singularity (a blow-up or a "
            f"collision), or is too sensitive to be followed{more}{_otherwise(scene, THROUGH)}"
        )
        ok = False
    elif scene.settings.accuracy is not None and not planned.reached:
        reached = "unknown" if planned.error is None else f"{planned.error:.1e}"
        reason = f": {planned.reason}" if planned.reason else ""
        beside = _otherwise(scene, CLOSE)
        messages.append(f"the accuracy {scene.settings.accuracy:.1e} was not reached, but {reached}{reason}{beside}")
        ok = False
    elif scene.settings.budget is not None and len(planned.trials) == 1:
        messages.append("the budget left time for a single run: nothing is known of its error")
        ok = False
    left = scene.settings.monitors[len(monitors) :]
    if left:
        messages.append(f"interrupted before these monitors were read: {', '.join(left)}")
        ok = False
    for reading in monitors:
        if reading.alarm:
            messages.append(f"{reading.name}: {reading.alarm}")
            ok = False
    return tuple(messages), ok


def _otherwise(scene: Scene, words: str) -> str:
    """What may help, if the orbit is one about an attracting centre."""
    if scene.settings.integrator in AS_A_WHOLE or not is_regularised(scene):
        return ""
    return words


def _reached(planned: Planned) -> str:
    return "" if planned.error is None else f", with an error of {planned.error:.1e}"
