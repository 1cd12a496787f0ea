"""What a search for a step will do, foreseen from short runs: its runs with twice as many steps each, and their time.

A run of n steps takes a + b n: what every run takes (to be begun, watched and compared) and what every step takes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Final

import numpy as np

from canon.numeric.convergence import LEAST, reaches
from canon.numeric.integrate import LONG_RUN, divided
from canon.numeric.progress import Trial
from canon.numeric.step_search import FINER, MOST_STEPS

SHARE: Final = math.sqrt(2) - 1
"""Of the time of a single run what is taken for the time of its steps: of twice the steps it makes √2 times the time,
half-way by factors between what does not grow and what grows as they do."""


@dataclass(frozen=True)
class Costs:
    """CPU seconds of a run, whatever its steps, and of each step; `kept` times those of a step where the rounding of
    additions is kept, as it is in long runs.
    """

    per_run: float
    per_step: float
    kept: float = 1.0

    def seconds(self, steps: float) -> float:
        """Of a run of so many steps."""
        return self.per_run + self.per_step * steps * (self.kept if steps >= LONG_RUN else 1.0)

    def steps(self, seconds: float) -> float:
        """Of a run of so many seconds: one, at least."""
        plain = (seconds - self.per_run) / max(self.per_step, 1e-12)
        return max(plain if plain < LONG_RUN else max(plain / self.kept, LONG_RUN), 1.0)


def costs_of(trials: Sequence[Trial]) -> Costs:
    """What runs with these steps and seconds tell of a and b: those of least Σ |log(t/(a + b n))|, which a run that was
    slow by chance does not move far. Such a line goes through two of the points, or has a = 0 or b = 0.
    """
    points = [(trial.steps, max(trial.seconds, 1e-9)) for trial in trials]
    if len(points) == 1:
        ((n, t),) = points
        return Costs(t * (1 - SHARE), t * SHARE / n)
    lines = [line for n, t in points for line in ((t, 0.0), (0.0, t / n))]
    for (n, t), (m, u) in combinations(points, 2):
        slope = (u - t) / (m - n) if m != n else 0.0
        lines.append((t - slope * n, slope))
    sound = [(a, b) for a, b in lines if a >= 0 and b >= 0]
    best = min(sound, key=lambda line: sum(abs(math.log(t / (line[0] + line[1] * n))) for n, t in points))
    return Costs(*best)


def runs_to_come(
    trials: Sequence[Trial],
    whole: float,
    order: int,
    accuracy: float,
    *,
    first: int,
    samples: int,
    costs: Costs,
    growth: float = 1.0,
) -> list[Trial]:
    """The runs of a search for the accuracy, each with its steps, its difference from the one before, and its seconds.

    **Arguments:** `trials`, runs of a part of the duration with twice as many steps each, of which `whole` such parts
    make all: errors grow with time, to the power of `growth`; `first`, the steps of the search's first run.

    **Returns:** the runs up to the one that reaches the accuracy; none where that takes more steps than are ever made.
    """
    found = list[Trial]()
    for steps in _counts(first, samples):
        off = _difference(trials, steps / whole, order) * whole**growth if found else math.inf
        found.append(Trial(steps, off, costs.seconds(steps)))
        if reaches(found, order, accuracy):
            return found
    return []


def _counts(first: int, samples: int) -> Iterator[int]:
    """The numbers of steps of a search, as its runs round them."""
    steps = first
    while steps <= MOST_STEPS:
        per_sample, per_chunk = divided(steps, samples)
        yield per_sample * per_chunk * (samples - 1)
        steps = FINER * per_sample * per_chunk * (samples - 1)


def _difference(trials: Sequence[Trial], steps: float, order: int) -> float:
    """How far a run with so many steps is from one with half as many: between trials by powers, beyond by the order."""
    seen = [(math.log(t.steps), math.log(max(t.difference, LEAST))) for t in trials if math.isfinite(t.difference)]
    x, (first, last) = math.log(steps), (seen[0], seen[-1])
    if first[0] <= x <= last[0]:
        at, values = zip(*seen, strict=True)
        return float(np.exp(np.interp(x, at, values)))
    at, value = first if x < first[0] else last
    return math.exp(min(value - order * (x - at), 700.0))
