"""The flow that monitors look at: the model, and the very steps with which its states were computed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from canon.numeric.integrate import Run
from canon.numeric.integrators.strings import Events, events_in
from canon.numeric.neighbours import BySteps, Neighbours
from canon.scenes.model import Model


@dataclass(frozen=True)
class Flow:
    """A run with the problem and method that made it; `good` counts its samples that can be trusted, and `error` is the
    estimated error of its states, None if unknown. `closed`: the steps are elliptic functions, whose derivative is
    taken by differences, and `closed_parts` says so of each independent part. `operations`: of one step.
    """

    model: Model
    problem: Any
    method: Any
    run: Run
    good: int
    error: float | None
    closed: bool = False
    operations: int = 1
    closed_parts: tuple[bool, ...] = ()

    @property
    def steps(self) -> int:
        """The steps from the beginning to the last stored state."""
        if self.run.taken is not None:
            return self.run.taken
        return (self.good - 1) * self.run.per_sample * self.run.per_chunk

    def divides(self, parts: int) -> bool:
        """Whether states are to be had at as many parts of the time between two stored ones."""
        return self.run.taken is not None or self.run.per_sample * self.run.per_chunk % parts == 0

    @property
    def followed(self) -> bool:
        """Whether neighbours of the orbit can be carried along by the steps that made it."""
        return self.run.taken is None or hasattr(self.method, "neighbours")

    @cached_property
    def neighbours(self) -> Neighbours:
        """What the steps that made the orbit do to others beside it."""
        run, own = self.run, getattr(self.method, "neighbours", None)
        if own is not None:
            return own(run.t0, float(run.times[self.good - 1]) - run.t0)
        return BySteps(self.problem, self.method, max(self.steps, 1), run.step, run.t0, self.model.n)

    @property
    def events(self) -> Events | None:
        """What became of strings; None where there are none."""
        if self.model.beside:
            return next((part.flow.events for part in self.beside if part.model.strings), None)
        return events_in(self.run.carry)

    @cached_property
    def beside(self) -> tuple[Part, ...]:
        """The flows of the model's independent parts, each with where its rows of q and p begin."""
        found, first = list[Part](), (0, 0)
        methods = getattr(self.method, "methods", ())
        for k, (model, problem, method) in enumerate(
            zip(self.model.beside, self.problem.problems, methods, strict=True)
        ):
            after = first[0] + len(model.q), first[1] + len(model.p)
            stored = tuple(rows[:, a:b] for rows, a, b in zip(self.run.stored, first, after, strict=True))
            run = replace(self.run, carry=self.run.carry[k], stored=stored)
            closed = self.closed_parts[k] if self.closed_parts else False
            found.append(
                Part(
                    replace(self, model=model, problem=problem, method=method, run=run, closed=closed, closed_parts=()),
                    first,
                )
            )
            first = after
        return tuple(found)

    @cached_property
    def jacobian(self) -> np.ndarray:
        """The derivative (N, N) of the flow from the first stored state to the last: two monitors look at it."""
        q, p = (np.asarray(slot)[0] for slot in self.run.stored)
        return self.neighbours.jacobian(q, p)


class Part(NamedTuple):
    """The `flow` of an independent part of a model, and where its `rows` of q and of p begin."""

    flow: Flow
    rows: tuple[int, int]

    @property
    def model(self) -> Model:
        """Its model."""
        return self.flow.model
