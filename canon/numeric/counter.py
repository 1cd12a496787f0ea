"""Sample points from a counter: the k-th point of a seed is a function of k, so that none need be kept.

The generator is SplitMix64 (Steele, Lea and Flood, OOPSLA 2014), whose state is a counter. It gives the same numbers
in numpy and, inside a compiled program, in jax.
"""

from __future__ import annotations

from numbers import Integral
from typing import Any, Final

import numpy as np

from canon.errors import InputError

Array = np.ndarray

_GOLDEN: Final = 0x9E3779B97F4A7C15
_FIRST: Final = np.uint64(0xBF58476D1CE4E5B9)
_SECOND: Final = np.uint64(0x94D049BB133111EB)
_ONE: Final = np.uint64(0x3FF0000000000000)
"""The bits of 1.0."""


def key_of(seed: int) -> np.uint64:
    """The generator's first state for a seed. **Raises:** `InputError` for what is no whole number."""
    if not isinstance(seed, Integral):
        raise InputError(f"a whole number is needed, not {seed!r}", "seed")
    state = np.array([int(seed) % 2**64], dtype=np.uint64)
    return _scrambled(state * np.uint64(_GOLDEN) + np.uint64(1))[0]


def fractions(index: Any, column: int, columns: int, key: Any) -> Any:
    """Numbers in [0, 1), uniform: those of one variable (`column` of `columns`) for points of these indices.

    `index` is an array of uint64, of numpy or of jax.
    """
    counter = index * np.uint64(columns) + np.uint64(column)
    bits = (_scrambled(counter * np.uint64(_GOLDEN) + key) >> np.uint64(12)) | _ONE
    if isinstance(bits, np.ndarray):
        return bits.view(np.float64) - 1.0
    import jax

    return jax.lax.bitcast_convert_type(bits, np.float64) - 1.0


def rows_of(index: Any, low: Any, lengths: Any, key: Any) -> list[Any]:
    """The points of these indices in the box low < z < low + lengths, one row a variable."""
    size = len(low)
    return [low[k] + lengths[k] * fractions(index, k, size, key) for k in range(size)]


def _scrambled(z: Any) -> Any:
    z = (z ^ (z >> np.uint64(30))) * _FIRST
    z = (z ^ (z >> np.uint64(27))) * _SECOND
    return z ^ (z >> np.uint64(31))
