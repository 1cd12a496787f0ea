"""M J Mᵀ − scale J at as many points as wanted, beside its rounding bound, as one compiled loop.

A block's points are generated, mapped, differentiated and compared without leaving the processor's registers; what
comes back of a point is one word of 64 bits. A compiler that is given several results computes what they share several
times over; hence the one word.

There are two such loops. The first compares residuals with a part of their bounds that costs next to nothing: the
rounding of the products that they are sums of, and one rounding of every entry of M. What is no larger than a part of
its bound is no larger than its bound. The second computes the whole running bound, where the first leaves a doubt.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache, reduce
from typing import Any, Final, NamedTuple

import numpy as np

from canon.numeric.counter import key_of, rows_of
from canon.numeric.emit import run
from canon.numeric.membership import Membership
from canon.numeric.points import Points
from canon.numeric.precision import UNIT, double
from canon.numeric.running_bound import is_zero, rounds, run_bounded
from canon.numeric.sines import VectorSines
from canon.program import Program

Array = np.ndarray

BLOCK: Final = 2**16
BLOCK_OF_A_GPU: Final = 2**20

SUSPECTS: Final = 2**13
"""So many points are compared with their whole bounds at once."""

RESOLVED: Final = 1e-2
"""A bracket {Q,P} whose bound is a larger part of the scale tells nothing."""

_TINY: Final = 1e-300
_SIGN: Final = np.uint16(0x8000)
_SIZE: Final = np.uint16(0x7FFF)
_INFINITE: Final = np.uint16(0x7F80)
"""The bits of infinity in the upper half of a float32; nan's are larger."""


class Sweep(NamedTuple):
    """What was found at N points, as upper halves of float32, whose order is that of the numbers: (N,) each.

    `ratio` is the largest ratio of a residual to its bound (or the part of it that was computed); `QQ`, `PP` and `QP`
    the largest residuals of the brackets. `exceeds` (its bound, or that part), `outside`, `undefined`, `rough` (no
    finite derivative) and `unresolved` (a bound too large to tell anything) are indices of points.
    """

    ratio: Array
    QQ: Array
    PP: Array
    QP: Array
    exceeds: Array
    outside: Array
    undefined: Array
    rough: Array
    unresolved: Array


@dataclass(frozen=True)
class Sweeper:
    """A map's loops, compiled for `block` points: `generated(start, length)` are points from a counter, `given(points)`
    an array (N, 2n) of at most as many; both compare with a part of the bounds. `bounded(index)` compares with all
    of them, for the points of at most `SUSPECTS` indices."""

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
    admits: Membership | None = None,
    rounded_numbers: bool = False,
) -> Sweeper:
    """The loops of a map whose values and Jacobian are `program`'s outputs, over points of `where`.

    `admits` says of points which of them lie in the map's domain; `rounded_numbers`, as in `run_bounded`. A program is
    compiled once, for all boxes and seeds.
    """
    block, generating, taking, bounding, choosing = _compiled(program, float(scale), admits, rounded_numbers)
    key, low, lengths = key_of(seed), where.low, where.high - where.low

    def generated(start: int, length: int) -> Sweep:
        with double():
            return _read(np.asarray(generating(np.uint64(start), key, low, lengths))[:length])

    def given(points: Array) -> Sweep:
        with double():
            return _read(np.asarray(taking(np.ascontiguousarray(_padded(points, block).T)))[: len(points)])

    def bounded(index: Array) -> Sweep:
        full = _padded(index, SUSPECTS)
        with double():
            found = choosing(full, key, low, lengths) if where.given is None else bounding(where.at(full, seed).T)
            return _read(np.asarray(found)[: len(index)])

    return Sweeper(block, generated, given, bounded)


def _padded(rows: Array, length: int) -> Array:
    """So many rows: the last one again and again."""
    return np.concatenate([rows, np.repeat(rows[-1:], length - len(rows), axis=0)])


@lru_cache(maxsize=64)
def _compiled(
    program: Program, scale: float, admits: Membership | None, rounded_numbers: bool
) -> tuple[int, Any, Any, Any, Any]:
    """The length of a block; the first loop over generated and over given points; the second over given ones and over
    those of given indices."""
    import jax
    import jax.numpy as jnp

    on_processor = jax.default_backend() == "cpu"
    block = BLOCK if on_processor else BLOCK_OF_A_GPU

    def quick(rows: Sequence[Any]) -> Any:
        inside = None if admits is None else admits(rows, jnp)
        sines = VectorSines(jnp)
        values = run(program, rows, sines if on_processor else jnp)
        size = program.inputs
        rounded = [float(rounds(program, node)) for node in program.outputs]
        weights = [rounded[size + a * size : size + (a + 1) * size] for a in range(size)]
        M = [values[size + a * size : size + (a + 1) * size] for a in range(size)]
        return _word(
            rows[0],
            values[:size],
            lambda a, b: _quick_bracket(M[a], M[b], weights[a], weights[b]),
            scale,
            inside,
            sines.far,
        )

    def generate(start: Any, key: Any, low: Any, lengths: Any) -> Any:
        return quick(rows_of(start + jnp.arange(block, dtype=np.uint64), low, lengths, key))

    def bounded(rows: Any) -> Any:
        size = program.inputs
        outputs = run_bounded(program, list(rows), jnp, rounded_numbers=rounded_numbers)
        M = [outputs[size + a * size : size + (a + 1) * size] for a in range(size)]
        values = [value for value, _ in outputs[:size]]
        return _word(rows[0], values, lambda a, b: _bracket(M[a], M[b]), scale, None)

    def choose(index: Any, key: Any, low: Any, lengths: Any) -> Any:
        return bounded(rows_of(index, low, lengths, key))

    return block, jax.jit(generate), jax.jit(lambda rows: quick(list(rows))), jax.jit(bounded), jax.jit(choose)


def _word(
    like: Any,
    values: Sequence[Any],
    bracket: Callable[[int, int], tuple[Any, Any]],
    scale: float,
    inside: Any,
    doubtful: Sequence[Any] = (),
) -> Any:
    """What is to be said of each point, in 64 bits. `bracket` gives an entry of M J Mᵀ and its bound.

    Where one of the `doubtful` conditions holds, the bounds are said to be exceeded.
    """
    import jax.numpy as jnp

    n = len(values) // 2
    zero = jnp.zeros_like(like)
    ratio, sizes, loosest = zero, [], zero
    families = (
        [(i, j) for i in range(n) for j in range(i + 1, n)],
        [(i + n, j + n) for i in range(n) for j in range(i + 1, n)],
        [(i, j + n) for i in range(n) for j in range(n)],
    )
    for pairs in families:
        largest = zero
        for a, b in pairs:
            value, bound = bracket(a, b)
            expected = scale if b == a + n else 0.0
            residual = abs(value - expected)
            bound = bound + UNIT * abs(expected)
            largest = jnp.maximum(largest, residual)
            ratio = jnp.maximum(ratio, residual / bound)
            if b == a + n:
                loosest = jnp.maximum(loosest, bound)
        sizes.append(largest)
    if doubtful:
        ratio = jnp.where(reduce(jnp.logical_or, doubtful), jnp.inf, ratio)
    furthest = reduce(jnp.maximum, [abs(value) for value in values], zero)
    undefined = ~jnp.isfinite(furthest)
    outside = None if inside is None else ~inside
    word = _half(ratio, ratio > 1.0)
    flags = (outside, undefined, loosest > RESOLVED * abs(scale))
    for k, (largest, flag) in enumerate(zip(sizes, flags, strict=True), 1):
        word = word | (_half(largest, flag) << np.uint64(16 * k))
    return word


def _quick_bracket(
    f: Sequence[Any], g: Sequence[Any], off_f: Sequence[float], off_g: Sequence[float]
) -> tuple[Any, Any]:
    """Σ ∂f/∂q ∂g/∂p − ∂f/∂p ∂g/∂q of two rows of M, with a part of its error's bound: `off` are the roundings (0 or 1)
    that the bounds of their entries are certain to contain."""
    n = len(f) // 2
    value: Any = 0.0
    bound: Any = _TINY
    for k in range(n):
        for i, j, sign in ((k, k + n, 1), (k + n, k, -1)):
            if is_zero(f[i]) or is_zero(g[j]):
                continue
            product = f[i] * g[j]
            value = value + product if sign > 0 else value - product
            bound = bound + ((n + 1 + off_f[i] + off_g[j]) * UNIT) * abs(product)
    return value, bound + UNIT * abs(value)


def _bracket(f: Sequence[tuple[Any, Any]], g: Sequence[tuple[Any, Any]]) -> tuple[Any, Any]:
    """Σ ∂f/∂q ∂g/∂p − ∂f/∂p ∂g/∂q of two rows of M, with a bound on its error, for (entry, bound) each."""
    n = len(f) // 2
    value: Any = 0.0
    bound: Any = _TINY
    for k in range(n):
        for i, j, sign in ((k, k + n, 1), (k + n, k, -1)):
            (x, ex), (y, ey) = f[i], g[j]
            if (is_zero(x) and is_zero(ex)) or (is_zero(y) and is_zero(ey)):
                continue
            product = x * y
            value = value + product if sign > 0 else value - product
            bound = bound + ((n + 1) * UNIT) * abs(product)
            if not is_zero(ex):
                bound = bound + ex * (abs(y) + ey)
            if not is_zero(ey):
                bound = bound + abs(x) * ey
    return value, bound + UNIT * abs(value)


def _half(x: Any, flag: Any) -> Any:
    """The upper half of x >= 0 as a float32, its sign taken by a flag, in the lowest bits of a word."""
    import jax
    import jax.numpy as jnp

    bits = jax.lax.bitcast_convert_type(x.astype(jnp.float32), np.uint32) >> np.uint32(16)
    if flag is not None:
        bits = bits | (flag.astype(np.uint32) << np.uint32(15))
    return bits.astype(np.uint64)


def _read(words: Array) -> Sweep:
    halves = np.ascontiguousarray(words.astype("<u8", copy=False).view("<u2").reshape(-1, 4).T)
    nothing = np.zeros(0, dtype=np.intp)
    flags = []
    for half in halves:
        flagged = half >= _SIGN
        flags.append(np.flatnonzero(flagged) if flagged.any() else nothing)
        if len(flags[-1]):
            half &= _SIZE
    exceeds, outside, undefined, unresolved = flags
    rough = np.flatnonzero(halves.max(axis=0) > _INFINITE) if halves.max() > _INFINITE else nothing
    if len(outside) or len(undefined) or len(rough):
        undefined = np.setdiff1d(undefined, outside)
        rough = np.setdiff1d(rough, np.union1d(outside, undefined))
        unusable = np.concatenate([outside, undefined, rough])
        exceeds, unresolved = np.setdiff1d(exceeds, unusable), np.setdiff1d(unresolved, unusable)
        halves[:, unusable] = 0
    ratio, QQ, PP, QP = halves
    return Sweep(ratio, QQ, PP, QP, exceeds, outside, undefined, rough, unresolved)


def number(half: Any) -> float:
    """The number that an upper half of a float32 stands for."""
    return float((np.array([half], dtype=np.uint32) << np.uint32(16)).view(np.float32)[0])
