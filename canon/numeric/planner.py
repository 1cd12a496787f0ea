"""Chooses the step for an accuracy: runs with more and more steps until two of them differ by little enough.

The error is estimated from the difference of two runs and the method's order, where a third run shows that the order
is reached; from the difference itself elsewhere. Hairer, Nørsett and Wanner (1993), Solving Ordinary Differential
Equations I, II.4.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.integrate import Run, advance, start
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method

FIRST_STEPS: Final = 32
MOST_STEPS: Final = 2_000_000_000
AIM: Final = 0.25
"""The part of the accuracy that is aimed at: estimates are no bounds."""
PATIENCE: Final = 300.0
"""Seconds after which no run is begun that is expected to take longer than this, where no budget is given."""
STUBBORN: Final = 4
"""Doublings of the steps after which two runs that still part at one time are said to end there."""
PIECE: Final = 0.2
"""Seconds between two looks at whether the run goes on."""
PLATEAU: Final = 1e-6
"""Differences below this that no longer fall are rounding."""
AGREED: Final = 1e-3
"""Two runs that differ by more than this part of their size have nothing in common any more."""

Watch = Callable[[float], None]
"""Is told, now and then, which part of a run is done."""


@dataclass(frozen=True)
class Trial:
    """A run that was made: its number of steps, how far its states were from those of the one before, its CPU time."""

    steps: int
    difference: float
    seconds: float


@dataclass(frozen=True)
class Planned:
    """The last run, its estimated `error` (relative to the largest coordinate, and the largest momentum), and `trials`.

    `good` counts the samples that can be trusted: all that are stored, unless the orbit ends in a singularity.
    `reached` says whether the accuracy was; `reason` says why not. `interrupted`: somebody stopped it.
    """

    run: Run
    good: int
    error: float | None
    trials: tuple[Trial, ...]
    reached: bool
    reason: str = ""
    interrupted: bool = False
    compile_seconds: float = 0.0


def run_for_accuracy(
    problem: Any,
    method: Method,
    state: State,
    *,
    duration: float,
    samples: int,
    accuracy: float | None,
    exact: bool = False,
    t0: float = 0.0,
    budget: float | None = None,
    watch: Watch | None = None,
) -> Planned:
    """The run whose states are estimated to be as accurate as asked for; with `accuracy` = None as accurate as the
    `budget` of seconds allows. `exact`: the method makes no error but rounding, whatever its steps.
    """
    return _Search(problem, method, state, duration, samples, accuracy, exact, t0, budget, watch).find()


def run_with_step(
    problem: Any,
    method: Method,
    state: State,
    *,
    duration: float,
    samples: int,
    step: float,
    exact: bool = False,
    t0: float = 0.0,
    watch: Watch | None = None,
) -> Planned:
    """The run with a step of this length, or a little less so that samples are met; its error from one with twice it.

    **Raises:** `InputError` where that is too many steps.
    """
    if duration / step > MOST_STEPS:
        raise InputError(
            f"a step of {step:g} over {duration:g} makes {duration / step:.2g} steps: at most {MOST_STEPS:.0e}"
        )
    steps = max(int(np.ceil(duration / step * (1 - 1e-12))), 1)
    search = _Search(problem, method, state, duration, samples, None, exact, t0, None, watch)
    run = search.made(steps)
    error = None
    if search.interrupted or steps < 2 * (samples - 1):
        return search.planned(run, error, reached=True)
    coarse = search.made(max(steps // 2, 1))
    # what was stopped is the estimate of the error, not the run itself
    stopped, search.interrupted = search.interrupted, False
    search.runs.reverse()
    search.trials.reverse()
    if not stopped and run.completed == coarse.completed == samples:
        error = distance(run, coarse) / (1 if exact else (total(run) / total(coarse)) ** method.traits.order - 1)
    return search.planned(run, error, reached=True)


class _Search:
    """The runs that were made so far, and what they say."""

    def __init__(
        self, problem: Any, method: Method, state: State, duration: float, samples: int, accuracy: float | None,
        exact: bool, t0: float, budget: float | None, watch: Watch | None,
    ) -> None:  # fmt: skip
        self.problem, self.method, self.state = problem, method, state
        self.duration, self.samples, self.t0 = duration, samples, t0
        self.accuracy, self.exact, self.budget, self.watch = accuracy, exact, budget, watch
        self.order = method.traits.order
        self.runs: list[Run] = []
        self.trials: list[Trial] = []
        self.agreed: list[int] = []
        self.compensated: bool | None = None
        self.compile_seconds = 0.0
        self.interrupted = False
        self.began = time.monotonic()

    def find(self) -> Planned:
        """Runs until the accuracy is reached, or cannot be."""
        steps = max(self.samples - 1, FIRST_STEPS)
        self.made(steps)
        while not self.interrupted:
            steps = total(self.runs[-1]) * (2 if len(self.runs) < 3 else self.factor())
            stop = self.too_long(int(steps))
            if stop:
                return self.planned(self.runs[-1], self.error(), reached=False, reason=stop)
            self.made(int(np.ceil(steps)))
            if self.interrupted:
                break
            error = self.error()
            if self.accuracy is not None and error <= self.accuracy * (1 if self.exact else 2 * AIM):
                return self.planned(self.runs[-1], error, reached=True)
            if self.ends():
                return self.planned(self.runs[-1], self.error(), reached=False)
            if self.stuck():
                if self.compensated or self.exact:
                    return self.planned(
                        self.runs[-1], error, reached=False, reason="rounding keeps it from going further"
                    )
                self.compensated = True
            if self.accuracy is None and error <= 1e-15:
                break
        return self.planned(self.runs[-1], self.error(), reached=self.accuracy is None)

    def made(self, steps: int) -> Run:
        """A run of so many steps, or a few more; interrupted where somebody presses Ctrl-C."""
        begun = time.process_time()
        run = start(
            self.problem, self.method, self.state, duration=self.duration, steps=steps, samples=self.samples,
            t0=self.t0, compensated=self.compensated,
        )  # fmt: skip
        if not self.runs or run.compensated != self.runs[-1].compensated:
            advance(self.problem, self.method, run, chunks=0)
            self.compile_seconds += time.process_time() - begun
        begun = time.process_time()
        try:
            run = self.advanced(run)
        except KeyboardInterrupt as stop:
            self.interrupted = True
            run = stop.args[0] if stop.args and isinstance(stop.args[0], Run) else run
            run = run if not self.runs or run.completed > self.runs[-1].completed else self.runs[-1]
        difference = distance(run, self.runs[-1]) if self.runs and not self.interrupted else np.inf
        self.runs = [*self.runs[-2:], run]
        self.agreed.append(agreement(run, self.runs[-2]) if len(self.runs) > 1 else 0)
        self.trials.append(Trial(total(run), difference, time.process_time() - begun))
        return run

    def advanced(self, run: Run) -> Run:
        """The run to its end, in pieces short enough to be watched and stopped."""
        chunks = 1
        while run.done < run.chunks and not run.ended:
            begun = time.monotonic()
            try:
                run = advance(self.problem, self.method, run, chunks=chunks)
                if self.watch is not None:
                    self.watch(run.done / run.chunks)
            except KeyboardInterrupt:
                raise KeyboardInterrupt(run) from None
            spent = time.monotonic() - begun
            chunks = max(1, min(int(chunks * min(PIECE / max(spent, 1e-6), 8)), run.chunks))
        return run

    def error(self) -> float:
        """The estimated error of the last run."""
        if len(self.trials) < 2:
            return np.inf
        difference = self.trials[-1].difference
        if self.exact or not np.isfinite(difference):
            return max(difference, 2.0**-52)
        ratio = total(self.runs[-1]) / total(self.runs[-2])
        if self.in_order():
            return max(difference / (ratio**self.order - 1), 2.0**-52)
        return max(difference, 2.0**-52)

    def in_order(self) -> bool:
        """Whether the last differences fall as the order says they should."""
        if len(self.trials) < 3 or not 0 < self.trials[-1].difference < self.trials[-2].difference < np.inf:
            return False
        before, last = self.trials[-2:]
        fallen = np.log(before.difference / last.difference)
        # d(N, M) ≈ C N^-r for M well above N: the step of the coarser run of each pair
        expected = np.log(total(self.runs[-2]) / total(self.runs[-3]))
        return bool(fallen > (self.order - 1) * expected)

    def factor(self) -> float:
        """By how much more steps the next run should have."""
        if self.accuracy is None or not self.in_order() or self.compensated != self.runs[-1].compensated:
            return 2.0
        wanted = (self.error() / (AIM * self.accuracy)) ** (1 / self.order)
        return float(np.clip(wanted, 1.25, 16.0))

    def stuck(self) -> bool:
        """Whether the differences have come down to rounding."""
        if len(self.trials) < 4:
            return False
        before, last = self.trials[-2].difference, self.trials[-1].difference
        return before < PLATEAU and last > 0.5 * before

    def ends(self) -> bool:
        """Whether runs agree up to one time and no further, however small the steps: the orbit ends there."""
        last = self.agreed[-STUBBORN:]
        return len(last) == STUBBORN and 0 < last[0] < self.samples and len({*last}) == 1

    def too_long(self, steps: int) -> str:
        """Why a run of so many steps is not begun; nothing if it is."""
        last = self.trials[-1]
        expected = last.seconds * steps / max(last.steps, 1)
        spent = time.monotonic() - self.began
        if steps > MOST_STEPS:
            return f"it would take more than {MOST_STEPS:.0e} steps"
        if self.budget is not None:
            return f"the budget of {self.budget:g} s is used" if spent + expected > self.budget else ""
        return f"the next run would take {expected:.0f} s: give --budget to allow it" if expected > PATIENCE else ""

    def planned(self, run: Run, error: float | None, *, reached: bool, reason: str = "") -> Planned:
        """What is to be told of a run that is the last one."""
        good = run.completed
        if len(self.runs) > 1 and not self.interrupted and (run.ended or self.ends()):
            good = max(agreement(run, self.runs[-2]), 1)
            error = distance(run, self.runs[-2], good)
        return Planned(
            run,
            good,
            error if error is not None and np.isfinite(error) else None,
            tuple(self.trials),
            reached and not self.interrupted,
            reason,
            self.interrupted,
            self.compile_seconds,
        )


def agreement(run: Run, other: Run) -> int:
    """How many samples, from the first on, two runs agree in: each slot to a part of its largest size until then."""
    import jax

    count = min(run.completed, other.completed)
    good = np.ones(count, dtype=bool)
    for slot, against in zip(run.states, other.states, strict=True):
        pairs = list(zip(jax.tree.leaves(slot), jax.tree.leaves(against), strict=True))
        sizes = np.maximum.accumulate(
            np.max([np.abs(b[:count]).reshape(count, -1).max(axis=1) for _, b in pairs], axis=0)
        )
        off = np.max([np.abs(a[:count] - b[:count]).reshape(count, -1).max(axis=1) for a, b in pairs], axis=0)
        good &= off <= AGREED * sizes
    return count if good.all() else int(np.argmin(good))


def distance(run: Run, other: Run, upto: int | None = None) -> float:
    """The largest difference of two runs' states, each slot in units of its largest component, where both got to."""
    import jax

    count = min(run.completed, other.completed, upto or run.samples)
    worst = 0.0
    for slot, against in zip(run.states, other.states, strict=True):
        pairs = list(zip(jax.tree.leaves(slot), jax.tree.leaves(against), strict=True))
        size = max(float(np.abs(a[:count]).max(initial=0.0)) for a, _ in pairs)
        off = max(float(np.abs(a[:count] - b[:count]).max(initial=0.0)) for a, b in pairs)
        worst = max(worst, off / size if size > 0 else off)
    return worst


def total(run: Run) -> int:
    """The steps of the whole run, whether they were made or not."""
    return run.chunks * run.per_chunk
