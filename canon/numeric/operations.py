"""Counts what a step of an integrator computes: the arithmetic operations of its program, loops multiplied out."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method, Time
from canon.numeric.precision import double

_FREE: Final = frozenset({
    "broadcast_in_dim", "reshape", "squeeze", "slice", "dynamic_slice", "gather", "concatenate", "convert_element_type",
    "copy", "transpose", "stop_gradient", "select_n", "iota", "expand_dims", "rev", "pad", "split",
})  # fmt: skip
"""What moves numbers about without computing any."""


def operations_per_step(problem: Any, method: Method, state: State, *, compensated: bool = False) -> int:
    """Arithmetic operations on numbers in one step: an operation on an array of k numbers counts k times.

    A loop whose number of turns is not known in advance (an iteration) is counted once.
    """
    import jax
    import jax.numpy as jnp

    with double():
        stepper = method.stepper(problem, compensated=compensated)
        state = jax.tree.map(lambda x: jnp.asarray(x, dtype=float), state)
        first = Time(0.0, 0.01, 0.0)
        # shapes alone: computed one by one, what is prepared would be compiled operation by operation
        tables = jax.eval_shape(stepper.prepare, 0.01)
        carry = jax.eval_shape(lambda z, made: stepper.begin(stepper.initial(z), made, first), state, tables)
        # the tables are arguments: what is prepared outside the loop is no part of a step
        traced = jax.make_jaxpr(lambda c, made, k: stepper.step(c, made, Time(0.0, 0.01, k)))(carry, tables, 0.0)
    return count_operations(traced.jaxpr)


def count_operations(jaxpr: Any) -> int:
    """The operations of a jaxpr, those inside its loops and calls included."""
    total = 0
    for equation in jaxpr.eqns:
        inner = [_jaxpr_of(value) for value in equation.params.values()]
        inner = [found for found in inner if found is not None]
        if equation.primitive.name == "scan":
            total += int(equation.params["length"]) * sum(map(count_operations, inner))
        elif inner:
            total += sum(map(count_operations, inner))
        elif equation.primitive.name not in _FREE:
            total += max(int(np.prod(out.aval.shape)) for out in equation.outvars)
    return total


def _jaxpr_of(value: Any) -> Any:
    found = getattr(value, "jaxpr", value)
    return found if hasattr(found, "eqns") else None
