"""What integrators would cost for an accuracy, predicted from short runs: order, error constant, cost of a step.

Short runs with more and more steps over a window of the duration show the error constant C of e = C n^(−p); over the
whole, the error of a regular orbit grows with time. So many steps as that takes, times the arithmetic operations of
one, is the work, by which candidates are compared: it is the same on every machine and in every run. Hairer and Wanner
(1996), Solving Ordinary Differential Equations II, IV.10, compare methods so, after the fact.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from canon.errors import InputError
from canon.interruption import interruptible
from canon.numeric.forecast import GROWTH
from canon.numeric.integrate import Run, advance
from canon.numeric.integrators.stepper import Method
from canon.numeric.operations import operations_per_step
from canon.numeric.precision import UNIT
from canon.numeric.run_difference import distance
from canon.numeric.step_search import AIM, Task

WORTH: Final = 5e9
"""Operations of a run below which others are not tried: to compile them takes longer than that, some seconds."""
FINE: Final = 1e-9
"""The accuracy at which candidates for a budget show their order and error constant."""
LONGEST: Final = 16_384
"""Steps of a run of a trial, at most, unless there are more samples."""
NARROWER: Final = 16.0
"""Times that a window is shorter where so many steps are too few for it."""
WINDOWS: Final = 8
GAIN: Final = 0.8
"""What a candidate's work is to be below, beside that of the method that the rules choose, to be taken instead."""
ROUNDING: Final = 1e-12


@dataclass(frozen=True)
class Prediction:
    """What a `method` is expected to take: `steps` of `operations` each, for an `error`, in `seconds` of CPU time.

    `order` is the one that was measured. None stands for what is not known, and `why` says why a candidate was not
    taken.
    """

    method: Method
    operations: int
    order: float | None = None
    steps: float | None = None
    error: float | None = None
    seconds: float | None = None
    why: str = ""

    @property
    def work(self) -> float:
        """Operations of the whole run; infinite where it is not known."""
        return math.inf if self.steps is None else self.steps * self.operations


@dataclass(frozen=True)
class _Trial:
    """A run of a window with `steps`, how far it is from the one with half as many, and the seconds of a step."""

    steps: int
    error: float
    order: float | None
    each: float


def predicted(task: Task, methods: Sequence[Method], accuracy: float, *, compare: bool = False) -> list[Prediction]:
    """The candidates, the one to be taken first.

    The first of `methods` is what the rules choose; the others are tried where its run is expected to take seconds, or
    with `compare`. The error is what is aimed at, a quarter of the accuracy.
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
    rate = trial.each / max(rule.operations, 1)
    found = [_tried(task, other, accuracy, window, rate) for other in others]
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
    rate = trial.each / max(rule.operations, 1)
    rule, *found = (within(each, seconds) for each in (rule, *(_tried(task, m, FINE, window, rate) for m in others)))
    best = min([rule, *found], key=_error)
    taken = best if _error(best) < _error(rule) / 2 else rule
    rest = [each for each in (rule, *found) if each is not taken]
    return [taken, *(replace(e, why=e.why or f"{_error(e) / _error(taken):.2g} times the error") for e in rest)]


def within(each: Prediction, seconds: float) -> Prediction:
    """The prediction for as many steps as the seconds allow: the error falls as the order says, down to rounding."""
    if each.steps is None or each.error is None or not each.seconds:
        return each
    more = seconds / each.seconds
    steps = each.steps * more
    error = each.error * more**-each.method.traits.order + UNIT * steps**GROWTH
    return replace(each, steps=steps, error=error, seconds=seconds)


def _error(each: Prediction) -> float:
    return math.inf if each.error is None or each.steps is None else each.error


def _tried(task: Task, method: Method, accuracy: float, window: float, rate: float) -> Prediction:
    """The prediction for another candidate, at the first one's seconds for an operation."""
    try:
        window, trial = _window(task, method, accuracy, window)
        operations = _operations(task, method)
    except InputError as reason:
        return Prediction(method, 0, why=str(reason))
    if trial is None:
        return Prediction(method, operations, why="no order is seen in short runs")
    found = _prediction(task, method, accuracy, window, trial)
    return replace(found, seconds=found.work * rate)


def _rejected(each: Prediction, taken: Prediction) -> Prediction:
    if each.why or each.steps is None:
        return each
    ratio = each.work / taken.work
    return replace(each, why=f"{ratio:.2g} times the work" if ratio >= 1 else f"only {1 - ratio:.0%} less work")


def _prediction(task: Task, method: Method, accuracy: float, window: float, trial: _Trial) -> Prediction:
    """From the window to the whole: its error grows with time, and so does the number of steps."""
    order, whole = method.traits.order, task.duration / window
    goal = AIM * accuracy / whole
    steps = max(trial.steps * (trial.error / goal) ** (1 / order) * whole, 1.0)
    steps = max(steps, float(task.samples - 1))
    return Prediction(method, _operations(task, method), trial.order, steps, AIM * accuracy, steps * trial.each)


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


def _trial(task: Task, accuracy: float, window: float) -> _Trial | None:
    """Runs of the window with twice as many steps each, until the error is what is aimed at, or rounding."""
    order, goal = task.method.traits.order, AIM * accuracy * window / task.duration
    task = replace(task, duration=window)
    steps, runs, differences = max(task.samples - 1, 16), list[Run](), list[float]()
    most, each, found = max(LONGEST, 8 * steps), 0.0, None
    warm = False
    while steps <= most:
        begin = task.begin(steps, False)
        if not warm:
            advance(task.problem, task.method, begin, chunks=0)
            warm = True
        begun = time.process_time()
        run = interruptible(lambda begin=begin: advance(task.problem, task.method, begin))
        each = (time.process_time() - begun) / run.total
        if runs:
            whole = run.completed == runs[-1].completed == run.samples
            differences.append(distance(run, runs[-1]) if whole else math.inf)
            found = _seen(differences, order, run.total, each) or found
            if found is None and differences[-1] < max(goal, ROUNDING):
                found = _Trial(run.total, differences[-1], None, each)  # the first ones are as fine as is wanted
            if found is not None and (found.error <= goal or differences[-1] < ROUNDING):
                break
        runs = [run]
        steps = 2 * run.total
    return found


def _seen(differences: Sequence[float], order: int, steps: int, each: float) -> _Trial | None:
    """The trial, where the last two differences fall as the order says they should."""
    if len(differences) < 2 or not 0 < differences[-1] < differences[-2] < math.inf:
        return None
    measured = math.log2(differences[-2] / differences[-1])
    if measured < order - 1:
        return None
    return _Trial(steps, differences[-1] / (2**order - 1), measured, each)
