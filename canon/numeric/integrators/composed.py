"""One-step maps, and symmetric compositions of them to higher order.

Where a method is a map (state, t, h) -> state that is symmetric and of order 2 (the implicit midpoint rule, RATTLE,
Boris's push), its composition over γ_1 h, γ_2 h, … with the coefficients of `compositions` has their order, and keeps
what each step keeps. Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, V.3.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from canon.errors import InputError
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Stepper, plain_stepper
from canon.numeric.integrators.traits import Traits

StepMap = Callable[[State, Any, Any], State]


@dataclass(frozen=True)
class OneStep:
    """A method that is a map of states: `build(problem)` returns it, as a function of (state, t, h)."""

    name: str
    traits: Traits
    build: Callable[[Any], StepMap]
    source: str

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The map set up for a problem; such maps do not keep what their additions round away."""
        return plain_stepper(self.build(problem))


def composed(base: OneStep, gamma: tuple[float, ...], order: int, source: str = "") -> OneStep:
    """The composition of a symmetric map of order 2 over fractions γ of the step, which sum to 1.

    **Raises:** `InputError` where the map isn't symmetric of order 2, or the fractions don't sum to 1.
    """
    if base.traits.order != 2 or base.traits.symmetric is not True:
        raise InputError(f"{base.name} is not a symmetric map of order 2: compositions raise the order of these alone")
    if abs(sum(gamma) - 1) > 1e-14:
        raise InputError("the fractions of a composition sum to 1")
    starts = np.concatenate([[0.0], np.cumsum(gamma)[:-1]])

    def build(problem: Any) -> StepMap:
        step = base.build(problem)

        def stepped(state: State, t: Any, h: Any) -> State:
            import jax.numpy as jnp
            from jax import lax

            fractions, times = jnp.asarray(gamma), jnp.asarray(starts)
            return lax.fori_loop(0, len(gamma), lambda i, z: step(z, t + times[i] * h, fractions[i] * h), state)

        return stepped

    traits = Traits(order, base.traits.symplectic, True, base.traits.volume_preserving)
    return OneStep(f"{base.name}_{order}", traits, build, "; ".join(filter(None, (base.source, source))))
