"""Orbits through close approaches: steps in the fictitious time of `levi_civita`, states at times that are asked for.

All steps have one length, so that multistep methods and native code take them as they take any other problem's. Of
every few steps the state is kept until the times are passed. The state at a time is then found from the one kept before
it by Halley's method for the fictitious time, dt/ds = |u|² and its slope being known, with short steps of a method that
needs no past. Nothing is gone on with from there, so that what is stored leaves the orbit as it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.compiled import compiled_soon
from canon.numeric.engines import Engine
from canon.numeric.integrate import Run, advance, flow_map, start
from canon.numeric.integrators.problem import Splitting
from canon.numeric.integrators.stepper import Method
from canon.numeric.levi_civita import Regularised, Vector
from canon.numeric.precision import double

KEPT: Final = 16
"""Steps from one state that is kept to the next, at least."""
MOST_KEPT: Final = 16_384
"""States that are kept of a run whose length is foreseen rightly; a longer one has longer ways between them."""
PIECE: Final = 1 << 20
"""Steps between two looks at whether the run is to be stopped."""
ITERATIONS: Final = 60
"""Of Halley's method, or of halvings where it leaves the bracket: four or five are made."""
CLOSE: Final = 2.0**-51
"""What is left of a time, or of the way between two kept states, that is rounding."""


@dataclass(frozen=True)
class RegularisedOrbit:
    """Positions `q` and momenta `p` (k, d) at the first k of the `times`: fewer than all where the orbit ended, or was
    `interrupted`. `run` made the steps, of equal length in the fictitious time; the last of the states is `reach` from
    the first in that time.
    """

    times: np.ndarray
    q: np.ndarray
    p: np.ndarray
    run: Run
    reach: float
    interrupted: bool = False

    @property
    def steps(self) -> int:
        """The steps that were made."""
        return self.run.steps

    @property
    def length(self) -> float:
        """Of a step, in the fictitious time."""
        return self.run.step

    @property
    def engine(self) -> Engine:
        """What computed them."""
        return self.run.engine


def regularised_orbit(
    kepler: Regularised,
    method: Method,
    q: Vector,
    p: Vector,
    times: Sequence[float],
    *,
    step: float,
    compensated: bool | None = None,
    engine: Engine = "auto",
    most_steps: int = 1_000_000_000,
    begun: Run | None = None,
    stop: Callable[[Run], bool] = lambda run: False,
) -> RegularisedOrbit:
    """The orbit from (q, p) at the first of the times, which is the problem's `t0`.

    **Arguments:** increasing `times`; `step` in the fictitious time (`Regularised.pace` gives a measure for it), or a
    little less; `compensated` and `engine` as in `canon.numeric.integrate.integrate`; `begun`, the `run` of an orbit
    that was interrupted, all else being the same: what comes out has every bit of one that was not; `stop` is given the
    run now and then, and asked.

    **Raises:** `InputError` where the times do not increase or begin at another, the step is not positive, or the
    method does not take the problem.
    """
    moments = np.asarray(times, dtype=float)
    if moments.ndim != 1 or len(moments) < 2 or not (np.diff(moments) > 0).all() or moments[0] != kepler.t0:
        raise InputError(f"the times of an orbit increase from t0 = {kepler.t0:g}, and are two or more")
    if not 0 < step < math.inf:
        raise InputError("the step of an orbit in fictitious time is positive")
    passed = moments - moments[0]
    run = begun or unbegun(kepler, method, q, p, passed[-1], step, compensated=compensated, engine=engine)
    interrupted = False
    while not run.ended and run.steps < most_steps and not interrupted and reached(run) < passed[-1]:
        if run.done == run.chunks:
            run = longer(run, passed[-1], reached(run))
        run = advance(kepler.problem, method, run, chunks=max(PIECE // run.per_chunk, 1))
        interrupted = not run.ended and reached(run) < passed[-1] and stop(run)
    kept = tuple(run.states)
    clock = -kept[1][:, -1]
    good = int(np.searchsorted(passed, clock[-1], side="right"))
    found, reach = _at(kepler, method, run, kept, passed[:good])
    q_found, p_found = kepler.shown(found)
    q_found[0], p_found[0] = q, p  # not rounded there and back
    return RegularisedOrbit(moments, q_found, p_found, run, reach, interrupted)


def unbegun(
    kepler: Regularised, method: Method, q: Vector, p: Vector, duration: float, step: float, *,
    compensated: bool | None = None, engine: Engine = "auto",
) -> Run:  # fmt: skip
    """The run of `regularised_orbit` before its first step, with room for as many states as are foreseen."""
    state = kepler.state(q, p)
    length = foreseen(kepler, float(state[0][-1]), duration)
    between = max(KEPT, math.ceil(length / step / MOST_KEPT))
    rows = max(math.ceil(length / step / between), 1) + 1
    run = start(
        kepler.problem, method, state, duration=step * between * rows, steps=between * rows, samples=rows + 1,
        compensated=compensated,
    )  # fmt: skip
    return replace(run, engine=engine)


def reached(run: Run) -> float:
    """The time that has passed since the beginning of a run, at the last of its states."""
    return -float(run.stored[1][run.completed - 1, -1])


def foreseen(kepler: Regularised, b: float, duration: float) -> float:
    """The fictitious time of the whole: the mean of r is k/2b where the motion is bound and V small, else a guess."""
    guess = 8 * kepler.pace(b, duration)
    return max(2 * b * duration / kepler.strength, guess) if b > 0 else guess


def longer(run: Run, wanted: float, passed: float) -> Run:
    """The run with room for as many more states as its mean pace says, or for as many as there are."""
    made = run.samples - 1
    more = made if passed <= 0 else min(made, math.ceil(made * (wanted - passed) / passed * 1.01) + 1)
    rows = tuple(np.concatenate([x, np.full((more, *np.shape(x)[1:]), np.nan)]) for x in run.stored)
    return replace(run, samples=run.samples + more, duration=run.duration * (made + more) / made, stored=rows)


def _at(kepler: Regularised, method: Method, run: Run, kept: Any, passed: np.ndarray) -> tuple[Any, float]:
    """The states (k, n) at the times since the beginning, all of them within the kept ones, and the last's s."""
    clock = -kept[1][:, -1]
    row = np.clip(np.searchsorted(clock, passed, side="right") - 1, 0, max(len(clock) - 2, 0))
    begin = tuple(x[row] for x in kept)
    span = run.step * run.per_sample * run.per_chunk
    length = np.clip((passed - clock[row]) / np.maximum(np.diff(clock, append=np.inf)[row], 1e-300), 0, 1) * span
    with double():
        # a method that begins others is so accurate that it can take two of their steps at once
        steps, starter = run.per_sample * run.per_chunk, getattr(method, "starter", None)
        program = (
            halley(kepler.problem, method, steps) if starter is None else halley(kepler.problem, starter, steps // 2)
        )
        bracket = np.zeros_like(passed), np.full(passed.shape, span)
        found, length = program(begin, passed, length, *bracket, 1 / (2 * kepler.mass))
    return tuple(np.asarray(x) for x in found), float(row[-1] * span + np.asarray(length)[-1])


@lru_cache(maxsize=32)
def halley(problem: Splitting, method: Any, steps: int) -> Any:
    """From states (k, n), times (k,), and of the fictitious times to them guesses and brackets, to states and these."""
    import jax
    import jax.numpy as jnp
    from jax import lax

    moved = jax.vmap(lambda state, length: flow_map(problem, method, steps=steps, h=length / steps)(state))

    @compiled_soon
    def program(begin: Any, wanted: Any, guess: Any, low: Any, high: Any, rate: Any) -> Any:
        most = high - low

        def narrow(loop: Any) -> Any:
            count, _, length, low, high, _, _ = loop
            state = moved(begin, length)
            u, w, ahead = state[0][:, :-1], state[1][:, :-1], -state[1][:, -1] - wanted
            pace, slope = jnp.sum(u**2, axis=1), rate * jnp.sum(u * w, axis=1)
            low, high = jnp.where(ahead <= 0, length, low), jnp.where(ahead >= 0, length, high)
            better = length - ahead / (pace - ahead * slope / (2 * pace))
            better = jnp.where((better > low) & (better < high), better, (low + high) / 2)
            far = (jnp.abs(ahead) > CLOSE * jnp.abs(wanted)) & (jnp.abs(better - length) > CLOSE * most)
            return count + 1, length, jnp.where(far, better, length), low, high, state, jnp.any(far)

        loop = (0, guess, guess, low, high, begin, jnp.asarray(True))
        _, length, _, _, _, state, _ = lax.while_loop(lambda loop: (loop[0] < ITERATIONS) & loop[6], narrow, loop)
        return state, length

    return program
