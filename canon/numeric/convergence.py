"""What runs with more and more steps say of the last one: whether the order of the method shows, and its error.

The search for a step goes by it, and so does who foresees that search. Hairer, Nørsett and Wanner (1993), Solving
Ordinary Differential Equations I, II.4.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

from canon.numeric.progress import Trial

AIM: Final = 0.25
"""The part of the accuracy that is aimed at: estimates are no bounds."""
LEAST: Final = 2.0**-52
ROUNDED: Final = 4
"""Runs of a method that makes no error but rounding, after which more of them tell no more."""


def in_order(trials: Sequence[Trial], order: int) -> bool:
    """Whether the last two differences fall as the order says they should, or by one order less."""
    if len(trials) < 3 or not 0 < trials[-1].difference < trials[-2].difference < math.inf:
        return False
    first, before, last = trials[-3:]
    # d(N, M) ≈ C N^-r for M well above N: the step of the coarser run of each pair
    return math.log(before.difference / last.difference) > (order - 1) * math.log(before.steps / first.steps)


def estimated_error(trials: Sequence[Trial], order: int, *, exact: bool = False) -> float:
    """The error of the last run: its difference d to the one with r times fewer steps, over r^order − 1 where the order
    shows and the method makes errors other than rounding (`exact`: it does not); infinite where there is no other run.

    Runs of an exact method that still differ after a few are apart by rounding. It may drown more of the motion the
    shorter the steps are, so that they agree on a wrong state in the end: the largest difference is taken then.
    """
    if len(trials) < 2:
        return math.inf
    if exact and len(trials) >= ROUNDED:
        return max(LEAST, *(trial.difference for trial in trials[1:]))
    before, last = trials[-2:]
    if exact or not math.isfinite(last.difference) or not in_order(trials, order):
        return max(last.difference, LEAST)
    return max(last.difference / ((last.steps / before.steps) ** order - 1), LEAST)


def reaches(trials: Sequence[Trial], order: int, accuracy: float, *, exact: bool = False) -> bool:
    """Whether the last run is estimated to be as accurate as asked for, with a factor 2 to spare where steps count."""
    return estimated_error(trials, order, exact=exact) <= accuracy * (1 if exact else 2 * AIM)
