"""Rigid bodies under torques, from formulas to functions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from canon.numeric.integrators.problem import Splitting
from canon.numeric.integrators.rigid_body import rigid_bodies
from canon.numeric.lower import lower


def rigid_bodies_under(
    torques: Sequence[sp.Expr],
    moments: Sequence[Sequence[float]],
    q: Sequence[sp.Symbol],
    t: sp.Symbol,
    *,
    closed: bool = True,
) -> Splitting:
    """The splitting of bodies with torques K(q, t) (3k,) in their frames, q being the attitudes (4k,), or nothing.
    `closed` as for `rigid_bodies`.

    **Raises:** `InputError` where `moments` are none of a body.
    """
    turning = len(q) > 0
    if all(K == 0 for K in torques):
        return rigid_bodies(moments, attitude=turning, closed=closed)
    lowered = lower(tuple(torques), (*q, t))

    def torque(state: Any, now: Any) -> Any:
        import jax.numpy as jnp

        M = state[1]
        values = lowered(*(state[0] if turning else ()), 0.0 if now is None else now)
        return jnp.stack([jnp.broadcast_to(jnp.asarray(value, M.dtype), M.shape[1:]) for value in values])

    timed = any(t in K.free_symbols for K in torques)
    return rigid_bodies(moments, torque, time_dependent=timed, attitude=turning)
