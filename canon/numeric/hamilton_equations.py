"""Hamilton's equations, with friction, as one vector field: for methods that take a field whole."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from canon.numeric.gradient import gradient
from canon.numeric.integrators.problem import Field, State
from canon.numeric.lower import lower


def hamilton_equations(
    H: sp.Expr, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], t: sp.Symbol, force: Sequence[sp.Expr] = ()
) -> Field:
    """q̇ = ∂H/∂p, ṗ = −∂H/∂q + F on slots (q, p), arrays (n, …); `force` is F(q, p, t) (n,), nothing where left out."""
    added = tuple(force) or (sp.S.Zero,) * len(q)
    velocities, slopes = gradient(H, tuple(p)), gradient(H, tuple(q))
    rates = (*velocities, *(F - slope for slope, F in zip(slopes, added, strict=True)))
    lowered = lower(rates, (*q, *p, t))
    count = len(q)

    def rate(state: State, now: Any) -> State:
        import jax.numpy as jnp

        x, y = state
        found = [jnp.broadcast_to(jnp.asarray(v, x.dtype), x.shape[1:]) for v in lowered(*x, *y, now)]
        return jnp.stack(found[:count]), jnp.stack(found[count:])

    return Field(rate, autonomous=not any(t in rate.free_symbols for rate in rates))
