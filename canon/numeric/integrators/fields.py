"""The whole vector field of a problem, from whatever form it has."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from canon.errors import InputError
from canon.numeric.integrators.problem import ExactPart, Field, Shear, Splitting, State


def as_field(problem: Any, name: str) -> Field:
    """The field of a `Field` or a `Splitting`: the sum of its parts' rates, each at the present time.

    **Raises:** `InputError`, which names the method, for anything else.
    """
    if isinstance(problem, Field):
        return problem
    if not isinstance(problem, Splitting):
        raise InputError(
            f"{name} takes a vector field, or a problem that is split into parts; this is neither. Constraints are for "
            f"rattle_6"
        )
    rates = [_shear_rate(part) if isinstance(part, Shear) else _flow_rate(part) for part in problem.parts]

    def rate(state: State, t: Any) -> State:
        import jax

        total = rates[0](state, t)
        for other in rates[1:]:
            total = jax.tree.map(lambda x, y: x + y, total, other(state, t))
        return total

    return Field(rate, autonomous=problem.clock is None)


def hamiltonian_field(H: Callable[..., Any], *, time_dependent: bool = False) -> Field:
    """(∂H/∂p, −∂H/∂q) of a function H(q, p), or H(q, p, t), that jax can differentiate; arrays (n,) or (n, orbits)."""

    def rate(state: State, t: Any) -> State:
        import jax
        import jax.numpy as jnp

        def total(q: Any, p: Any) -> Any:
            return jnp.sum(H(q, p, t) if time_dependent else H(q, p))

        by_q, by_p = jax.grad(total, argnums=(0, 1))(*state)
        return by_p, -by_q

    return Field(rate, autonomous=not time_dependent)


def _shear_rate(part: Shear) -> Callable[[State, Any], State]:
    def rate(state: State, t: Any) -> State:
        import jax
        import jax.numpy as jnp

        moved = dict(zip(part.slots, part.rate(state, t), strict=True))
        return tuple(moved.get(k, jax.tree.map(jnp.zeros_like, slot)) for k, slot in enumerate(state))

    return rate


def _flow_rate(part: ExactPart) -> Callable[[State, Any], State]:
    """The derivative of the flow at length 0."""

    def rate(state: State, t: Any) -> State:
        import jax
        import jax.numpy as jnp

        def after(h: Any) -> State:
            lengths = jnp.asarray(h)[None]
            prepared = lengths if part.prepare is None else part.prepare(lengths)
            return part.flow(state, jax.tree.map(lambda table: table[0], prepared), t)

        return jax.jvp(after, (0.0,), (1.0,))[1]

    return rate
