"""What an integrator is given: a vector field, whole or as a sum of parts that can each be solved exactly.

A state is a tuple of slots, (q, p) for most problems; a slot is an array, or a tuple of arrays, whose first axis counts
coordinates. With many orbits at once each array has one more axis, the last, which counts orbits (a structure of
arrays). Functions of a state are written for one orbit and work elementwise on the last axis.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

State = tuple[Any, ...]


@dataclass(frozen=True)
class Shear:
    """A part whose own flow leaves its vector field constant, so that z ↦ z + h·rate(z, t) solves it exactly.

    T(p) and V(q) are the examples. `rate(state, t)` returns one value for each of the `slots` that it moves.
    """

    slots: tuple[int, ...]
    rate: Callable[[State, Any], tuple[Any, ...]]
    name: str = ""
    hamiltonian: bool = True


@dataclass(frozen=True)
class ExactPart:
    """A part with a closed flow: `flow(state, prepared, t)` solves it over one substep.

    `prepare` takes the lengths of all substeps (s,) to what the flow needs of them, with s as the first axis of every
    array, such as cosines and sines: it is computed once, outside all loops. Left out, the flow gets the length itself.
    """

    flow: Callable[[State, Any, Any], State]
    prepare: Callable[[Any], Any] | None = None
    name: str = ""
    hamiltonian: bool = True


Part = Shear | ExactPart


@dataclass(frozen=True)
class Splitting:
    """ż = X_1(z, t) + … + X_N(z, t), with parts that are each solved exactly at a frozen time.

    The first part is applied most often at the ends of a step, the last one in the middle: the costliest goes last.
    `clock` is the part that time advances with, and it must not itself depend on time (a `clock_part()` of its own
    where every other one does); None where nothing depends on time, so that no time is computed. `nystrom`: there are
    two parts, the first at most quadratic in p, and V(q, t) last, so that [V,[V,[V,A]]] = 0.
    """

    parts: tuple[Part, ...]
    clock: int | None = None
    nystrom: bool = False


@dataclass(frozen=True)
class Field:
    """ż = rate(state, t): the whole vector field, one value a slot, for integrators that take it whole."""

    rate: Callable[[State, Any], State]
    autonomous: bool = True


def separable(
    velocity: Callable[[Any], Any], force: Callable[..., Any], *, time_dependent: bool = False, nystrom: bool = True
) -> Splitting:
    """H = T(p) + V(q, t) from `velocity(p)` = ∂T/∂p and `force(q)` = −∂V/∂q, or `force(q, t)` where it is
    `time_dependent`. `nystrom` = False where T is not quadratic, as for the relativistic kinetic energy.
    """

    def kick(state: State, t: Any) -> tuple[Any]:
        return (force(state[0], t) if time_dependent else force(state[0]),)

    drift = Shear((0,), lambda state, t: (velocity(state[1]),), "T")
    return Splitting((drift, Shear((1,), kick, "V")), 0 if time_dependent else None, nystrom)


def clock_part() -> ExactPart:
    """The part that only lets time pass."""
    return ExactPart(lambda state, length, t: state, name="t")
