"""Runs an integrator over many steps in one compiled program, storing only the states that are asked for.

The program is a loop over chunks of steps, whose bounds are arguments. So a run can be made in pieces, interrupted
and resumed: the program is the same, and so is every bit of the result. It is machine code of our own where the engine
`native` can have it (`canon.numeric.native`), and XLA's elsewhere: the two agree but for rounding.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import finite_number, real_array, shown, whole_number
from canon.numeric.compiled import compiled, compiled_soon
from canon.numeric.devices import spread
from canon.numeric.engines import Engine, settled
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method, Time, stepper_of
from canon.numeric.precision import double

LONGEST_CHUNK: Final = 65536
"""Steps between two places where a run can be interrupted, at most."""
MANY: Final = 60
"""Numbers of a slot from which on one orbit is computed with the widest registers: a dozen bodies lose a factor two."""
LONG_RUN: Final = 1_000_000
"""Steps from which on the rounding of the additions is kept, unless it's said otherwise."""


@dataclass(frozen=True)
class Run:
    """A run from t0 over `duration`, of which `done` chunks are computed.

    `step` is the step's length, and `compensated` says whether the rounding of additions is kept. `per_sample` chunks
    of `per_chunk` steps lie between two stored states; `carry` is what the next chunk starts from, and `stored` has one
    array (samples, …) for each of the state's. `taken`: the steps of a method that chooses each of them by itself.
    `engine` is the one that is asked for before the first step, and the one that computes from then on.
    """

    t0: float
    duration: float
    step: float
    samples: int
    per_sample: int
    per_chunk: int
    done: int
    compensated: bool
    carry: Any
    stored: State
    ended: bool = False
    taken: int | None = None
    engine: Engine = "auto"

    @property
    def chunks(self) -> int:
        """Chunks of the whole run."""
        return self.per_sample * (self.samples - 1)

    @property
    def total(self) -> int:
        """The steps of the whole run, whether they were made or not."""
        return self.chunks * self.per_chunk

    @property
    def steps(self) -> int:
        """Steps that were made."""
        return self.done * self.per_chunk if self.taken is None else self.taken

    @property
    def completed(self) -> int:
        """Samples that are stored and finite (for at least one orbit): all of them at the end of a good run."""
        return self.done // self.per_sample + 1

    @property
    def times(self) -> np.ndarray:
        """The times of the samples: t0 + k·h, with the last one exact."""
        return self.t0 + self.duration * (np.arange(self.samples) / max(self.samples - 1, 1))

    @property
    def states(self) -> State:
        """The stored states, as arrays with the samples as their first axis, up to the last completed one."""
        import jax

        return jax.tree.map(lambda x: np.asarray(x)[: self.completed], self.stored)

    @property
    def state(self) -> State:
        """The last completed state."""
        import jax

        return jax.tree.map(lambda x: x[-1], self.states)


def integrate(
    problem: Any,
    method: Method,
    state: State,
    *,
    duration: float,
    steps: int,
    samples: int = 2,
    t0: float = 0.0,
    compensated: bool | None = None,
    batched: bool = False,
    engine: Engine = "auto",
) -> Run:
    """The orbit from `state` at t0, at `samples` equidistant times, both ends included.

    **Arguments:** `problem`, a `Splitting` or what else the method takes; `state`, a tuple of slots (see
    `canon.numeric.integrators`); `steps` of the whole run at least: it is rounded up to a multiple of samples − 1.
    `compensated`: whether the rounding of the additions is kept; left out, in runs of a million steps and more.
    `batched`: the last axis of every array counts orbits; they are divided among the devices of jax. `engine`: "native"
    computes with machine code of this package's own where a step is a straight line of elementary operations, "xla"
    never does, "auto" does where the optional extra `native` is installed and jax computes on one processor.

    **Returns:** a finished `Run`. It ended early where the state (with orbits: of every orbit) stopped being finite:
    then `completed` < `samples`, and what was stored until then is there.

    **Raises:** `InputError` where the method cannot solve the problem, a number makes no sense, or the engine "native"
    is asked for and not installed.
    """
    run = start(
        problem, method, state, duration=duration, steps=steps, samples=samples, t0=t0, compensated=compensated,
        engine=engine,
    )  # fmt: skip
    return advance(problem, method, run, batched=batched)


def start(
    problem: Any,
    method: Method,
    state: State,
    *,
    duration: float,
    steps: int,
    samples: int = 2,
    t0: float = 0.0,
    compensated: bool | None = None,
    engine: Engine = "auto",
) -> Run:
    """The run that `integrate` makes, before its first step."""
    import jax

    if not callable(getattr(method, "stepper", None)):
        said = "as of canon.numeric.integrators.catalogue.method(name)"
        raise InputError(f"an integrator is expected, {said}, not {shown(method)}", "method")
    for count, least, where in ((steps, 1, "steps"), (samples, 2, "samples")):
        whole_number(count, where, least)
    for moment, where in ((duration, "duration"), (t0, "t0")):
        finite_number(moment, where)
    if not isinstance(state, tuple) or not any(np.size(x) for x in jax.tree.leaves(state)):
        raise InputError(f"a state is a tuple of arrays, as (q, p), not all of them empty, not {shown(state)}", "state")
    per_sample, per_chunk = divided(steps, samples)
    keeps = steps >= LONG_RUN if compensated is None else compensated

    def rows(x: np.ndarray) -> np.ndarray:
        empty = np.full((samples, *x.shape), np.nan)
        empty[0] = x
        return empty

    with double():
        state = jax.tree.map(lambda x: real_array(x, "state"), state)
        carry = stepper_of(method, problem, keeps).initial(state)
    stored = jax.tree.map(rows, state)
    step = duration / (per_chunk * per_sample * (samples - 1))
    return Run(t0, duration, step, samples, per_sample, per_chunk, 0, keeps, carry, stored, engine=engine)


def divided(steps: int, samples: int) -> tuple[int, int]:
    """The chunks between two samples of a run of so many steps or a few more, and the steps of a chunk."""
    between = -(-steps // (samples - 1))
    per_sample = -(-between // LONGEST_CHUNK)
    return per_sample, -(-between // per_sample)


def advance(problem: Any, method: Method, run: Run, *, chunks: int | None = None, batched: bool = False) -> Run:
    """The run, `chunks` chunks further; to its end where they are left out."""
    if run.ended:
        return run
    last = run.chunks if chunks is None else min(run.done + chunks, run.chunks)
    engine = settled(run.engine, batched)
    if engine == "native":
        from canon.numeric.native.engine import native

        made = native(problem, method, run.compensated, batched, run.carry)
        if made is not None:
            done, carry, stored = made.run(run.carry, run.stored, _chunks(run, last), batched)
            return replace(run, done=done, carry=carry, stored=stored, ended=done < last, engine="native")
    wide = batched or max((np.size(x) for x in _leaves(run)), default=0) // run.samples >= MANY
    with double():
        program = _program(problem, method, run.compensated, batched, wide)
        carry, stored = _spread(run) if batched else (run.carry, run.stored)
        done, carry, stored = program(carry, stored, run.done, last, run.per_sample, run.per_chunk, run.step, run.t0)
        done = int(done)
    return replace(run, done=done, carry=carry, stored=stored, ended=done < last, engine="xla")


def _chunks(run: Run, last: int) -> Any:
    from canon.numeric.native.engine import Chunks

    return Chunks(run.done, last, run.per_sample, run.per_chunk, run.step, run.t0)


def _leaves(run: Run) -> list[Any]:
    import jax

    return jax.tree.leaves(run.stored)


def _spread(run: Run) -> tuple[Any, Any]:
    """The orbits of an ensemble, divided among the devices of jax."""
    import jax

    count = max(np.shape(x)[-1] for x in jax.tree.leaves(run.stored))
    return spread(run.carry, count), spread(run.stored, count)


def pieces(problem: Any, method: Method, run: Run, *, chunks: int = 1, batched: bool = False) -> Iterator[Run]:
    """The run after every so many chunks: for progress, for what may be interrupted, and for what is kept on disk."""
    while run.done < run.chunks and not run.ended:
        run = advance(problem, method, run, chunks=chunks, batched=batched)
        yield run


def flow_map(problem: Any, method: Method, *, steps: int, h: float, t0: float = 0.0) -> Any:
    """The map state -> state of `steps` steps of length h from t0: a function that jax can differentiate and batch."""
    stepper = method.stepper(problem)

    def mapped(state: State) -> State:
        from jax import lax

        tables = stepper.prepare(h)
        carry = stepper.begin(stepper.initial(state), tables, Time(t0, h, 0.0))
        if steps == 1:
            carry = stepper.step(carry, tables, Time(t0, h, 0.0))
        else:
            carry = lax.fori_loop(0, steps, lambda k, c: stepper.step(c, tables, Time(t0, h, k * 1.0)), carry)
        return stepper.read(stepper.end(carry, tables, Time(t0, h, float(steps))))

    return mapped


@lru_cache(maxsize=64)
def _program(problem: Any, method: Method, compensated: bool, batched: bool, wide: bool) -> Any:
    """The compiled loop over chunks; `wide`: with the widest registers."""
    import jax
    import jax.numpy as jnp
    from jax import lax

    stepper = stepper_of(method, problem, compensated)

    def alive(state: State) -> Any:
        finite = [jnp.isfinite(x) for x in jax.tree.leaves(state)]
        if not batched:
            return jnp.all(jnp.stack([jnp.all(x) for x in finite]))
        kept = [jnp.all(x.reshape(-1, x.shape[-1]), axis=0) for x in finite]
        return jnp.any(jnp.all(jnp.stack(kept), axis=0))

    @(compiled if wide else compiled_soon)
    def program(
        carry: Any, stored: State, first: Any, last: Any, per_sample: Any, per_chunk: Any, h: Any, t0: Any
    ) -> Any:
        tables = stepper.prepare(h)

        def chunk(loop: Any) -> Any:
            done, carry, stored, _ = loop
            k = done * per_chunk
            new = stepper.begin(carry, tables, Time(t0, h, k * 1.0))
            new = lax.fori_loop(k, k + per_chunk, lambda i, c: stepper.step(c, tables, Time(t0, h, i * 1.0)), new)
            new = stepper.end(new, tables, Time(t0, h, (k + per_chunk) * 1.0))
            state = stepper.read(new)
            good = alive(state)
            row = done // per_sample + 1
            stored = jax.tree.map(lambda rows, x: rows.at[row].set(jnp.where(good, x, rows[row])), stored, state)
            new = jax.tree.map(lambda after, before: jnp.where(good, after, before), new, carry)
            return done + jnp.where(good, 1, 0), new, stored, good

        begin = (jnp.asarray(first), carry, stored, jnp.asarray(True))
        done, carry, stored, _ = lax.while_loop(lambda loop: (loop[0] < last) & loop[3], chunk, begin)
        return done, carry, stored

    return program
