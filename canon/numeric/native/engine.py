"""Runs made by native code: a run's arrays into the rows that the compiled loop works on, and back."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any, Final

import numpy as np

from canon.numeric.compiled import compiled_soon
from canon.numeric.integrators.stepper import Method, Stepper, Time, stepper_of
from canon.numeric.native.compile import Code, compiled, processor
from canon.numeric.native.loop import source_text
from canon.numeric.native.straight import Layout, Straight, layout_of, straight
from canon.numeric.precision import double
from canon.numeric.scalar_arrays import Unscalar

MOST_BLOCKS: Final = 4
"""Blocks of orbits that are interleaved, at most: operations wait for four to five others."""
FEWEST_BLOCKS: Final = 2
"""So many where registers are too few for any: what a step waits for costs more than to load what lies in memory."""

WORTH_A_THREAD: Final = 2e7
"""Operations for which a thread is begun: some milliseconds."""


@dataclass(frozen=True)
class Form:
    """What a compiled loop depends on of a carry: its structure, and its leaves' types and shapes for one orbit."""

    structure: Any
    leaves: tuple[tuple[str, tuple[int, ...]], ...]


@dataclass(frozen=True)
class Chunks:
    """From chunk `first` to `last` of `per_chunk` steps of length h from t0, `per_sample` of them a sample."""

    first: int
    last: int
    per_sample: int
    per_chunk: int
    h: float
    t0: float


class Native:
    """A method's steps for one problem, compiled for carries of one form."""

    def __init__(self, stepper: Stepper, programs: Straight) -> None:
        self.stepper, self.programs = stepper, programs
        self.codes: dict[int, Code] = {}

    def run(self, carry: Any, stored: Any, chunks: Chunks, batched: bool) -> tuple[int, Any, Any]:
        """The number of chunks that are done, the carry then, and the stored states with those that came."""
        import jax

        if chunks.last <= chunks.first:
            return chunks.first, carry, stored
        programs = self.programs
        leaves = [np.asarray(x) for x in jax.tree.leaves(carry)]
        if not programs.fits(_statics(leaves, programs.carry)):
            carry = self.begun(carry, stored, chunks, batched)
            leaves = [np.asarray(x) for x in jax.tree.leaves(carry)]
        orbits = leaves[programs.carry.floats[0]].shape[-1] if batched else 1
        blocks = self.blocks(orbits) if batched else 1
        together = (processor().width if batched else 1) * blocks
        stride = -(-orbits // together) * together
        packed = _packed(leaves, programs.carry, orbits, stride)
        done, after, rows = self.called(packed, chunks, blocks, together, batched)
        if done == chunks.first:
            return done, carry, stored
        carry = _unpacked(after, programs.carry, leaves, programs.statics, orbits)
        first = chunks.first // chunks.per_sample
        count = (done - 1) // chunks.per_sample - first + 1
        stored = _rows_stored(stored, rows[:count, :, :orbits], first + 1)
        return done, carry, stored

    def begun(self, carry: Any, stored: Any, chunks: Chunks, batched: bool) -> Any:
        """The carry of a method that begins in a way of its own."""
        import jax

        past, k = self.stepper.past, float(chunks.first * chunks.per_chunk)
        with double():
            if past is not None and past.wanted(carry):
                state = self.stepper.read(carry)
                other = made_native(past.stepper, batched, form_of(past.stepper.initial(state), batched))
                if other is not None:
                    rows = jax.tree.map(lambda x: np.full((past.steps + 1, *np.shape(x)), np.nan), state)
                    for row, x in zip(jax.tree.leaves(rows), jax.tree.leaves(state), strict=True):
                        row[0] = x
                    back = Chunks(0, past.steps, 1, 1, -chunks.h, chunks.t0 + k * chunks.h)
                    _, _, states = other.run(past.stepper.initial(state), rows, back, batched)
                    return _joined(self.stepper)(states, chunks.h, chunks.t0, k)
            return _begun(self.stepper)(carry, chunks.h, chunks.t0, k)

    def called(
        self, packed: np.ndarray, chunks: Chunks, blocks: int, together: int, batched: bool
    ) -> tuple[int, np.ndarray, np.ndarray]:
        """The chunks that are done, and the carry and the rows of stored states after them."""
        code = self.code(blocks, batched)
        tables = np.empty(max(self.programs.tables, 1))
        code.prepare(tables.ctypes.data, chunks.h)
        count = (chunks.last - 1) // chunks.per_sample - chunks.first // chunks.per_sample + 1
        size, stride = self.programs.state.size, packed.shape[1]
        last = chunks.last
        while True:
            carry, rows = packed.copy(), np.empty((count, size, stride))
            shares = self.shares(stride // together, (last - chunks.first) * chunks.per_chunk * together)
            alive = np.zeros((len(shares), max(last - chunks.first, 1)), dtype=np.int8)

            def part(share: tuple[int, int], flags: Any, carry: Any = carry, rows: Any = rows, last: int = last) -> int:
                return code.run(
                    carry.ctypes.data, rows.ctypes.data, tables.ctypes.data, flags.ctypes.data, chunks.first, last,
                    chunks.per_sample, chunks.per_chunk, chunks.h, chunks.t0, stride, *share,
                )  # fmt: skip

            if len(shares) == 1:
                done = part(shares[0], alive[0])
            else:
                with ThreadPoolExecutor(len(shares)) as pool:
                    done = max(pool.map(part, shares, alive))
            dead = np.flatnonzero(~np.any(alive[:, : last - chunks.first] != 0, axis=0))
            if not batched or not len(dead):
                return done, carry, rows
            # the carry is wanted as it was before every orbit was lost: the same run, that far
            last = chunks.first + int(dead[0])

    def shares(self, blocks: int, steps: int) -> list[tuple[int, int]]:
        """From which block to which each thread computes, where a block takes so many steps of an orbit."""
        work = blocks * steps * len(self.programs.step.operations)
        present = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        threads = max(min(present, blocks, int(work / WORTH_A_THREAD)), 1)
        ends = [blocks * k // threads for k in range(threads + 1)]
        return [*pairwise(ends)]

    def code(self, blocks: int, batched: bool) -> Code:
        if blocks not in self.codes:
            machine = processor()
            width = machine.width if batched else 1
            text = source_text(self.programs, width=width, blocks=blocks, fused=machine.fused)
            self.codes[blocks] = compiled(text)
        return self.codes[blocks]

    def blocks(self, orbits: int) -> int:
        """How many blocks are interleaved: as many as leave half of the registers for what is computed, and two."""
        machine = processor()
        fitting = machine.registers // (2 * max(self.programs.carry.size, 1))
        return min(max(fitting, FEWEST_BLOCKS), MOST_BLOCKS, -(-orbits // machine.width))


def native(problem: Any, method: Method, compensated: bool, batched: bool, carry: Any) -> Native | None:
    """The compiled method for carries of this form; None where it can't be made native."""
    with double():
        stepper = stepper_of(method, problem, compensated)
    return made_native(stepper.straight or stepper, batched, form_of(carry, batched))


def form_of(carry: Any, batched: bool) -> Form:
    """The form of a carry, whose last axis counts orbits if it is of a batch."""
    import jax

    leaves, structure = jax.tree.flatten(carry)
    shapes = [np.shape(x) for x in leaves]
    kinds = [np.asarray(x).dtype.str for x in leaves]
    single = [s[:-1] if batched and s else s for s in shapes]
    return Form(structure, tuple(zip(kinds, single, strict=True)))


@lru_cache(maxsize=64)
def made_native(stepper: Stepper, batched: bool, form: Form) -> Native | None:
    """The compiled steps for carries of this form; None where they can't be made native."""
    import jax

    zeros = [np.zeros((*shape, 1) if batched and kind == "<f8" else shape, kind) for kind, shape in form.leaves]
    carry = jax.tree.unflatten(form.structure, zeros)
    try:
        layout = layout_of(carry, batched)
        first = None
        if len(layout.floats) < layout.leaves:
            with double():
                begun = stepper.past.marked(carry) if stepper.past else _begun(stepper)(carry, 1.0, 0.0, 0.0)
            first = _statics([np.asarray(x) for x in jax.tree.leaves(begun)], layout)
        made = Native(stepper, straight(stepper, carry, first, batched))
        made.code(made.blocks(1 << 20) if batched else 1, batched)
        return made
    except Unscalar:
        return None


@lru_cache(maxsize=64)
def _joined(stepper: Stepper) -> Any:
    """What makes a carry of states of the past, by jax: of these alone, since every array that is handed over costs."""
    import jax

    past = stepper.past
    assert past is not None

    def begun(states: Any, h: Any, t0: Any, k: Any) -> Any:
        carry = stepper.initial(jax.tree.map(lambda rows: rows[0], states))
        return past.begin(carry, states, Time(t0, h, k))

    return compiled_soon(begun)


@lru_cache(maxsize=64)
def _begun(stepper: Stepper) -> Any:
    """What begins a run of steps, by jax: of methods that begin in their own way."""
    import jax

    return jax.jit(lambda carry, h, t0, k: stepper.begin(carry, stepper.prepare(h), Time(t0, h, k)))


def _statics(leaves: Sequence[np.ndarray], layout: Layout) -> list[np.ndarray]:
    return [x for k, x in enumerate(leaves) if k not in layout.floats]


def _packed(leaves: Sequence[np.ndarray], layout: Layout, orbits: int, stride: int) -> np.ndarray:
    """The numbers of the carry (size, stride); the lanes that are left over have the last orbit again."""
    rows = [leaves[k].reshape(-1, orbits) for k in layout.floats]
    packed = np.empty((layout.size, stride))
    np.concatenate(rows, axis=0, out=packed[:, :orbits])
    packed[:, orbits:] = packed[:, orbits - 1 : orbits]
    return packed


def _unpacked(
    packed: np.ndarray, layout: Layout, like: Sequence[np.ndarray], statics: Sequence[np.ndarray], orbits: int
) -> Any:
    import jax

    others, first = iter(statics), 0
    leaves: list[Any] = []
    for k, leaf in enumerate(like):
        if k not in layout.floats:
            leaves.append(next(others))
            continue
        count = leaf.size // orbits
        leaves.append(packed[first : first + count, :orbits].reshape(leaf.shape).copy())
        first += count
    return jax.tree.unflatten(layout.structure, leaves)


def _rows_stored(stored: Any, rows: np.ndarray, first: int) -> Any:
    """The stored states with rows (samples, numbers, orbits) from sample `first` on."""
    import jax

    leaves, structure = jax.tree.flatten(stored)
    found, column = [], 0
    for leaf in leaves:
        new = np.array(leaf)
        size = new[0].size // rows.shape[2]
        new[first : first + len(rows)] = rows[:, column : column + size].reshape(len(rows), *new.shape[1:])
        column += size
        found.append(new)
    return jax.tree.unflatten(structure, found)
