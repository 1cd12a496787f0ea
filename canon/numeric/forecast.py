"""What a search for a step foretells of its last run from the runs before it, and what one digit more would cost."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from canon.numeric.precision import UNIT
from canon.numeric.progress import Trial

GROWTH: Final = 0.75
"""Of rounding with the number of steps: half-way between what is scattered, √N, and what adds up, N."""


LEAST_SHARE: Final = 0.5
"""Of a run's time what is taken for the time of its steps, at least."""


@dataclass(frozen=True)
class Forecast:
    """Of a run with so many `steps`: the `error` that was expected, None where no order was seen yet, and `seconds`."""

    steps: int
    error: float | None
    seconds: float


def forecast_of(trials: Sequence[Trial], order: int | None) -> Forecast | None:
    """What was to be expected of the last trial when it began; None where there was nothing to go by.

    Its time is a + b n for n steps: what every run takes and what every step takes, as the two trials before tell them
    apart (b at least half of what one of them took a step: their times scatter); after a single one it is half-way, by
    factors, between its time and its time for a step. The error of the trial before, d/(r^order − 1) from the
    difference d to the one before it with r times fewer steps, falls as the order says, down to rounding; `order` is
    None where steps make no error.
    """
    if len(trials) < 2:
        return None
    before, last = trials[-2:]
    seconds = _seconds(trials[:-1], last.steps)
    if order is None or len(trials) < 3 or not math.isfinite(before.difference):
        return Forecast(last.steps, None, seconds)
    ratio = before.steps / trials[-3].steps
    error = before.difference / (ratio**order - 1) if ratio > 1 else before.difference
    rounding = UNIT * last.steps**GROWTH
    return Forecast(last.steps, error * (before.steps / last.steps) ** order + rounding, seconds)


def _seconds(trials: Sequence[Trial], steps: int) -> float:
    """What so many steps will take after these trials."""
    last = trials[-1]
    more = steps / max(last.steps, 1)
    if len(trials) < 2 or trials[-2].steps >= last.steps or not last.seconds:
        return last.seconds * math.sqrt(more)
    grown = (last.seconds - trials[-2].seconds) / (1 - trials[-2].steps / last.steps)
    share = min(max(grown / last.seconds, LEAST_SHARE), 1.0)
    return last.seconds * (1 + share * (more - 1))


def digit_factor(order: int | None) -> float | None:
    """The factor in time of one digit more by a method of that order, 10^(1/order); None where steps make no error."""
    return None if not order else 10 ** (1 / order)
