"""What integrators would cost for an accuracy, predicted from short runs: order, error constant, cost of a step.

Short runs with more and more steps over a window of the duration show the error constant C of e = C n^(−p); over the
whole, the error of a regular orbit grows with time. So many steps as that takes, times the arithmetic operations of
one, is the work, by which candidates are compared: it is the same on every machine and in every run. Hairer and Wanner
(1996), Solving Ordinary Differential Equations II, IV.10, compare methods so, after the fact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from canon.errors import InputError
from canon.numeric.convergence import AIM, estimated_error
from canon.numeric.forecast import GROWTH
from canon.numeric.foreseen import Costs, costs_of, runs_to_come
from canon.numeric.integrate import LONG_RUN, Run
from canon.numeric.integrators.stepper import Method
from canon.numeric.operations import operations_per_step
from canon.numeric.precision import UNIT
from canon.numeric.progress import Progress, Trial
from canon.numeric.run_difference import distance
from canon.numeric.step_search import Search, Task

WORTH: Final = 5e9
"""Operations of a run below which others are not tried: to compile them takes longer than that, some seconds."""
FINE: Final = 1e-9
"""The accuracy at which candidates for a budget show their order and error constant."""
LONGEST: Final = 16_384
"""Steps of a run of a trial, at most, unless there are more samples."""
NARROWER: Final = 16.0
"""Times that a window is shorter where so many steps are too few for it."""
WINDOWS: Final = 8
LEAST: Final = 3
"""Runs of which the time is taken, and with as many steps as are tried where the whole will have more: one of two may
be slow by chance."""
GAIN: Final = 0.8
"""What a candidate's work is to be below, beside that of the method that the rules choose, to be taken instead."""
ROUNDING: Final = 1e-12
TIMED_SHARE: Final = 16
"""Parts of the steps of the whole that are run to see how long they take, where no other run has so many."""
MOST_TIMED: Final = 1 << 18
STRAY: Final = 0.1
"""Difference of two runs from which on they are no picture of the motion."""


@dataclass(frozen=True)
class Prediction:
    """What a `method` is expected to take: `steps` of `operations` each, for an `error`, in `seconds` of CPU time.

    These are the last run's. The search for the step comes to it by `runs`, it included, which take `total` seconds
    together; `needed` steps would just do, but a search has twice as many in each run as in the one before. `order` is
    the one that was measured, `costs` what short runs took. None stands for what is not known, and `why` says why a
    candidate was not taken.
    """

    method: Method
    operations: int
    order: float | None = None
    steps: float | None = None
    error: float | None = None
    seconds: float | None = None
    why: str = ""
    needed: float | None = None
    runs: int | None = None
    total: float | None = None
    costs: Costs | None = None

    @property
    def work(self) -> float:
        """Operations of a run with as many steps as would just do; infinite where that is not known."""
        return math.inf if self.needed is None else self.needed * self.operations


@dataclass(frozen=True)
class _Trial:
    """The runs of a window that were made, and the one of them by which to go on: its `steps`, its error, and the order
    that it shows. Its error grows with time to the power of `growth`; `costs` is what they took.
    """

    steps: int
    error: float
    order: float | None
    growth: float = 1.0
    runs: tuple[Trial, ...] = ()
    costs: Costs | None = None


def predicted(task: Task, methods: Sequence[Method], accuracy: float, *, compare: bool = False) -> list[Prediction]:
    """The candidates, the one to be taken first.

    The first of `methods` is what the rules choose; the others are tried where its run is expected to take seconds, or
    with `compare`.
    """
    first, *others = methods
    window, trial = _window(task, first, accuracy, task.duration)
    if trial is None:
        unknown = Prediction(first, _operations(task, first))
        return [unknown, *(replace(unknown, method=m, operations=0, why="not tried: no order is seen") for m in others)]
    rule = _prediction(task, first, accuracy, window, trial)
    if rule.work < WORTH and not compare:
        words = f"not tried: {first.name} takes {rule.work:.0e} operations, and to compile another takes longer"
        return [rule, *(Prediction(other, 0, why=words) for other in others)]
    found = [_tried(task, other, accuracy, window, rule) for other in others]
    best = min([rule, *found], key=lambda each: each.work)
    taken = best if best.work < GAIN * rule.work else rule
    rest = [each for each in (rule, *found) if each is not taken]
    return [replace(taken, why=""), *(_rejected(each, taken) for each in rest)]


def most_accurate(task: Task, methods: Sequence[Method], seconds: float) -> list[Prediction]:
    """The candidates with the steps that so many seconds of CPU time allow, the one of least error first.

    The first of `methods` is what the rules choose, and stays where another is not expected to halve the error.
    """
    first, *others = methods
    window, trial = _window(task, first, FINE, task.duration)
    if trial is None:
        unknown = Prediction(first, _operations(task, first))
        return [unknown, *(replace(unknown, method=m, operations=0, why="not tried: no order is seen") for m in others)]
    rule = _prediction(task, first, FINE, window, trial)
    rule, *found = (within(each, seconds) for each in (rule, *(_tried(task, m, FINE, window, rule) for m in others)))
    best = min([rule, *found], key=_error)
    taken = best if _error(best) < _error(rule) / 2 else rule
    rest = [each for each in (rule, *found) if each is not taken]
    return [taken, *(replace(e, why=e.why or f"{_error(e) / _error(taken):.2g} times the error") for e in rest)]


def of_closed_form(task: Task) -> Prediction:
    """What a motion that is one part, solved in closed form, is expected to take: two runs, which differ by rounding.

    From runs over a short part of the duration, with as many steps as these; one of three may be slow by chance.
    """
    search = _short_runs(replace(task, duration=task.duration / NARROWER))
    first, last, _ = (_made(search, factor * task.first_steps).steps for factor in (1, 2, 2))
    costs = costs_of(search.trials)
    return Prediction(
        task.method, _operations(task, task.method), steps=last, seconds=costs.seconds(last), needed=first, runs=2,
        total=costs.seconds(first) + costs.seconds(last), costs=costs,
    )  # fmt: skip


def within(each: Prediction, seconds: float) -> Prediction:
    """The prediction for as many steps as the seconds allow: the error falls as the order says, down to rounding."""
    if each.steps is None or each.error is None or not each.seconds:
        return each
    steps = each.costs.steps(seconds) if each.costs else each.steps * seconds / each.seconds
    more = steps / each.steps
    error = each.error * more**-each.method.traits.order + UNIT * steps**GROWTH
    return replace(each, steps=steps, error=error, seconds=seconds, needed=steps, runs=None, total=None)


def _error(each: Prediction) -> float:
    return math.inf if each.error is None or each.steps is None else each.error


def _tried(task: Task, method: Method, accuracy: float, window: float, first: Prediction) -> Prediction:
    """The prediction for another candidate, at the first one's seconds for an operation."""
    try:
        window, trial = _window(task, method, accuracy, window)
        operations = _operations(task, method)
    except InputError as reason:
        return Prediction(method, 0, why=str(reason))
    if trial is None:
        return Prediction(method, operations, why="no order is seen in short runs")
    assert first.costs is not None
    rate = operations / max(first.operations, 1)
    costs = replace(first.costs, per_step=first.costs.per_step * rate)
    return _prediction(task, method, accuracy, window, trial, costs)


def _rejected(each: Prediction, taken: Prediction) -> Prediction:
    if each.why or each.steps is None:
        return each
    ratio = each.work / taken.work
    return replace(each, why=f"{ratio:.2g} times the work" if ratio >= 1 else f"only {1 - ratio:.0%} less work")


def _prediction(
    task: Task, method: Method, accuracy: float, window: float, trial: _Trial, costs: Costs | None = None
) -> Prediction:
    """From the window to the whole: its error grows with time, and so does the number of steps."""
    order, whole = method.traits.order, task.duration / window
    needed = max(_needed(trial, order, accuracy, whole), float(task.samples - 1))
    if costs is None:
        assert trial.costs is not None
        costs = trial.costs
        costs = replace(costs, kept=_kept(task, method, costs)) if 2 * needed >= LONG_RUN else costs
    known = Prediction(method, _operations(task, method), trial.order, needed=needed, costs=costs)
    runs = runs_to_come(
        trial.runs, whole, order, accuracy,
        first=task.first_steps, samples=task.samples, costs=costs, growth=trial.growth,
    )  # fmt: skip
    if not runs:
        return replace(known, steps=needed, error=AIM * accuracy, seconds=costs.seconds(needed))
    last, total = runs[-1], sum(run.seconds for run in runs)
    error = estimated_error(runs, order)
    return replace(known, steps=last.steps, error=error, seconds=last.seconds, runs=len(runs), total=total)


def _needed(trial: _Trial, order: int, accuracy: float, whole: float) -> float:
    """Steps with which the error of so many windows is what is aimed at."""
    goal = AIM * accuracy / whole**trial.growth
    return trial.steps * (trial.error / goal) ** (1 / order) * whole


def _like_the_motion(runs: Sequence[Trial]) -> list[Trial]:
    """The runs whose steps take what steps take: with too few the state strays, and a sine of a large angle takes five
    times as long. The finest one is among them, and the shortest, for what every run takes.
    """
    shortest = min(runs, key=lambda run: run.seconds)
    finest = runs[-1].steps
    return [run for run in runs if run.steps == finest or run is shortest or run.difference < STRAY]


def _kept(task: Task, method: Method, costs: Costs) -> float:
    """How many times the seconds of a step it takes to keep the rounding of its additions: a long run will."""
    search = Search(replace(task, method=method), None, False, None, None, None, Progress(compensated=True))
    spent = [_made(search, MOST_TIMED) for _ in range(2)]
    return max((min(each.seconds for each in spent) - costs.per_run) / (costs.per_step * spent[0].steps or 1e-9), 1.0)


def _operations(task: Task, method: Method) -> int:
    return operations_per_step(task.problem, method, task.state)


def _window(task: Task, method: Method, accuracy: float, window: float) -> tuple[float, _Trial | None]:
    """The longest part of the duration, from `window` on, in which short runs show an order, and what they show."""
    for _ in range(WINDOWS):
        trial = _trial(replace(task, method=method), accuracy, window)
        if trial is not None:
            return window, trial
        window /= NARROWER
    return window, None


def _short_runs(task: Task) -> Search:
    """A search whose runs are told how many steps they have; they are made as those of any search, and take as long."""
    return Search(task, None, False, None, None, None, Progress(compensated=False))


def _made(search: Search, steps: int) -> Trial:
    """The search's next run, with so many steps or a few more."""
    search.made(steps)
    if search.interrupted:
        raise KeyboardInterrupt
    return search.trials[-1]


def _trial(task: Task, accuracy: float, window: float) -> _Trial | None:
    """Runs of the window with twice as many steps each, until the error is what is aimed at, or rounding."""
    order, whole = task.method.traits.order, task.duration / window
    goal = AIM * accuracy / whole
    search = _short_runs(replace(task, duration=window))
    steps, differences, found = task.first_steps, list[float](), None
    most = max(LONGEST, 8 * steps)
    while steps <= most:
        made = _made(search, steps)
        if len(search.trials) > 1:
            complete = not any(run.ended for run in search.runs[-2:])
            differences.append(made.difference if complete else math.inf)
            seen = _seen(differences, order, made.steps)
            found = replace(seen, growth=_growth(*search.runs[-2:])) if seen else found
            if found is None and differences[-1] < max(goal, ROUNDING):
                found = _Trial(made.steps, differences[-1], None)  # the first ones are as fine as is wanted
            if found is not None and (found.error <= goal or differences[-1] < ROUNDING):
                break
        steps = 2 * made.steps
    if found is None:
        return None
    runs = tuple(replace(t, difference=d) for t, d in zip(search.trials, (math.inf, *differences), strict=True))
    timed = min(round(_needed(found, order, accuracy, whole) / TIMED_SHARE), MOST_TIMED)
    beyond = timed > runs[-1].steps
    while len(search.trials) < (len(runs) + LEAST - 1 if beyond else LEAST):
        _made(search, max(timed, runs[-1].steps))
    return replace(found, runs=runs, costs=costs_of(_like_the_motion([*runs, *search.trials[len(runs) :]])))


def _growth(before: Run, last: Run) -> float:
    """The power of time with which the difference of two runs grows, as its two halves tell: from 1 to 2."""
    half = distance(last, before, (last.samples + 1) // 2)
    return min(max(math.log2(distance(last, before) / half), 1.0), 2.0) if half > 0 else 1.0


def _seen(differences: Sequence[float], order: int, steps: int) -> _Trial | None:
    """The trial, where the last two differences fall as the order says they should: not slower by an order, and not
    faster by two, as they do where the runs with fewer steps had nothing to do with the motion.
    """
    if len(differences) < 2 or not 0 < differences[-1] < differences[-2] < math.inf:
        return None
    measured = math.log2(differences[-2] / differences[-1])
    if not order - 1 <= measured <= order + 2:
        return None
    return _Trial(steps, differences[-1] / (2**order - 1), measured)
