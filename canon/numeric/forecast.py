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


@dataclass(frozen=True)
class Forecast:
    """Of a run with so many `steps`: the `error` that was expected, None where no order was seen yet, and `seconds`."""

    steps: int
    error: float | None
    seconds: float


def forecast_of(trials: Sequence[Trial], order: int | None) -> Forecast | None:
    """What was to be expected of the last trial when it began; None where there was nothing to go by.

    Its time is that of the trial before, step for step. The error of that one, d/(r^order − 1) from the difference d to
    the one before it with r times fewer steps, falls as the order says, down to rounding; `order` is None where steps
    make no error.
    """
    if len(trials) < 2:
        return None
    before, last = trials[-2:]
    seconds = before.seconds * last.steps / max(before.steps, 1)
    if order is None or len(trials) < 3 or not math.isfinite(before.difference):
        return Forecast(last.steps, None, seconds)
    ratio = before.steps / trials[-3].steps
    error = before.difference / (ratio**order - 1) if ratio > 1 else before.difference
    rounding = UNIT * last.steps**GROWTH
    return Forecast(last.steps, error * (before.steps / last.steps) ** order + rounding, seconds)


def digit_factor(order: int | None) -> float | None:
    """The factor in time of one digit more by a method of that order, 10^(1/order); None where steps make no error."""
    return None if not order else 10 ** (1 / order)
