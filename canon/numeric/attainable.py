"""How exact a run in double precision can be at all: what one rounding of its initial state grows to."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import numpy as np

from canon.interruption import interruptible
from canon.numeric.integrate import advance
from canon.numeric.precision import UNIT
from canon.numeric.run_difference import distance
from canon.numeric.step_search import FIRST_STEPS, Task

MOVED: Final = 1e-7
"""By this part the initial state is moved: far above rounding, and small beside what is curved."""
FINER: Final = 8
"""Times as many steps as the first run of a search: enough for how neighbours part, to a factor of two or three."""
MOST: Final = 200_000
"""Steps of such a run, at most."""


def attainable(task: Task) -> float | None:
    """The relative error at the end that the rounding of the initial state alone makes; None where it can't be seen.

    Two runs of few steps, one from a state of which each component is moved by a part of 10⁻⁷, up and down by turns:
    what they are apart at most, per part that they were moved by, times the unit roundoff.
    """
    steps = min(FINER * max(task.samples - 1, FIRST_STEPS), MOST)
    first = interruptible(lambda: _run(task, steps))
    other = interruptible(lambda: _run(replace(task, state=_moved(task.state)), steps))
    if first.completed < task.samples or other.completed < task.samples:
        return None
    apart = distance(first, other)
    return UNIT * max(apart / MOVED, 1.0) if np.isfinite(apart) else None


def _run(task: Task, steps: int) -> Any:
    return advance(task.problem, task.method, task.begin(steps, None))


def _moved(state: Any) -> Any:
    """The state with every component moved, those that are 0 as far as the largest of their slot."""
    import jax

    def moved(x: Any) -> Any:
        x = np.asarray(x, dtype=float)
        sizes = np.where(x != 0, np.abs(x), np.abs(x).max(initial=0.0))
        return x + MOVED * sizes * np.resize([1.0, -1.0], x.size).reshape(x.shape)

    return jax.tree.map(moved, state)
