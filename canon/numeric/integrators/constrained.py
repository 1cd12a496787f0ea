"""Mechanical systems with holonomic constraints: what their methods ask of them, and states on their surfaces.

Slots are (q, p), arrays (n, …). A constraint's force is −λ ∂g/∂q with a multiplier λ of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from canon.numeric.integrators.multipliers import Rows, along, combined, products, solve_active, stacked

MOST_ITERATIONS: Final = 40


@dataclass(frozen=True)
class Drag:
    """The force −D (p − s(q, t)): `matrix` D (n, n), of numbers, and the momentum `rest` s of what is at rest, if it is
    not 0.
    """

    matrix: tuple[tuple[float, ...], ...]
    rest: Callable[[Any, Any], Any] | None = None

    def force(self, q: Any, p: Any, t: Any) -> Any:
        """It, (n, …)."""
        import jax.numpy as jnp

        moving = p if self.rest is None else p - self.rest(q, t)
        return -jnp.tensordot(jnp.asarray(self.matrix), moving, axes=1)


@dataclass(frozen=True)
class Constrained:
    """H = Σ p²/2m + V(q, t), with `mass` of n entries and `force(q, t)` = −∂V/∂q (n, …).

    `constraints(q, t)`: scalars (…), at least one, that vanish on the surface, a tuple or an array (m, …); `moving`:
    they depend on t. Those in `strings` may also be negative; `active` (m,) is 1 for those that act just now, None
    where all do.
    """

    mass: tuple[float, ...]
    force: Callable[[Any, Any], Any]
    constraints: Callable[[Any, Any], Any]
    moving: bool = False
    drag: Drag | None = None
    strings: tuple[int, ...] = ()
    active: Any = None

    def rates(self, q: Any, p: Any, t: Any) -> tuple[Any, Any]:
        """∂H/∂p and −∂H/∂q."""
        return p / self.masses(q), self.force(q, t)

    def masses(self, like: Any) -> Any:
        """The masses in the shape that goes with an array."""
        import numpy as np

        return np.asarray(self.mass).reshape(-1, *(1,) * (like.ndim - 1))

    def pulls(self, q: Any, p: Any, t: Any, rows: Rows) -> Rows:
        """∂²H/∂p² times each row: how a momentum along it moves q."""
        return [row / self.masses(q) for row in rows] if isinstance(rows, list) else rows / self.masses(q)


@dataclass(frozen=True)
class ConstrainedHamiltonian:
    """Any H(q, p, t) by its `hamilton(q, p, t)` = (∂H/∂p, −∂H/∂q), arrays (n, …); `linear`: ∂H/∂p is linear in p."""

    hamilton: Callable[[Any, Any, Any], tuple[Any, Any]]
    constraints: Callable[[Any, Any], Any]
    moving: bool = False
    drag: Drag | None = None
    linear: bool = True
    strings: tuple[int, ...] = ()
    active: Any = None

    def rates(self, q: Any, p: Any, t: Any) -> tuple[Any, Any]:
        """∂H/∂p and −∂H/∂q."""
        return self.hamilton(q, p, t)

    def pulls(self, q: Any, p: Any, t: Any, rows: Rows) -> Rows:
        """∂²H/∂p² times each row."""
        import jax

        def pull(row: Any) -> Any:
            return jax.jvp(lambda y: self.hamilton(q, y, t)[0], (p,), (row,))[1]

        return [pull(row) for row in rows] if isinstance(rows, list) else jax.vmap(pull)(rows)


Held = Constrained | ConstrainedHamiltonian


def gradients(problem: Held, q: Any, t: Any) -> tuple[Any, Rows, Any]:
    """The constraints' values, their gradients (n, …), and their partial derivatives by time: lists, or arrays where
    there are many constraints.
    """
    import jax
    import jax.numpy as jnp

    values = stacked(problem.constraints(q, t))
    if not isinstance(values, list):
        return _many_gradients(problem, q, t)
    # every orbit's constraint depends on its own coordinates alone, so the gradient of the sum is all gradients
    rows = [jax.grad(lambda x, k=k: jnp.sum(problem.constraints(x, t)[k]))(q) for k in range(len(values))]
    rates = [0.0 * value for value in values]
    if problem.moving:
        moment = jnp.asarray(t, dtype=float)
        rates = [*jax.jvp(lambda s: problem.constraints(q, s), (moment,), (jnp.ones_like(moment),))[1]]
    return values, rows, rates


def _many_gradients(problem: Held, q: Any, t: Any) -> tuple[Any, Any, Any]:
    import jax
    import jax.numpy as jnp

    n = len(q)
    values, push = jax.linearize(lambda x: stacked(problem.constraints(x, t)), q)
    ones = jnp.broadcast_to(jnp.eye(n).reshape(n, n, *(1,) * (q.ndim - 1)), (n, *q.shape))
    rows = jnp.swapaxes(jax.vmap(push)(ones), 0, 1)
    rates = jnp.zeros_like(values)
    if problem.moving:
        moment = jnp.asarray(t, dtype=float)
        rates = jax.jvp(lambda s: stacked(problem.constraints(q, s)), (moment,), (jnp.ones_like(moment),))[1]
    return values, rows, rates


def tangent_momentum(problem: Held, q: Any, p: Any, t: Any, turns: int = 1) -> Any:
    """The momentum nearest to p with which the state moves along its surface: Newton's method, for a linear velocity
    one step.
    """
    from jax import lax

    _, rows, rates = gradients(problem, q, t)

    def closer(_: Any, y: Any) -> Any:
        velocity = problem.rates(q, y, t)[0]
        pulls = problem.pulls(q, y, t, rows)
        shift = solve_active(problem.active, products(rows, pulls), along(rows, velocity, rates))
        return y - combined(shift, rows)

    return closer(0, p) if turns == 1 else lax.fori_loop(0, turns, closer, p)


def newton_turns(problem: Held) -> int:
    """Newton's steps after which a momentum is tangent to rounding, from within a step's error."""
    return 1 if isinstance(problem, Constrained) or problem.linear else 5


def reactions(problem: Held, q: Any, p: Any, t: Any) -> Any:
    """The multipliers λ of ṗ = F − Σ λ_k ∂g_k/∂q at a state on the surface: the reaction forces are −λ_k ∂g_k/∂q.

    From d²g/dt² = 0 along the motion.
    """
    import jax
    import jax.numpy as jnp

    velocity, force = problem.rates(q, p, t)
    if problem.drag is not None:
        force = force + problem.drag.force(q, p, t)
    _, rows, _ = gradients(problem, q, t)
    moment = jnp.asarray(t, dtype=float)
    passing = jnp.zeros_like(moment) + float(problem.moving)

    def speeds(x: Any, y: Any, s: Any) -> tuple[Any, ...]:
        return jax.jvp(problem.constraints, (x, s), (problem.rates(x, y, s)[0], passing))[1]

    bends = jax.jvp(speeds, (q, p, moment), (velocity, force, jnp.ones_like(moment)))[1]
    pulls = problem.pulls(q, p, t, rows)
    return solve_active(problem.active, products(rows, pulls), stacked(bends))


def onto_surface(problem: Held, q: Any, p: Any, t: Any) -> tuple[Any, Any]:
    """The nearest state, by masses, on the surface and tangent to it: Newton's method, then a projection of p."""
    from jax import lax

    def closer(_: Any, x: Any) -> Any:
        values, rows, _ = gradients(problem, x, t)
        pulls = problem.pulls(x, p, t, rows)
        shift = solve_active(None, products(rows, pulls), values)
        return x - combined(shift, pulls)

    q = lax.fori_loop(0, MOST_ITERATIONS, closer, q)
    return q, tangent_momentum(problem, q, p, t, 2 * newton_turns(problem))
