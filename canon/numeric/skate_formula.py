"""Bodies on skates, from formulas to functions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from canon.numeric.integrators.parts import damping_part
from canon.numeric.integrators.problem import Part, Shear, Splitting, State
from canon.numeric.integrators.skate import Gliding, gliding_part
from canon.numeric.lower import lower


def gliding_bodies(
    bodies: Sequence[Gliding], forces: Sequence[sp.Expr], symbols: Sequence[sp.Symbol], rates: Sequence[float] | None
) -> Splitting:
    """The free motion, kicks ṗ = F(q, t), one for each entry of p, and ṗ = −2 rate p where there are `rates`.

    **Arguments:** `symbols` are those of q, and t last.
    """
    parts: list[Part] = [gliding_part(bodies)]
    if rates is not None:
        parts.append(damping_part(rates))
    if all(force == 0 for force in forces):
        return Splitting(tuple(parts))
    lowered = lower(tuple(forces), tuple(symbols))

    def kick(state: State, now: Any) -> tuple[Any]:
        import jax.numpy as jnp

        q, p = state[0], state[1]
        values = lowered(*q, 0.0 if now is None else now)
        return (jnp.stack([jnp.broadcast_to(jnp.asarray(value, p.dtype), p.shape[1:]) for value in values]),)

    timed = any(symbols[-1] in force.free_symbols for force in forces)
    parts.append(Shear((1,), kick, "forces along the headings"))
    # the free motion moves q alone and is linear in p: three kicks and it commute, as for T(p) + V(q)
    return Splitting(tuple(parts), 0 if timed else None, nystrom=len(parts) == 2)
