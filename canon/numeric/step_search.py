"""The search for a step: runs with more and more steps, and what their differences say of the error.

It can be watched, stopped, kept and gone on with: everything that its decisions rest on is in its `Progress`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Final, NamedTuple

import numpy as np

from canon.interruption import interruptible
from canon.numeric.integrate import Run, advance, start
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method
from canon.numeric.progress import Progress, Trial
from canon.numeric.run_difference import agreement, distance

FIRST_STEPS: Final = 32
MOST_STEPS: Final = 2_000_000_000
AIM: Final = 0.25
"""The part of the accuracy that is aimed at: estimates are no bounds."""
PATIENCE: Final = 300.0
"""Seconds after which no run is begun that is expected to take longer than this, where no budget is given."""
STUBBORN: Final = 8
"""Runs with more and more steps that agree no longer than those before, after which the orbit is said to end there."""
FROM_THE_BEGINNING: Final = 14
"""As many where they part before the second sample: then nothing shows yet that any step was short enough."""
SHORT: Final = (2, 500_000)
"""As many where the last one had this number of steps or more."""
LONGER: Final = 1.3
"""They agree longer if they do so for that much longer."""
PIECE: Final = 0.2
"""Seconds between two looks at whether the run goes on."""
PLATEAU: Final = 1e-6
"""Differences below this that no longer fall are rounding."""
KEEP_EVERY: Final = 10.0
"""Seconds between two calls of `keep`; at least `KEEP_SHARE` times as many as such a call takes."""
KEEP_SHARE: Final = 20.0
BUDGET_USED: Final = "the budget is used"

Watch = Callable[[float], None]
"""Is told, now and then, which part of a run is done."""
Keep = Callable[[Progress], None]
"""Is given, now and then, what the search can be gone on with."""
Reserve = Callable[[float], float]
"""From the seconds of a run to those that a budget must leave for what comes after it."""


@dataclass(frozen=True)
class Task:
    """What is integrated, how, from where and for how long."""

    problem: Any
    method: Method
    state: State
    duration: float
    samples: int
    t0: float

    def begin(self, steps: int, compensated: bool | None) -> Run:
        """The run of so many steps, or a few more, before its first one."""
        return start(
            self.problem, self.method, self.state, duration=self.duration, steps=steps, samples=self.samples,
            t0=self.t0, compensated=compensated,
        )  # fmt: skip


class Verdict(NamedTuple):
    """Why a search ends, and whether it has what it was made for."""

    reached: bool
    reason: str = ""


class Search:
    """The runs that were made so far, and what they say; it begins where `progress` left off."""

    def __init__(
        self, task: Task, accuracy: float | None, exact: bool, budget: float | None, watch: Watch | None,
        keep: Keep | None, progress: Progress, reserve: Reserve | None = None,
    ) -> None:  # fmt: skip
        self.task, self.accuracy, self.exact = task, accuracy, exact
        self.watch, self.keep, self.reserve = watch, keep, reserve or (lambda seconds: 0.0)
        self.order = task.method.traits.order
        self.runs, self.current = [*progress.runs], progress.current
        self.trials, self.agreed = [*progress.trials], [*progress.agreed]
        self.compensated = progress.compensated
        self.compiled: set[bool] = set()
        self.compile_seconds = 0.0
        self.interrupted = self.out_of_time = False
        self.began = self.kept = time.monotonic()
        self.budget = max(budget or 0.0, 0.0)
        self.deadline = None if budget is None else self.kept + budget
        self.pause = KEEP_EVERY

    def progress(self) -> Progress:
        """What it can be gone on with."""
        return Progress(tuple(self.runs), self.current, tuple(self.trials), tuple(self.agreed), self.compensated)

    def keep_last(self) -> None:
        """Keep what has been found, if that took long: what comes after the search may take long, too."""
        if self.keep is not None and time.monotonic() - self.began > KEEP_EVERY:
            self.keep(self.progress())

    @property
    def stopped(self) -> bool:
        """Whether the current run was left before its end."""
        return self.interrupted or self.out_of_time

    def complete(self, counts: Sequence[int]) -> None:
        """Runs of these numbers of steps, as far as they are not made yet."""
        for steps in counts[len(self.runs) :]:
            if not self.stopped:
                self.made(steps)

    def verdict(self) -> Verdict | None:
        """Why the search ends here; None if it goes on."""
        if self.current is not None or not self.runs:
            return None
        error = self.error()
        whole = not any(run.ended for run in self.runs[-2:])
        if whole and self.accuracy is not None and error <= self.accuracy * (1 if self.exact else 2 * AIM):
            return Verdict(True)
        if self.ends():
            return Verdict(False)
        if self.stuck():
            if self.compensated or self.exact:
                return Verdict(False, "rounding keeps it from going further")
            self.compensated = True
        if whole and self.accuracy is None and error <= 1e-15:
            return Verdict(True)
        stop = self.too_long(self.wanted())
        return Verdict(False, stop) if stop else None

    def next(self) -> Run:
        """The next run, or what is left of the current one."""
        return self.made(self.wanted() if self.runs else max(self.task.samples - 1, FIRST_STEPS))

    def wanted(self) -> int:
        """The steps that the next run should have."""
        return int(np.ceil(self.runs[-1].total * (2 if len(self.runs) < 2 else self.factor())))

    def made(self, steps: int) -> Run:
        """The current run to its end; where there is none, one of so many steps, or a few more.

        It is left before its end when somebody presses Ctrl-C, or the budget is used.
        """
        run = self.current = self.current or self.task.begin(steps, self.compensated)
        begun = time.process_time()
        try:
            if run.compensated not in self.compiled:
                interruptible(lambda: self.warmed(run))
                self.compiled.add(run.compensated)
                self.compile_seconds += time.process_time() - begun
                begun = time.process_time()
            self.advanced()
        except KeyboardInterrupt:
            self.interrupted = True
        run, before = self.current, self.runs[-1] if self.runs else None
        if self.stopped and run.done < run.chunks and not run.ended:
            return run
        self.runs, self.current = [*self.runs[-2:], run], None
        self.agreed.append(agreement(run, before) if before else 0)
        self.trials.append(Trial(run.total, distance(run, before) if before else np.inf, time.process_time() - begun))
        return run

    def warmed(self, run: Run) -> None:
        """Compile the program, and call it with what it is given at first and with what it returns: jax tells the two
        apart, and what it learns of them would else be counted as time of the first run.
        """
        for _ in range(2):
            run = advance(self.task.problem, self.task.method, run, chunks=0)

    def advanced(self) -> None:
        """Take the current run to its end, in pieces short enough to be watched and stopped."""
        chunks = 1
        while self.current is not None and self.current.done < self.current.chunks and not self.current.ended:
            begun = time.monotonic()
            self.current = interruptible(
                partial(advance, self.task.problem, self.task.method, self.current, chunks=chunks)
            )
            if self.watch is not None:
                self.watch(self.current.done / self.current.chunks)
            now = time.monotonic()
            chunks = max(1, min(int(chunks * min(PIECE / max(now - begun, 1e-6), 8)), self.current.chunks))
            if self.keep is not None and now - self.kept > self.pause:
                self.keep(self.progress())
                self.kept = time.monotonic()
                self.pause = max(KEEP_EVERY, KEEP_SHARE * (self.kept - now))
            if now > self.latest() and self.current.done < self.current.chunks:
                self.out_of_time = True
                return

    def latest(self) -> float:
        """When the current run is left, if it is not finished: the first one gets twice the budget."""
        if self.deadline is None:
            return np.inf
        return self.deadline - self.reserve(0.0) if self.runs else self.deadline + self.budget

    def error(self) -> float:
        """The estimated error of the last run."""
        if len(self.trials) < 2:
            return np.inf
        difference = self.trials[-1].difference
        if self.exact or not np.isfinite(difference):
            return max(difference, 2.0**-52)
        ratio = self.runs[-1].total / self.runs[-2].total
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
        expected = np.log(self.runs[-2].total / self.runs[-3].total)
        return bool(fallen > (self.order - 1) * expected)

    def factor(self) -> float:
        """By how much more steps the next run should have."""
        if self.accuracy is None or not self.in_order() or self.compensated != self.runs[-1].compensated:
            return 2.0
        wanted = (self.error() / (AIM * self.accuracy)) ** (1 / self.order)
        return float(np.clip(wanted, 1.25, 16.0))

    def stuck(self) -> bool:
        """Whether the differences have come down to rounding."""
        if len(self.trials) < 4 or self.runs[-1].ended:
            return False
        before, last = self.trials[-2].difference, self.trials[-1].difference
        return before < PLATEAU and last > 0.5 * before

    def ends(self) -> bool:
        """Whether runs agree up to one time and not much further, however small the steps: the orbit ends there."""
        if not self.agreed or not 0 < self.agreed[-1] < self.task.samples:
            return False
        count = STUBBORN if self.agreed[-1] > 1 else FROM_THE_BEGINNING
        if self.trials[-1].steps >= SHORT[1]:
            count = SHORT[0]
        before = self.agreed[:-count]
        return bool(before) and max(self.agreed[-count:]) <= LONGER * max(max(before), 1)

    def too_long(self, steps: int) -> str:
        """Why a run of so many steps is not begun; nothing if it is."""
        last = self.trials[-1]
        expected = last.seconds * steps / max(last.steps, 1)
        if steps > MOST_STEPS:
            return f"it would take more than {MOST_STEPS:.0e} steps"
        if self.deadline is not None:
            ready = time.monotonic() + expected + self.reserve(expected)
            return BUDGET_USED if ready > self.deadline else ""
        return f"the next run would take {expected:.0f} s: give --budget to allow it" if expected > PATIENCE else ""
