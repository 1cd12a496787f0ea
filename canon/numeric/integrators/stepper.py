"""The one shape in which every integrator is run: prepared tables, a step, and what begins and ends a run of steps."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple, Protocol

from canon.numeric.integrators.problem import State
from canon.numeric.integrators.traits import Traits


class Time(NamedTuple):
    """The time of step k of length h is t0 + k·h: it is computed, not accumulated."""

    t0: Any
    h: Any
    k: Any

    def at(self, fraction: Any) -> Any:
        """The time at a fraction of this step."""
        return self.t0 + (self.k + fraction) * self.h


class Past(NamedTuple):
    """So many `steps` into the past, of length −h, by another `stepper`; then `begin` takes a carry, the states there
    (steps + 1, …), the present one first, and the time to the carry that has begun. `wanted` says whether one has not,
    and `marked` gives a carry the whole numbers of one that has.
    """

    stepper: Stepper
    steps: int
    begin: Callable[[Any, State, Time], Any]
    wanted: Callable[[Any], bool]
    marked: Callable[[Any], Any]


class Stepper(NamedTuple):
    """An integrator set up for one problem. Its carry goes from step to step: the state, and what is kept with it.

    `begin` and `end` bracket a run of steps: a method whose last substep is the next step's first joins the two
    between them. All are functions that jax can trace.
    """

    prepare: Callable[[Any], Any]
    """h to the tables that the steps use."""
    initial: Callable[[State], Any]
    """A state to a carry."""
    begin: Callable[[Any, Any, Time], Any]
    """(carry, tables, time) to a carry."""
    step: Callable[[Any, Any, Time], Any]
    end: Callable[[Any, Any, Time], Any]
    read: Callable[[Any], State]
    """A carry, after `end`, to its state."""
    straight: Stepper | None = None
    """The same for native code, where that is better off with another order of what is remembered."""
    past: Past | None = None
    """How `begin` finds what it needs to know of the past, where that can be done apart."""


class Method(Protocol):
    """An integrator: an immutable value with a name, measured traits and a source."""

    @property
    def name(self) -> str: ...
    @property
    def traits(self) -> Traits: ...
    @property
    def source(self) -> str: ...
    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The method set up for a problem. **Raises:** `InputError` where it cannot solve such a problem."""
        ...


@lru_cache(maxsize=128)
def stepper_of(method: Method, problem: Any, compensated: bool) -> Stepper:
    """The method's stepper for a problem, made once."""
    return method.stepper(problem, compensated=compensated)


def plain_stepper(step: Callable[[State, Any, Any], State]) -> Stepper:
    """A stepper from a map (state, t, h) -> state that needs no tables and keeps nothing."""
    return Stepper(
        prepare=lambda h: None,
        initial=lambda state: state,
        begin=lambda carry, tables, time: carry,
        step=lambda carry, tables, time: step(carry, time.at(0.0), time.h),
        end=lambda carry, tables, time: carry,
        read=lambda carry: carry,
    )
