"""Linear friction as a part of a splitting, solved exactly: it acts on the momentum that a body has beyond rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sp

from canon.numeric.integrators.problem import ExactPart, State
from canon.numeric.lower import lower


def friction_part(
    matrix: Any, rest: Sequence[sp.Expr], q: Sequence[sp.Symbol], t: sp.Symbol, name: str = "damping"
) -> ExactPart:
    """The flow of ṗ = −D (p − s(q, t)) on slots (q, p), arrays (n, …): p ↦ s + exp(−h D)(p − s).

    **Arguments:** `matrix` D (n, n), diagonalisable; `rest` s (n,), the momentum at rest: q A in a magnetic field,
    m Ω × x in a rotating frame; nothing is computed for it where it is 0. exp(−h D) − 1 is what is kept: a factor near
    1 would be rounded the same way in every step. With a Hamiltonian flow beside it, the method
    is conformal symplectic for D = 2λ. McLachlan and Perlmutter (2001), J. Geom. Phys. 39, 276.
    """
    D = np.asarray(matrix, dtype=float)
    diagonal = bool(np.all(np.diag(np.diag(D)) == D))
    values, vectors = (np.diag(D), np.eye(len(D))) if diagonal else np.linalg.eig(D)
    left, right = np.real_if_close(vectors), np.real_if_close(np.linalg.inv(vectors))
    moving = any(value != 0 for value in rest)
    lowered = lower(tuple(rest), (*q, t)) if moving else None

    def prepare(lengths: Any) -> Any:
        import jax.numpy as jnp

        decay = jnp.expm1(-jnp.asarray(lengths)[:, None] * values)
        return decay if diagonal else jnp.real(jnp.einsum("ik,sk,kj->sij", left, decay, right))

    def damped(p: Any, factor: Any) -> Any:
        import jax.numpy as jnp

        if diagonal:
            return factor.reshape(-1, *(1,) * (p.ndim - 1)) * p
        return jnp.tensordot(factor, p, axes=1)

    def flow(state: State, factor: Any, now: Any) -> State:
        import jax.numpy as jnp

        x, p = state
        if lowered is None:
            return (x, p + damped(p, factor))
        s = jnp.stack(
            [jnp.broadcast_to(jnp.asarray(v, p.dtype), p.shape[1:]) for v in lowered(*x, 0.0 if now is None else now)]
        )
        return (x, p + damped(p - s, factor))

    return ExactPart(flow, prepare, name, hamiltonian=False)
