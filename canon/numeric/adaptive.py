"""An adaptive explicit Runge–Kutta method of order 8, DOP853, as a reference that shares nothing with the splittings.

Hairer, Nørsett and Wanner (1993), Solving Ordinary Differential Equations I, II.5 (error estimate) and II.4 (step
size). Steps end at the times that are asked for; nothing is interpolated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.integrators import dop853_table as table
from canon.numeric.integrators.fields import as_field
from canon.numeric.integrators.problem import State
from canon.numeric.precision import double

SAFETY: Final = 0.9
LEAST_FACTOR: Final = 0.333
MOST_FACTOR: Final = 6.0
_STAGES: Final = 12


@dataclass(frozen=True)
class AdaptiveRun:
    """The states at `times`, as arrays with the times as their first axis; `steps` taken, `rejected` ones included.

    `completed` counts the times that were reached; later rows are nan.
    """

    times: np.ndarray
    states: State
    steps: int
    rejected: int

    @property
    def completed(self) -> int:
        """Times reached."""
        import jax

        good = [np.isfinite(x).reshape(len(x), -1).all(axis=1) for x in jax.tree.leaves(self.states)]
        return int(np.logical_and.reduce(good).sum())


def integrate_adaptively(
    problem: Any,
    state: State,
    times: Sequence[float],
    *,
    relative: float = 1e-12,
    absolute: float = 1e-14,
    most_steps: int = 1_000_000,
) -> AdaptiveRun:
    """The orbit from `state` at times[0], at the other times, in one direction.

    **Arguments:** `problem`, a `Field` or a `Splitting`; `relative` and `absolute`, bounds of a step's estimated error.

    **Raises:** `InputError` where the times don't go one way, or a tolerance isn't positive.
    """
    import jax
    import jax.numpy as jnp
    from jax.flatten_util import ravel_pytree

    moments = np.asarray(times, dtype=float)
    gaps = np.diff(moments)
    if moments.ndim != 1 or len(moments) < 2 or not (np.all(gaps > 0) or np.all(gaps < 0)):
        raise InputError("the times of an adaptive run increase, or decrease, and are two or more")
    if not (relative > 0 and absolute > 0):
        raise InputError("the tolerances of an adaptive run are positive")
    with double():
        flat, restore = ravel_pytree(jax.tree.map(lambda x: jnp.asarray(x, dtype=float), state))
        shapes = jax.tree.structure(state), tuple(np.shape(x) for x in jax.tree.leaves(state))
        program = _program(problem, shapes)
        rows, steps, rejected = program(flat, jnp.asarray(moments), relative, absolute, most_steps)
        states = jax.tree.map(np.asarray, jax.vmap(restore)(rows))
    return AdaptiveRun(moments, states, int(steps), int(rejected))


@lru_cache(maxsize=32)
def _program(problem: Any, shapes: Any) -> Any:
    import jax
    import jax.numpy as jnp
    from jax import lax

    field = as_field(problem, "DOP853")
    structure, sizes = shapes
    ends = np.cumsum([int(np.prod(size)) for size in sizes])[:-1]

    def rate(y: Any, t: Any) -> Any:
        parts = [x.reshape(size) for x, size in zip(jnp.split(y, ends), sizes, strict=True)]
        moved = field.rate(jax.tree.unflatten(structure, parts), t)
        return jnp.concatenate([jnp.ravel(x) for x in jax.tree.leaves(moved)])

    a = np.zeros((_STAGES, _STAGES))
    for i, row in table.STAGES.items():
        a[i, list(row)] = list(row.values())
    weights, third, fifth = (np.zeros(_STAGES) for _ in range(3))
    for target, source in ((weights, table.WEIGHTS), (third, table.THIRD), (fifth, table.FIFTH)):
        target[list(source)] = list(source.values())

    def attempt(y: Any, t: Any, h: Any, relative: Any, absolute: Any) -> tuple[Any, Any]:
        """The state after h, and the error's estimate in units of the tolerance."""

        def stage(i: Any, slopes: Any) -> Any:
            return slopes.at[i].set(rate(y + h * (jnp.asarray(a)[i] @ slopes), t + jnp.asarray(table.NODES)[i] * h))

        slopes = lax.fori_loop(0, _STAGES, stage, jnp.zeros((_STAGES, y.size)))
        new = y + h * (weights @ slopes)
        scale = absolute + relative * jnp.maximum(jnp.abs(y), jnp.abs(new))
        five, three = (jnp.sum(((e @ slopes) / scale) ** 2) for e in (fifth, third))
        below = jnp.sqrt(jnp.where(five + three > 0, five + 0.01 * three, 1.0) * y.size)
        return new, jnp.abs(h) * five / below

    @jax.jit
    def program(y: Any, times: Any, relative: Any, absolute: Any, most: Any) -> Any:
        forwards = jnp.sign(times[1] - times[0])
        slope = rate(y, times[0])
        scale = absolute + relative * jnp.abs(y)
        ratio = jnp.linalg.norm(y / scale) / jnp.maximum(jnp.linalg.norm(slope / scale), 1e-300)
        first = forwards * jnp.minimum(jnp.where(ratio > 0, 0.01 * ratio, 1e-6), jnp.abs(times[1] - times[0]))

        def go(loop: Any) -> Any:
            row, y, t, h, rows, steps, rejected, stuck = loop
            left = times[row] - t
            last = jnp.abs(h) >= jnp.abs(left) * (1 - 1e-12)
            used = jnp.where(last, left, h)
            new, error = attempt(y, t, used, relative, absolute)
            good = (error <= 1) & jnp.all(jnp.isfinite(new))
            factor = jnp.clip(SAFETY * jnp.maximum(error, 1e-30) ** (-1 / 8), LEAST_FACTOR, MOST_FACTOR)
            factor = jnp.where(jnp.isfinite(error), factor, LEAST_FACTOR)
            proposed = used * jnp.where(good, factor, jnp.minimum(factor, 1.0))
            # a step cut short to end at a time says little of the next one's length
            h = jnp.where(last & good & (jnp.abs(proposed) < jnp.abs(h)), h, proposed)
            y, t = jnp.where(good, new, y), jnp.where(good, jnp.where(last, times[row], t + used), t)
            rows = rows.at[row].set(jnp.where(good & last, y, rows[row]))
            stuck = jnp.abs(used) <= 1e-15 * jnp.abs(t)
            return row + (good & last), y, t, h, rows, steps + 1, rejected + ~good, stuck & ~good

        rows = jnp.full((times.size, y.size), jnp.nan).at[0].set(y)
        begin = (jnp.asarray(1), y, times[0], first, rows, jnp.asarray(0), jnp.asarray(0), jnp.asarray(False))
        more = lambda loop: (loop[0] < times.size) & (loop[5] < most) & ~loop[7]
        _, _, _, _, rows, steps, rejected, _ = lax.while_loop(more, go, begin)
        return rows, steps, rejected

    return program
