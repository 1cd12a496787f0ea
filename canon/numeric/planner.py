"""Chooses the step for an accuracy: runs with more and more steps until two of them differ by little enough.

The error is estimated from the difference of two runs and the method's order, where a third run shows that the order
is reached; from the difference itself elsewhere. Hairer, Nørsett and Wanner (1993), Solving Ordinary Differential
Equations I, II.4.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from canon.errors import InputError
from canon.numeric.convergence import LEAST
from canon.numeric.engines import Engine
from canon.numeric.integrate import Run
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method
from canon.numeric.progress import Progress, Trial
from canon.numeric.run_difference import agreement, distance
from canon.numeric.step_search import BUDGET_USED, MOST_STEPS, Keep, Reserve, Search, Task, Verdict, Watch


@dataclass(frozen=True)
class Planned:
    """The last run, its estimated `error` (relative to the largest coordinate, and the largest momentum), and `trials`.

    `good` counts the samples that can be trusted: all that are stored, unless the orbit ends in a singularity.
    `reached` says whether the accuracy was; `reason` says why not. `interrupted`: somebody stopped it. `progress` is
    what the search can be gone on with.
    """

    run: Run
    good: int
    error: float | None
    trials: tuple[Trial, ...]
    reached: bool
    reason: str = ""
    interrupted: bool = False
    compile_seconds: float = 0.0
    progress: Progress = field(default_factory=Progress)


def run_for_accuracy(
    problem: object,
    method: Method,
    state: State,
    *,
    duration: float,
    samples: int,
    accuracy: float | None,
    exact: bool = False,
    t0: float = 0.0,
    engine: Engine = "auto",
    budget: float | None = None,
    reserve: Reserve | None = None,
    watch: Watch | None = None,
    keep: Keep | None = None,
    resume: Callable[[Task], Progress] | None = None,
) -> Planned:
    """The run whose states are estimated to be as accurate as asked for; with `accuracy` = None as accurate as the
    `budget` of seconds allows. `exact`: the method makes no error but rounding, whatever its steps.

    `watch` is told which part of a run is done, and `keep` what can be gone on with, both now and then; `resume` gives
    the progress of an interrupted search for this task, which then goes on as if it had not been interrupted. `engine`
    computes all its runs (see `canon.numeric.integrate.integrate`). Of the budget, what `reserve` says of the last run
    is left for what comes after it.
    """
    task = Task(problem, method, state, duration, samples, t0, engine)
    search = Search(task, accuracy, exact, budget, watch, keep, resume(task) if resume else Progress(), reserve)
    verdict = search.verdict()
    while verdict is None and not search.stopped:
        search.next()
        verdict = search.verdict()
    run, trials = search.progress().shown, tuple(search.trials)
    whole = run is not search.current
    verdict = verdict or Verdict(False, BUDGET_USED if search.out_of_time else "")
    other = search.runs[-2] if whole and len(search.runs) > 1 else None
    return _planned(search, run, other, search.error() if whole else None, trials, verdict)


def run_with_step(
    problem: object,
    method: Method,
    state: State,
    *,
    duration: float,
    samples: int,
    step: float,
    exact: bool = False,
    t0: float = 0.0,
    engine: Engine = "auto",
    watch: Watch | None = None,
    keep: Keep | None = None,
    resume: Callable[[Task], Progress] | None = None,
) -> Planned:
    """The run with a step of this length, or a little less so that samples are met; its error from one with twice it,
    and no less than what roundings, one a step at random, make where the steps don't keep them.

    **Raises:** `InputError` where that is too many steps.
    """
    check_steps(duration, step)
    steps = max(int(np.ceil(duration / step * (1 - 1e-12))), 1)
    task = Task(problem, method, state, duration, samples, t0, engine)
    search = Search(task, None, exact, None, watch, keep, resume(task) if resume else Progress())
    search.complete([steps] if steps < 2 * (samples - 1) else [steps, max(steps // 2, 1)])
    # what was stopped may be the estimate of the error, and not the run itself
    run, coarse = (*search.runs, None, None)[:2]
    if run is None:
        return _planned(search, search.progress().shown, None, None, (), Verdict(False))
    search.interrupted = False
    error = None
    if coarse is not None and run.completed == coarse.completed == samples:
        error = distance(run, coarse) / (1 if exact else (run.total / coarse.total) ** method.traits.order - 1)
        error = max(error, LEAST * (1.0 if exact or run.compensated else float(np.sqrt(run.total))))
    return _planned(search, run, coarse, error, tuple(reversed(search.trials)), Verdict(True))


def check_steps(duration: float, step: float) -> None:
    """**Raises:** `InputError` where steps of this length are too many."""
    if duration / step > MOST_STEPS:
        raise InputError(
            f"a step of {step:g} over {duration:g} makes {duration / step:.2g} steps: at most {MOST_STEPS:.0e}"
        )


def _planned(
    search: Search, run: Run, other: Run | None, error: float | None, trials: tuple[Trial, ...], verdict: Verdict
) -> Planned:
    """What is to be told of a run; `other` is one with other steps, if there is one that got to its end."""
    search.keep_last()
    good = run.completed
    if other is not None and (run.ended or search.ends()):
        good = max(agreement(run, other), 1)
        error = distance(run, other, good) if good > 1 else None  # of the initial state alone there is none
    return Planned(
        run,
        good,
        error if error is not None and np.isfinite(error) else None,
        trials,
        verdict.reached,
        verdict.reason,
        search.interrupted,
        search.compile_seconds,
        search.progress(),
    )
