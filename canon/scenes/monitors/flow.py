"""The flow that monitors look at: the model, and the very steps with which its states were computed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from canon.numeric.integrate import Run
from canon.numeric.integrators.strings import Events, events_in
from canon.numeric.transport import flow_jacobian
from canon.scenes.model import Model


@dataclass(frozen=True)
class Flow:
    """A run with the problem and method that made it; `good` counts its samples that can
    be trusted, and `error` is the estimated error of its states, None if unknown. `closed`: the steps are elliptic
    functions, whose derivative is taken by differences. `operations`: of one step."""

    model: Model
    problem: Any
    method: Any
    run: Run
    good: int
    error: float | None
    closed: bool = False
    operations: int = 1

    @property
    def steps(self) -> int:
        """The steps from the beginning to the last stored state."""
        return (self.good - 1) * self.run.per_sample * self.run.per_chunk

    @property
    def events(self) -> Events | None:
        """What became of strings; None where there are none."""
        return events_in(self.run.carry)

    @cached_property
    def jacobian(self) -> np.ndarray:
        """The derivative (N, N) of the flow from the first stored state to the last: two monitors look at it."""
        q, p = (np.asarray(slot)[0] for slot in self.run.stored)
        steps = max(self.steps, 1)
        return flow_jacobian(self.problem, self.method, q, p, steps=steps, h=self.run.step, t0=self.run.t0)
