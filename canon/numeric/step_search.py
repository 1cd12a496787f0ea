"""The search for a step: runs with more and more steps, and what their differences say of the error.

It can be watched, stopped, kept and gone on with: everything that its decisions rest on is in its `Progress`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final, NamedTuple

import numpy as np

from canon.interruption import interruptible
from canon.numeric.convergence import ROUNDED, estimated_error, reaches
from canon.numeric.cpu_time import cpu_time
from canon.numeric.engines import Engine, Settled, settled
from canon.numeric.integrate import Run, advance, start
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method
from canon.numeric.precision import UNIT
from canon.numeric.progress import Progress, Trial
from canon.numeric.run_difference import agreement, distance

FIRST_STEPS: Final = 32
MOST_STEPS: Final = 2_000_000_000
FINER: Final = 2
"""Times as many steps a run has as the one before. A longer jump, which the order would allow, spares
steps; but the difference of two runs then shows the error of the coarse one alone, and of the fine one's rounding
nothing."""
PATIENCE: Final = 300.0
"""Seconds after which no run is begun that is expected to take longer than this, where no budget is given."""
STUBBORN: Final = 8
"""Runs with more and more steps that agree no longer than those before, after which the orbit is said to end there."""
TRIED: Final = 200_000
"""Steps that the last of them has at least: few samples begin with few steps, and a close approach asks for many."""
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
FINEST: Final = 1e-14
"""The least accuracy for which rounding is kept from the first run on."""
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
    engine: Engine = "auto"

    @property
    def first_steps(self) -> int:
        """Those of the first run, or a few less."""
        return max(self.samples - 1, FIRST_STEPS)

    def begin(self, steps: int, compensated: bool | None) -> Run:
        """The run of so many steps, or a few more, before its first one."""
        return start(
            self.problem, self.method, self.state, duration=self.duration, steps=steps, samples=self.samples,
            t0=self.t0, compensated=compensated, engine=self.engine,
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
        # one engine for all runs, those of another process too: their differences are to be of their steps
        self.engine: Settled = progress.engine or settled(task.engine)
        self.task = replace(task, engine=self.engine)
        self.accuracy, self.exact = accuracy, exact
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
        return Progress(
            tuple(self.runs), self.current, tuple(self.trials), tuple(self.agreed), self.compensated, self.engine
        )

    def keep_last(self) -> None:
        """Keep what has been found, if that took long, or somebody stopped it: what comes after may take long, too."""
        if self.keep is not None and (self.interrupted or time.monotonic() - self.began > KEEP_EVERY):
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
        whole = not any(run.ended for run in self.runs[-2:])
        if whole and self.accuracy is not None and reaches(self.trials, self.order, self.accuracy, exact=self.exact):
            return Verdict(True)
        if self.ends():
            return Verdict(False)
        if self.stuck():
            if self.compensated or self.exact:
                return Verdict(False, "rounding keeps it from going further")
            self.compensated = True
        if whole and self.accuracy is None and estimated_error(self.trials, self.order, exact=self.exact) <= 1e-15:
            return Verdict(True)
        stop = self.too_long(self.wanted())
        return Verdict(False, stop) if stop else None

    def next(self) -> Run:
        """The next run, or what is left of the current one."""
        return self.made(self.wanted() if self.runs else self.task.first_steps)

    def wanted(self) -> int:
        """The steps that the next run should have."""
        return FINER * self.runs[-1].total

    def made(self, steps: int) -> Run:
        """The current run to its end; where there is none, one of so many steps, or a few more.

        It is left before its end when somebody presses Ctrl-C, or the budget is used.
        """
        run = self.current = self.current or self.task.begin(steps, self.keeps(steps))
        try:
            self.warmed(run)
        except KeyboardInterrupt:
            self.interrupted = True
            return run
        with cpu_time() as spent:
            try:
                self.advanced()
            except KeyboardInterrupt:
                self.interrupted = True
            run, before = self.current, self.runs[-1] if self.runs else None
            if self.stopped and run.done < run.chunks and not run.ended:
                return run
            self.runs, self.current = [*self.runs[-2:], run], None
            self.agreed.append(agreement(run, before) if before else 0)
            off = distance(run, before) if before else np.inf
        self.trials.append(Trial(run.total, off, spent.seconds))
        return run

    def keeps(self, steps: int) -> bool | None:
        """Whether a run of so many steps keeps what its additions round away; None where its length alone decides.

        It does where a rounding a step, all of them the same way, would come to the accuracy: an estimate of the error
        by the order of the method knows nothing of rounding. Of accuracies that are rounding themselves the search
        finds out where it ends.
        """
        fine = self.accuracy is not None and not self.exact and FINEST <= self.accuracy < steps * UNIT
        return True if fine and self.compensated is None else self.compensated

    def warmed(self, run: Run) -> None:
        """Compile the program, where that is not done, and call it with what it is given at first and with what it
        returns: jax tells the two apart, and what it learns of them would else be counted as time of the first run.
        """
        if run.compensated in self.compiled:
            return
        problem, method = self.task.problem, self.task.method
        with cpu_time() as spent:
            interruptible(lambda: advance(problem, method, advance(problem, method, run, chunks=0), chunks=0))
        self.compiled.add(run.compensated)
        self.compile_seconds += spent.seconds

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
        """The estimated error of the last run, with a quarter of a rounding a step where these aren't kept."""
        found = estimated_error(self.trials, self.order, exact=self.exact)
        kept = self.exact or not self.runs or self.runs[-1].compensated
        return found if kept else max(found, UNIT * self.runs[-1].total / 4)

    def stuck(self) -> bool:
        """Whether the differences have come down to rounding; an exact method's are never anything else."""
        if self.exact and len(self.trials) >= ROUNDED and not any(run.ended for run in self.runs):
            return True
        if len(self.trials) < 4 or any(run.ended for run in self.runs):
            return False
        before, last = self.trials[-2].difference, self.trials[-1].difference
        return before < PLATEAU and last > 0.5 * before

    def ends(self) -> bool:
        """Whether runs agree up to one time and not much further, however small the steps: the orbit ends there."""
        if not self.agreed or not 0 < self.agreed[-1] < self.task.samples:
            return False
        count = STUBBORN if self.agreed[-1] > 1 else FROM_THE_BEGINNING
        if self.trials[-1].steps < TRIED:
            return False
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
