"""A mechanical system with holonomic constraints, from formulas to functions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from canon.numeric.gradient import gradient
from canon.numeric.integrators.rattle import Constrained, check_on_surface
from canon.numeric.lower import lower
from canon.numeric.precision import double


def constrained(
    mass: Sequence[float], V: sp.Expr, constraints: Sequence[sp.Expr], q: Sequence[sp.Symbol], t: sp.Symbol
) -> Constrained:
    """H = Σ p²/2m + V(q, t) on the surface where all `constraints` g(q, t) vanish; `mass` and `q` have n entries."""
    forces = lower(tuple(-slope for slope in gradient(V, tuple(q))), (*q, t))
    surfaces = lower(tuple(constraints), (*q, t))

    def force(x: Any, now: Any) -> Any:
        import jax.numpy as jnp

        return jnp.stack([jnp.broadcast_to(jnp.asarray(v, x.dtype), x.shape[1:]) for v in forces(*x, now)])

    moving = any(t in g.free_symbols for g in constraints)
    return Constrained(tuple(map(float, mass)), force, lambda x, now: surfaces(*x, now), moving)


def faults_at(problem: Constrained, q: Sequence[float], p: Sequence[float], t: float) -> Sequence[str]:
    """What is wrong with a state: that it is not on the surface, or does not move along it."""
    import jax.numpy as jnp

    with double():
        return check_on_surface(problem, jnp.asarray(q, dtype=float), jnp.asarray(p, dtype=float), t)
