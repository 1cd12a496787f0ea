"""RATTLE: a Hamiltonian on a constraint surface g(q, t) = 0, with the constraint and its rate kept to rounding.

Symplectic on the constraint's cotangent bundle, symmetric, of order 2; `composed` makes higher orders of it. It is
explicit but for the multipliers for H = Σ p²/2m + V(q, t), and iterates for any other H. Linear friction acts for half
a step before and after, and makes it conformal symplectic where there is one rate for all. Andersen (1983), J. Comput.
Phys. 52, 24; Hairer, Lubich and Wanner (2006), VII.1.4; Jay (1996), SIAM J. Numer. Anal. 33, 368.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.integrators.composed import OneStep, StepMap
from canon.numeric.integrators.constrained import (
    MOST_ITERATIONS,
    Constrained,
    ConstrainedHamiltonian,
    Drag,
    Held,
    gradients,
    newton_turns,
    tangent_momentum,
)
from canon.numeric.integrators.multipliers import along, combined, products, solve_active
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.traits import Traits

CLOSE: Final = 1e-9
"""From a change of this part on Newton's method leaves nothing but rounding."""
ROUNDING: Final = 1e-14
"""A change of this part is rounding, where each is a part of the one before."""


def _step(problem: Constrained) -> StepMap:
    import jax.numpy as jnp

    def step(state: State, t: Any, h: Any) -> State:
        q, p, *others = state
        m = problem.masses(q)
        _, rows, _ = gradients(problem, q, t)
        half = p + h / 2 * problem.force(q, t)
        pulls = problem.pulls(q, p, t, rows)

        def improve(now: Any) -> tuple[Any, Any]:
            moved, half = now
            missed, here, _ = gradients(problem, moved, t + h)
            shift = solve_active(problem.active, products(here, pulls), missed)
            change = combined(shift, pulls)
            return (moved - change, half - combined(shift, rows) / h), _size(change, q)

        # the momentum comes from the multipliers: from the chord m (moved - q)/h it would have the rounding of q by h
        (moved, half), good = _solved(improve, (q + h / m * half, half), CLOSE)
        pushed = half + h / 2 * problem.force(moved, t + h)
        after = tangent_momentum(problem, moved, pushed, t + h)
        return (jnp.where(good, moved, jnp.nan), jnp.where(good, after, jnp.nan), *others)

    return step


def _general_step(problem: ConstrainedHamiltonian) -> StepMap:
    """The pair of Lobatto IIIA and IIIB with two stages. Hairer, Lubich and Wanner (2006), VII (1.26)."""
    import jax.numpy as jnp

    def step(state: State, t: Any, h: Any) -> State:
        q, p, *others = state
        _, rows, _ = gradients(problem, q, t)
        pulls = problem.pulls(q, p, t, rows)

        def improve(now: Any) -> tuple[Any, Any]:
            moved, half, multipliers = now
            first, force = problem.rates(q, half, t)
            new_half = p + h / 2 * force - combined(multipliers, rows)
            last, _ = problem.rates(moved, half, t + h)
            new = q + h / 2 * (first + last)
            missed, here, _ = gradients(problem, new, t + h)
            shift = solve_active(
                problem.active, products([h * a for a in here] if isinstance(here, list) else h * here, pulls), missed
            )
            new_half = new_half - combined(shift, rows)
            new = new - h * combined(shift, pulls)
            after = (new, new_half, multipliers + jnp.asarray(shift))
            return after, jnp.maximum(_size(new - moved, q), _size(new_half - half, p))

        begin = (q, p, jnp.zeros((len(rows), *q.shape[1:])))
        (moved, half, _), good = _solved(improve, begin, ROUNDING)
        pushed = half + h / 2 * problem.rates(moved, half, t + h)[1]
        after = tangent_momentum(problem, moved, pushed, t + h, newton_turns(problem))
        return (jnp.where(good, moved, jnp.nan), jnp.where(good, after, jnp.nan), *others)

    return step


def _size(change: Any, whole: Any) -> Any:
    """The largest entry of a change beside the largest one of what changes."""
    import jax.numpy as jnp

    return jnp.max(jnp.abs(change)) / jnp.maximum(jnp.max(jnp.abs(whole)), 1e-300)


def _solved(improve: Callable[[Any], tuple[Any, Any]], begin: Any, enough: float) -> tuple[Any, Any]:
    """Improved until changes are rounding, and whether they became small at all: what still shrinks goes on, and so
    does what is above `enough`.
    """
    import jax.numpy as jnp
    from jax import lax

    def turn(loop: Any) -> Any:
        count, now, last, _ = loop
        after, size = improve(now)
        return count + 1, after, size, (size > 0) & ((size < last) | (size > enough))

    start = (0, begin, jnp.asarray(jnp.inf), jnp.asarray(True))
    count, found, size, _ = lax.while_loop(lambda loop: (loop[0] < MOST_ITERATIONS) & loop[3], turn, start)
    return found, (count < MOST_ITERATIONS) | (size <= CLOSE)


def dragged(problem: Held, drag: Drag) -> StepMap:
    """The flow of friction along the surface at a frozen place: half the decay, the reaction, the other half.

    Exact for one rate for all; else of order 2 and symmetric.
    """
    matrix = np.array(drag.matrix)
    values, vectors = np.linalg.eig(matrix)
    left, right = np.real_if_close(vectors), np.real_if_close(np.linalg.inv(vectors))
    uniform = bool(np.all(matrix == matrix[0, 0] * np.eye(len(matrix))))

    def flow(state: State, t: Any, h: Any) -> State:
        import jax
        import jax.numpy as jnp

        q, p, *others = state
        rest = 0.0 if drag.rest is None else drag.rest(q, t)

        def decayed(momentum: Any) -> Any:
            if uniform:
                return jnp.exp(-h / 2 * matrix[0, 0]) * momentum
            factor = jnp.real((left * jnp.exp(-h / 2 * values)) @ right)
            return jnp.tensordot(factor, momentum, axes=1)

        moving = decayed(p - rest)
        _, rows, rates = gradients(problem, q, t)
        slowed = [decayed(row) for row in rows] if isinstance(rows, list) else jax.vmap(decayed)(rows)
        pulls = problem.pulls(q, p, t, slowed)
        velocity = problem.rates(q, rest + decayed(moving), t)[0]
        shift = solve_active(problem.active, products(rows, pulls), along(rows, velocity, rates))
        return (q, rest + decayed(moving - combined(shift, rows)), *others)

    return flow


def _build(problem: Any) -> StepMap:
    if not isinstance(problem, Held):
        raise InputError("rattle takes a system with holonomic constraints; this one has none")
    step = _step(problem) if isinstance(problem, Constrained) else _general_step(problem)
    if problem.drag is None:
        return step
    slow = dragged(problem, problem.drag)

    def slowed(state: State, t: Any, h: Any) -> State:
        return slow(step(slow(state, t, h / 2), t, h), t + h, h / 2)

    return slowed


RATTLE: Final = OneStep(
    "rattle",
    Traits(order=2, symplectic=True, symmetric=True, volume_preserving=True),
    _build,
    "Andersen (1983), J. Comput. Phys. 52, 24; Hairer, Lubich and Wanner (2006), VII.1.4",
)
