"""What a sweep says of a point: its largest residuals and what is wrong with it, in one word of 64 bits.

A compiler that is given several results computes what they share several times over; hence the one word.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from typing import Any, Final, NamedTuple

import numpy as np

from canon.numeric.precision import UNIT
from canon.numeric.running_bound import is_zero

Array = np.ndarray

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


def word(
    like: Any,
    values: Sequence[Any],
    bracket: Callable[[int, int], tuple[Any, Any]],
    scale: float,
    inside: Any = None,
    doubtful: Sequence[Any] = (),
    numbers: Any = np,
) -> Any:
    """What is to be said of each point, in 64 bits. `bracket` gives an entry of M J Mᵀ and its bound.

    Where one of the `doubtful` conditions holds, the bounds are said to be exceeded. `numbers` is the module that
    computes, numpy or jax.numpy.
    """
    n = len(values) // 2
    zero = numbers.zeros_like(like)
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
            largest = numbers.maximum(largest, residual)
            ratio = numbers.maximum(ratio, residual / bound)
            if b == a + n:
                loosest = numbers.maximum(loosest, bound)
        sizes.append(largest)
    if doubtful:
        ratio = numbers.where(reduce(numbers.logical_or, doubtful), numbers.inf, ratio)
    furthest = reduce(numbers.maximum, [abs(value) for value in values], zero)
    undefined = ~numbers.isfinite(furthest)
    outside = None if inside is None else ~inside
    word = _half(ratio, ratio > 1.0)
    flags = (outside, undefined, loosest > RESOLVED * abs(scale))
    for k, (largest, flag) in enumerate(zip(sizes, flags, strict=True), 1):
        word = word | (_half(largest, flag) << np.uint64(16 * k))
    return word


def quick_bracket(
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


def bracket(f: Sequence[tuple[Any, Any]], g: Sequence[tuple[Any, Any]]) -> tuple[Any, Any]:
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
    bits = x.astype(np.float32).view(np.uint32) >> np.uint32(16)
    if flag is not None:
        bits = bits | (flag.astype(np.uint32) << np.uint32(15))
    return bits.astype(np.uint64)


def read(words: Array) -> Sweep:
    """What words say of N points."""
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
