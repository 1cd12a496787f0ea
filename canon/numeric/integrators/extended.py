"""Explicit symplectic integration of any H(q, p, t) in an extended phase space.

Two copies (q, p) and (x, y) are bound by ω((q − x)² + (p − y)²)/2; H(q, y), H(x, p) and the binding are each solved
exactly. It is symplectic in the doubled space, and there alone: of the copies' difference nothing is kept.
Tao (2016), Phys. Rev. E 94, 043303; Pihajoki (2015), Celest. Mech. Dyn. Astron. 121, 211.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from canon.numeric.integrators.problem import ExactPart, Shear, Splitting, State
from canon.numeric.integrators.problem import clock_part as clock


def extended(H: Callable[..., Any], omega: float, *, time_dependent: bool = False) -> Splitting:
    """The splitting of H(q, p), or H(q, p, t), on slots (q, p, x, y), for splitting methods of any kind.

    **Arguments:** `H`, a function of arrays (n, …) that jax can differentiate; `omega` ω, the binding's frequency:
    larger than the copies' rate of separation, and with ωh well below 1.
    """

    def slopes(q: Any, p: Any, t: Any) -> Any:
        import jax
        import jax.numpy as jnp

        return jax.grad(lambda a, b: jnp.sum(H(a, b, t) if time_dependent else H(a, b)), argnums=(0, 1))(q, p)

    def first(state: State, t: Any) -> tuple[Any, Any]:
        by_q, by_p = slopes(state[0], state[3], t)
        return -by_q, by_p

    def second(state: State, t: Any) -> tuple[Any, Any]:
        by_q, by_p = slopes(state[2], state[1], t)
        return by_p, -by_q

    def prepare(lengths: Any) -> Any:
        import jax.numpy as jnp

        return jnp.cos(2 * omega * lengths), jnp.sin(2 * omega * lengths)

    def bind(state: State, turn: Any, t: Any) -> State:
        (q, p, x, y, *others), (c, s) = state, turn
        u, v = q - x, p - y
        u, v = c * u + s * v, c * v - s * u
        return ((q + x + u) / 2, (p + y + v) / 2, (q + x - u) / 2, (p + y - v) / 2, *others)

    parts = (ExactPart(bind, prepare, "binding"), Shear((1, 2), first, "H(q, y)"), Shear((0, 3), second, "H(x, p)"))
    return Splitting((clock(), *parts), 0) if time_dependent else Splitting(parts)


def extend(state: State) -> State:
    """(q, p) to (q, p, q, p)."""
    q, p = state
    return q, p, q, p


def project(state: State) -> State:
    """The copies' mean."""
    q, p, x, y = state[:4]
    return (q + x) / 2, (p + y) / 2


def separation(state: State) -> Any:
    """How far the copies are apart, in the largest component: where it grows, the result means nothing."""
    import jax.numpy as jnp

    q, p, x, y = state[:4]
    return jnp.maximum(jnp.max(jnp.abs(q - x)), jnp.max(jnp.abs(p - y)))
