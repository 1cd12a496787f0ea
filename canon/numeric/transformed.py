"""Runs problems whose independent variable is a fictitious time, and stores their states at given times.

Full steps are made until the next would pass the time that is asked for; the state at that time is then one step of a
fraction of the length, found by its time, and is not gone on from: what is stored leaves the orbit as it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method, Time
from canon.numeric.integrators.time_transformation import CLOCK_SLOT
from canon.numeric.precision import double

BISECTIONS: Final = 60


@dataclass(frozen=True)
class TransformedRun:
    """The states at `times`, arrays with the times as their first axis, nan where not reached; `steps` made."""

    times: np.ndarray
    states: State
    steps: int

    @property
    def completed(self) -> int:
        """Times reached."""
        import jax

        good = [np.isfinite(x).reshape(len(x), -1).all(axis=1) for x in jax.tree.leaves(self.states)]
        return int(np.logical_and.reduce(good).sum())


def integrate_transformed(
    problem: Any,
    method: Method,
    state: State,
    times: Sequence[float],
    *,
    step: float,
    most_steps: int = 100_000_000,
    compensated: bool = False,
) -> TransformedRun:
    """The orbit from `state`, whose time is slot 2, at increasing times; the first is the state's own.

    **Arguments:** `step` in the fictitious time; `most_steps` of a run that does not arrive.

    **Raises:** `InputError` where the times do not increase, or the step is not positive.
    """
    import jax
    import jax.numpy as jnp

    moments = np.asarray(times, dtype=float)
    if moments.ndim != 1 or len(moments) < 2 or not np.all(np.diff(moments) > 0):
        raise InputError("the times of a run in transformed time increase, and are two or more")
    if not step > 0:
        raise InputError("the step of a run in transformed time is positive")
    with double():
        state = jax.tree.map(lambda x: jnp.asarray(x, dtype=float), state)
        rows, steps = _program(problem, method, compensated)(state, jnp.asarray(moments), step, most_steps)
        states = jax.tree.map(np.asarray, rows)
    return TransformedRun(moments, states, int(steps))


@lru_cache(maxsize=32)
def _program(problem: Any, method: Method, compensated: bool) -> Any:
    import jax
    import jax.numpy as jnp
    from jax import lax

    stepper = method.stepper(problem, compensated=compensated)

    def one(carry: Any, tables: Any, h: Any) -> Any:
        time = Time(0.0, h, 0.0)
        return stepper.end(stepper.step(stepper.begin(carry, tables, time), tables, time), tables, time)

    def clock(carry: Any) -> Any:
        return jnp.reshape(stepper.read(carry)[CLOCK_SLOT], ())

    @jax.jit
    def program(state: State, times: Any, h: Any, most: Any) -> Any:
        tables = stepper.prepare(h)

        def row(loop: Any) -> Any:
            k, carry, ahead, rows, steps = loop
            target = times[k]

            def go(inner: Any) -> Any:
                _, new, steps = inner
                return new, one(new, tables, h), steps + 1

            def short(inner: Any) -> Any:
                return (clock(inner[1]) < target) & (inner[2] < most)

            carry, ahead, steps = lax.while_loop(short, go, (carry, ahead, steps))

            def part(fraction: Any) -> Any:
                return one(carry, stepper.prepare(fraction * h), fraction * h)

            def narrow(loop: Any) -> Any:
                count, low, high, under, over, _ = loop
                # regula falsi, with the end that stays halved: Illinois
                guess = low + (high - low) * under / (under + over)
                guess = jnp.where((guess > low) & (guess < high), guess, (low + high) / 2)
                miss = clock(part(guess)) - target
                before = miss <= 0
                return (
                    count + 1,
                    jnp.where(before, guess, low),
                    jnp.where(before, high, guess),
                    jnp.where(before, -miss, under / 2),
                    jnp.where(before, over / 2, miss),
                    (miss != 0) & (jnp.abs(miss) > 2e-16 * jnp.abs(target)) & (high - low > 1e-16),
                )

            under, over = target - clock(carry), clock(ahead) - target
            begin = (0, jnp.asarray(0.0), jnp.asarray(1.0), under, over, jnp.asarray(True))
            _, low, high, under, over, _ = lax.while_loop(lambda n: (n[0] < BISECTIONS) & n[5], narrow, begin)
            found = stepper.read(part(jnp.where(under <= over, low, high)))
            good = clock(ahead) >= target
            rows = jax.tree.map(lambda r, x: r.at[k].set(jnp.where(good, x, jnp.nan)), rows, found)
            return k + 1, carry, ahead, rows, steps

        rows = jax.tree.map(lambda x: jnp.full((times.size, *x.shape), jnp.nan).at[0].set(x), state)
        carry = stepper.initial(state)
        begin = (jnp.asarray(1), carry, one(carry, tables, h), rows, jnp.asarray(1))
        _, _, _, rows, steps = lax.while_loop(lambda loop: loop[0] < times.size, row, begin)
        return rows, steps

    return program
