"""The states that a figure shows: where lines between the stored ones would have corners, states between them, too.

They are those of the same steps, made once more. The stored states, and what is printed and written, stay as they are.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from canon.interruption import interruptible
from canon.numeric.integrate import integrate
from canon.scenes.simulate import AS_A_WHOLE, Result

CORNER: Final = 0.12
"""Radians by which a line may turn at a state, at nine states in ten, and still look smooth."""
POINTS: Final = 6000
LONGEST: Final = 3.0
"""Seconds of a run that is made again for a figure, at most."""


def drawn(result: Result) -> Result:
    """The result with more states, where a drawing takes them; itself where they would cost much, or it was left."""
    run, planned = result.planned.run, result.planned
    exact, between = result.problem.exact, run.per_sample * run.per_chunk
    finest = max(POINTS // max(run.samples - 1, 1), 1)
    finer = finest if exact else max(k for k in range(1, finest + 1) if between % k == 0)
    seconds = max((trial.seconds for trial in planned.trials), default=0.0)
    if (
        finer == 1
        or planned.interrupted
        or planned.good < run.samples
        or result.scene.settings.integrator in AS_A_WHOLE
        or run.taken is not None
        or result.scene.model.strings
        or seconds > LONGEST
        or not _cornered(np.hstack([result.q, result.p]))
    ):
        return result
    state = (np.array(result.scene.q), np.array(result.scene.p))
    samples = (run.samples - 1) * finer + 1
    try:
        again = interruptible(
            lambda: integrate(
                result.problem.value, result.choice.method, state, duration=run.duration,
                steps=max(run.total, samples - 1), samples=samples, t0=run.t0, compensated=run.compensated,
            )
        )  # fmt: skip
    except KeyboardInterrupt:
        return result
    if again.completed < samples:
        return result
    q, p = (np.asarray(slot) for slot in again.states)
    return replace(result, times=again.times, q=q, p=p)


def _cornered(rows: np.ndarray) -> bool:
    """Whether the line through the states, each variable as large as any other, turns visibly at one in ten."""
    sizes = np.ptp(rows, axis=0)
    steps = np.diff(rows[:, sizes > 0] / sizes[sizes > 0], axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    moving = lengths > 0
    steps, lengths = steps[moving], lengths[moving]
    if len(steps) < 2:
        return False
    cosines = np.einsum("ij,ij->i", steps[1:], steps[:-1]) / (lengths[1:] * lengths[:-1])
    return bool(np.quantile(np.arccos(np.clip(cosines, -1, 1)), 0.9) > CORNER)
