"""M J Mᵀ − scale J at as many points as wanted, beside its rounding bound, in loops over blocks of points.

A loop compares residuals with a part of their bounds that costs next to nothing: the rounding of the products that they
are sums of, and one rounding of every entry of M. What is no larger than a part of its bound is no larger than its
bound. A second loop computes the whole running bound, where the first leaves a doubt.

Of many points the loops are compiled: a block's points are generated, mapped, differentiated and compared without
leaving the processor's registers. The compiler's time grows slowly up to some thousand operations, and then beyond all
measure, sooner for the second loop; so long programs, and those of few points, are run by numpy, in parts that stay in
the processor's cache.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from canon.numeric.compiled import compiled
from canon.numeric.counter import key_of, rows_of
from canon.numeric.devices import along_last
from canon.numeric.emit import run
from canon.numeric.membership import Membership
from canon.numeric.points import Points
from canon.numeric.precision import double
from canon.numeric.running_bound import rounds, run_bounded
from canon.numeric.sines import VectorSines
from canon.numeric.sweep_word import Sweep, bracket, quick_bracket, read, word
from canon.program import Program

Array = np.ndarray
Loop = Callable[[Sequence[Any], Any], Any]
"""Takes rows of points, and the module that computes, to words."""

BLOCK: Final = 2**16
BLOCK_OF_A_GPU: Final = 2**20

SUSPECTS: Final = 2**13
"""So many points are compared with their whole bounds at once."""

PART: Final = 2**12
"""So many points numpy takes at once."""

COMPILED: Final = 2500
BOUNDED: Final = 1000
"""Loops that are longer than this are not compiled: the first, and the second."""

WORTH_COMPILING: Final = 3e8
"""So many operations at points take numpy about as long as compiling takes."""

OF_A_SINE: Final = 20
OF_A_PRODUCT: Final = 6
"""So many operations are made of one: of a sine, and of a product in a bracket with its rounding."""


@dataclass(frozen=True)
class Sweeper:
    """A map's loops: `generated(start, length)` are points from a counter, `given(points)` an array (N, 2n), of at most
    `block` points; both compare with a part of the bounds. `bounded(index)` compares with all of them, for the points
    of at most `SUSPECTS` indices."""

    block: int
    generated: Callable[[int, int], Sweep]
    given: Callable[[Array], Sweep]
    bounded: Callable[[Array], Sweep]


def sweeper(
    program: Program,
    where: Points,
    seed: int,
    scale: float,
    *,
    count: float = np.inf,
    admits: Membership | None = None,
    rounded_numbers: bool = False,
) -> Sweeper:
    """The loops of a map whose values and Jacobian are `program`'s outputs, over `count` points of `where`.

    `admits` says of points which of them lie in the map's domain; `rounded_numbers`, as in `run_bounded`. A program is
    compiled once, for all boxes and seeds.
    """
    length = length_of(program)
    worth = length <= COMPILED and length * count >= WORTH_COMPILING
    key, low, lengths = key_of(seed), where.low, where.high - where.low
    first, second = _quick(program, float(scale), admits), _whole(program, float(scale), rounded_numbers)

    def bounded_by_parts(index: Array) -> Sweep:
        return _by_parts(second, where.at(index, seed).T)

    if not worth:
        return Sweeper(
            BLOCK,
            lambda start, length: _by_parts(first, _rows(start, length, low, lengths, key)),
            lambda points: _by_parts(first, points.T),
            bounded_by_parts,
        )
    block, generating, taking = _compiled(program, float(scale), admits)

    def generated(start: int, length: int) -> Sweep:
        with double():
            return read(np.asarray(generating(np.uint64(start), key, low, lengths))[:length])

    def given(points: Array) -> Sweep:
        with double():
            return read(np.asarray(taking(np.ascontiguousarray(_padded(points, block).T)))[: len(points)])

    def bounded(index: Array) -> Sweep:
        bounding, choosing = _compiled_whole(program, float(scale), rounded_numbers)
        full = _padded(index, SUSPECTS)
        with double():
            found = choosing(full, key, low, lengths) if where.given is None else bounding(where.at(full, seed).T)
            return read(np.asarray(found)[: len(index)])

    return Sweeper(block, generated, given, bounded if length <= BOUNDED else bounded_by_parts)


def length_of(program: Program) -> int:
    """About how many operations the first loop has at each point."""
    size = program.inputs
    sines = sum(operation.name in ("sin", "cos") for operation in program.operations)
    filled = np.array([program.constant(node) != 0 for node in program.outputs[size:]]).reshape(size, size)
    with_conjugates = filled.astype(int) @ np.roll(filled, size // 2, axis=1).T
    products = np.triu(with_conjugates, 1).sum()
    return len(program.operations) + (OF_A_SINE - 1) * sines + OF_A_PRODUCT * int(products)


def _rows(start: int, length: int, low: Array, lengths: Array, key: Any) -> Array:
    return np.stack(rows_of(np.arange(start, start + length, dtype=np.uint64), low, lengths, key))


def _padded(rows: Array, length: int) -> Array:
    """So many rows: the last one again and again."""
    return np.concatenate([rows, np.repeat(rows[-1:], length - len(rows), axis=0)])


def _by_parts(loop: Loop, rows: Array) -> Sweep:
    with np.errstate(all="ignore"):
        parts = [loop(list(rows[:, k : k + PART]), np) for k in range(0, rows.shape[1], PART)]
    return read(np.concatenate(parts))


def _quick(program: Program, scale: float, admits: Membership | None) -> Loop:
    """The first loop. On a processor its sines are made for vector instructions."""
    size = program.inputs
    rounded = [float(rounds(program, node)) for node in program.outputs]
    weights = [rounded[size + a * size : size + (a + 1) * size] for a in range(size)]

    def loop(rows: Sequence[Any], numbers: Any) -> Any:
        inside = None if admits is None else admits(rows, numbers)
        sines = VectorSines(numbers)
        values = run(program, rows, sines if numbers is not np and _on_processor() else numbers)
        M = [values[size + a * size : size + (a + 1) * size] for a in range(size)]

        def entry(a: int, b: int) -> tuple[Any, Any]:
            return quick_bracket(M[a], M[b], weights[a], weights[b])

        return word(rows[0], values[:size], entry, scale, inside, sines.far, numbers)

    return loop


def _whole(program: Program, scale: float, rounded_numbers: bool) -> Loop:
    """The second loop."""
    size = program.inputs

    def loop(rows: Sequence[Any], numbers: Any) -> Any:
        outputs = run_bounded(program, list(rows), numbers, rounded_numbers=rounded_numbers)
        M = [outputs[size + a * size : size + (a + 1) * size] for a in range(size)]
        values = [value for value, _ in outputs[:size]]
        return word(rows[0], values, lambda a, b: bracket(M[a], M[b]), scale, numbers=numbers)

    return loop


def _on_processor() -> bool:
    import jax

    return jax.default_backend() == "cpu"


@lru_cache(maxsize=64)
def _compiled(program: Program, scale: float, admits: Membership | None) -> tuple[int, Any, Any]:
    """The length of a block; the first loop over generated and over given points."""
    import jax
    import jax.numpy as jnp

    devices = len(jax.devices())
    block = (BLOCK if _on_processor() else BLOCK_OF_A_GPU) * devices
    loop = _quick(program, scale, admits)

    def generate(start: Any, key: Any, low: Any, lengths: Any) -> Any:
        index = start + jnp.arange(block, dtype=np.uint64)
        if devices > 1:  # each device generates its own points, and compares them
            index = jax.lax.with_sharding_constraint(index, along_last(devices, 1))
        return loop(rows_of(index, low, lengths, key), jnp)

    return block, compiled(generate), compiled(lambda rows: loop(list(rows), jnp))


@lru_cache(maxsize=64)
def _compiled_whole(program: Program, scale: float, rounded_numbers: bool) -> tuple[Any, Any]:
    """The second loop over given points and over those of given indices."""
    import jax.numpy as jnp

    loop = _whole(program, scale, rounded_numbers)

    def choose(index: Any, key: Any, low: Any, lengths: Any) -> Any:
        return loop(rows_of(index, low, lengths, key), jnp)

    return compiled(lambda rows: loop(list(rows), jnp)), compiled(choose)
