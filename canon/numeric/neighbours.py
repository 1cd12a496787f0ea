"""Neighbours of an orbit that was made by steps of equal time: what these very steps do to them.

A method whose steps are others has a `neighbours` of its own (`canon.numeric.regularised_neighbours`), of this shape.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from canon.numeric.transport import flow_jacobian, shifted, transported, transported_along

Array = np.ndarray


class Neighbours(Protocol):
    """The flow of a run, from its first state to its last, at other points of phase space."""

    def jacobian(self, q: Array, p: Array) -> Array:
        """Its derivative M (N, N) at (q, p)."""
        ...

    def along(self, points: Array, samples: int) -> Array:
        """Phase points (k, N) at `samples` equidistant times (samples, k, N), both ends included; nan where lost."""
        ...

    def back(self, points: Array) -> Array:
        """Phase points (k, N) of the end, at the beginning."""
        ...

    def shifted(self, points: Array, late: Array, steps: int) -> Array:
        """Phase points (k, N) of the end, each after a time (k,) of its own in so many steps."""
        ...


@dataclass(frozen=True)
class BySteps:
    """`steps` of length `h` from t0 by a `method` that solves the `problem`; the first slot has `first` entries."""

    problem: Any
    method: Any
    steps: int
    h: float
    t0: float
    first: int

    def jacobian(self, q: Array, p: Array) -> Array:
        """As `Neighbours` says."""
        return flow_jacobian(self.problem, self.method, q, p, steps=self.steps, h=self.h, t0=self.t0)

    def along(self, points: Array, samples: int) -> Array:
        """As `Neighbours` says."""
        return transported_along(
            self.problem, self.method, points, steps=self.steps, duration=self.steps * self.h, t0=self.t0,
            samples=samples, first=self.first,
        )  # fmt: skip

    def back(self, points: Array) -> Array:
        """As `Neighbours` says."""
        end, span = self.t0 + self.steps * self.h, -self.steps * self.h
        return transported(
            self.problem, self.method, points, steps=self.steps, duration=span, t0=end, first=self.first
        )  # fmt: skip

    def shifted(self, points: Array, late: Array, steps: int) -> Array:
        """As `Neighbours` says."""
        end = self.t0 + self.steps * self.h
        return shifted(self.problem, self.method, points, late, steps=steps, t0=end, first=self.first)
