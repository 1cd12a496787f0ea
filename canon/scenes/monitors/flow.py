"""The flow that monitors look at: the model, and the very steps with which its states were computed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from canon.numeric.integrate import Run
from canon.scenes.model import Model


@dataclass(frozen=True)
class Flow:
    """A run with the problem and method that made it; `good` counts its samples that can
    be trusted, and `error` is the estimated error of its states, None if unknown."""

    model: Model
    problem: Any
    method: Any
    run: Run
    good: int
    error: float | None

    @property
    def steps(self) -> int:
        """The steps from the beginning to the last stored state."""
        return (self.good - 1) * self.run.per_sample * self.run.per_chunk
