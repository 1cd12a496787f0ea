"""RATTLE: H = Σ p²/2m + V(q, t) on a constraint surface g(q, t) = 0, with the constraint and its rate kept to rounding.

Symplectic on the constraint's cotangent bundle, symmetric, of order 2; `composed` makes higher orders of it. Andersen
(1983), J. Comput. Phys. 52, 24; Hairer, Lubich and Wanner (2006), VII.1.4; Jay (1996), SIAM J. Numer. Anal. 33, 368.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

from canon.errors import InputError
from canon.numeric.integrators.composed import OneStep, StepMap
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.traits import Traits
from canon.numeric.small_systems import solve

MOST_ITERATIONS: Final = 40


@dataclass(frozen=True)
class Constrained:
    """A mechanical system with holonomic constraints, on slots (q, p), arrays (n, …).

    `mass` has n entries; `force(q, t)` returns an array (n, …); `constraints(q, t)` a tuple of scalars (…), at least
    one, that vanish on the surface. `moving`: the constraints depend on t.
    """

    mass: tuple[float, ...]
    force: Callable[[Any, Any], Any]
    constraints: Callable[[Any, Any], tuple[Any, ...]]
    moving: bool = False


def _masses(problem: Constrained, like: Any) -> Any:
    import numpy as np

    return np.asarray(problem.mass).reshape(-1, *(1,) * (like.ndim - 1))


def gradients(problem: Constrained, q: Any, t: Any) -> tuple[list[Any], list[Any], list[Any]]:
    """The constraints' values, their gradients (n, …), and their partial derivatives by time."""
    import jax
    import jax.numpy as jnp

    values = [*problem.constraints(q, t)]
    # every orbit's constraint depends on its own coordinates alone, so the gradient of the sum is all gradients
    rows = [jax.grad(lambda x, k=k: jnp.sum(problem.constraints(x, t)[k]))(q) for k in range(len(values))]
    rates = [0.0 * value for value in values]
    if problem.moving:
        moment = jnp.asarray(t, dtype=float)
        rates = [*jax.jvp(lambda s: problem.constraints(q, s), (moment,), (jnp.ones_like(moment),))[1]]
    return values, rows, rates


def _dot(a: Any, b: Any) -> Any:
    import jax.numpy as jnp

    return jnp.sum(a * b, axis=0)


def _step(problem: Constrained) -> StepMap:
    import jax.numpy as jnp
    from jax import lax

    def step(state: State, t: Any, h: Any) -> State:
        q, p, *others = state
        m = _masses(problem, q)
        _, rows, _ = gradients(problem, q, t)
        free = q + h / m * (p + h / 2 * problem.force(q, t))
        pulls = [row / m for row in rows]

        def improve(loop: Any) -> Any:
            count, moved, last, _ = loop
            missed, here, _ = gradients(problem, moved, t + h)
            shift = solve([[_dot(new, pull) for pull in pulls] for new in here], missed)
            change = sum((s * pull for s, pull in zip(shift[1:], pulls[1:], strict=True)), shift[0] * pulls[0])
            moved = moved - change
            size = jnp.max(jnp.abs(change))
            # Newton's steps shrink until they are rounding
            return count + 1, moved, size, (size > 0) & ((size < last) | (size > 1e-9 * jnp.max(jnp.abs(q))))

        begin = (0, free, jnp.asarray(jnp.inf), jnp.asarray(True))
        count, moved, size, _ = lax.while_loop(lambda loop: (loop[0] < MOST_ITERATIONS) & loop[3], improve, begin)
        # the multipliers' pull is what moved the coordinates: p at half the step is M times the chord
        half = m * (moved - q) / h
        pushed = half + h / 2 * problem.force(moved, t + h)
        _, here, rates = gradients(problem, moved, t + h)
        matrix = [[_dot(a, b / m) for b in here] for a in here]
        multipliers = solve(matrix, [_dot(row / m, pushed) + rate for row, rate in zip(here, rates, strict=True)])
        after = pushed - sum(
            (x * row for x, row in zip(multipliers[1:], here[1:], strict=True)), multipliers[0] * here[0]
        )
        good = (count < MOST_ITERATIONS) | (size <= 1e-9 * jnp.max(jnp.abs(q)))
        return (jnp.where(good, moved, jnp.nan), jnp.where(good, after, jnp.nan), *others)

    return step


def _build(problem: Any) -> StepMap:
    if not isinstance(problem, Constrained):
        raise InputError(f"rattle takes a system with holonomic constraints, not {type(problem)}")
    return _step(problem)


RATTLE: Final = OneStep(
    "rattle",
    Traits(order=2, symplectic=True, symmetric=True, volume_preserving=True),
    _build,
    "Andersen (1983), J. Comput. Phys. 52, 24; Hairer, Lubich and Wanner (2006), VII.1.4",
)


def reactions(problem: Constrained, q: Any, p: Any, t: Any) -> list[Any]:
    """The multipliers λ of ṗ = F − Σ λ_k ∂g_k/∂q at a state on the surface: the reaction forces are −λ_k ∂g_k/∂q.

    From d²g/dt² = 0 along the motion.
    """
    import jax
    import jax.numpy as jnp

    m = _masses(problem, q)
    velocity, force = p / m, problem.force(q, t)
    _, rows, _ = gradients(problem, q, t)
    moment = jnp.asarray(t, dtype=float)
    still = jnp.zeros_like(moment)

    def rate(x: Any, s: Any) -> tuple[Any, ...]:
        return jax.jvp(problem.constraints, (x, s), (velocity, still + float(problem.moving)))[1]

    bends = jax.jvp(rate, (q, moment), (velocity, still + float(problem.moving)))[1]
    matrix = [[_dot(a, b / m) for b in rows] for a in rows]
    return solve(matrix, [_dot(row, force / m) + bend for row, bend in zip(rows, bends, strict=True)])


def onto_surface(problem: Constrained, q: Any, p: Any, t: Any) -> tuple[Any, Any]:
    """The nearest state, by masses, on the surface and tangent to it: Newton's method, then a projection of p."""
    m = _masses(problem, q)
    for _ in range(MOST_ITERATIONS):
        values, rows, _ = gradients(problem, q, t)
        shift = solve([[_dot(a, b / m) for b in rows] for a in rows], values)
        for s, row in zip(shift, rows, strict=True):
            q = q - s * row / m
    _, rows, rates = gradients(problem, q, t)
    matrix = [[_dot(a, b / m) for b in rows] for a in rows]
    shift = solve(matrix, [_dot(row / m, p) + rate for row, rate in zip(rows, rates, strict=True)])
    for s, row in zip(shift, rows, strict=True):
        p = p - s * row
    return q, p


def check_on_surface(problem: Constrained, q: Any, p: Any, t: Any, *, tolerance: float = 1e-8) -> Sequence[str]:
    """What is wrong with a state's constraints: messages, none where it lies on the surface and moves along it."""
    import jax.numpy as jnp

    values, rows, rates = gradients(problem, q, t)
    m = _masses(problem, q)
    found = []
    for k, (value, row, rate) in enumerate(zip(values, rows, rates, strict=True), 1):
        length = jnp.sqrt(_dot(row, row))
        if bool(jnp.any(jnp.abs(value) > tolerance * length * jnp.maximum(1.0, jnp.max(jnp.abs(q))))):
            found.append(f"constraint {k} is missed by {float(jnp.max(jnp.abs(value))):.3g}")
        speed = _dot(row, p / m) + rate
        if bool(jnp.any(jnp.abs(speed) > tolerance * length * jnp.maximum(1.0, jnp.max(jnp.abs(p / m))))):
            found.append(f"the velocity leaves constraint {k} at the rate {float(jnp.max(jnp.abs(speed))):.3g}")
    return found
