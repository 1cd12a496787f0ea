"""Sample points of a domain: boxes, given points, and the conditions of formulas."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import NO_NUMBER, InputError
from canon.expected import listed, real_array
from canon.numeric.counter import key_of, rows_of

Array = np.ndarray
MOST_POINTS: Final = 10**6
"""The most random points that are kept at once."""
DEFAULT: Final = (-1.0, 1.0)
DEFAULT_POSITIVE: Final = (0.1, 2.0)


@dataclass(frozen=True)
class Points:
    """Where a map is audited: uniformly in the box `low` < z < `high`, or at `given` points (N, 2n)."""

    low: Array
    high: Array
    given: Array | None = None

    @property
    def lengths(self) -> Array:
        """The length over which each variable ranges."""
        length = self.high - self.low
        return np.where(length > 0, length, np.maximum(np.abs(self.high), 1e-300))

    def blocks(self, count: int, block: int, seed: int) -> Iterator[Array]:
        """`count` points (or the given ones), `block` at a time."""
        if self.given is not None:
            for start in range(0, len(self.given), block):
                yield self.given[start : start + block]
            return
        for start in range(0, count, block):
            yield self.at(np.arange(start, min(start + block, count), dtype=np.uint64), seed)

    def at(self, index: Array, seed: int) -> Array:
        """The points (N, 2n) of these indices (uint64): those of one seed are a sequence, given ones a list."""
        if self.given is not None:
            return self.given[index.astype(int)]
        return np.stack(rows_of(index, self.low, self.high - self.low, key_of(seed)), axis=1)

    def __str__(self) -> str:
        if self.given is not None:
            return f"{len(self.given)} given points"
        sides = {(float(a), float(b)) for a, b in zip(self.low, self.high, strict=True)}
        if len(sides) == 1:
            ((a, b),) = sides
            return f"({a:.12g}, {b:.12g}) for each variable"
        return " × ".join(f"({a:.12g}, {b:.12g})" for a, b in zip(self.low, self.high, strict=True))


def points_of(domain: Any, names: Sequence[str], defaults: Sequence[tuple[float, float]]) -> Points:
    """The points that a `domain` means: None, one (low, high), 2n of them, a table by name, or an array (N, 2n).

    **Raises:** `InputError` for anything else.
    """
    size = len(names)
    if isinstance(domain, np.ndarray):
        if domain.ndim != 2 or domain.shape[1] != size or not len(domain):
            raise InputError(f"an array of points has shape (N, {size}), not {domain.shape}", "domain")
        given = real_array(domain, "domain").copy()  # the caller may change its own
        if not np.all(np.isfinite(given)):
            raise InputError("a point that is not finite", "domain")
        return Points(given.min(axis=0), given.max(axis=0), given)
    if isinstance(domain, Mapping):
        table = {str(name): side for name, side in domain.items()}
        for name in table:
            if name not in names:
                raise InputError(f"{name!r} is none of {', '.join(names)}", "domain")
        sides: Any = [table.get(name, default) for name, default in zip(names, defaults, strict=True)]
    elif domain is None:
        sides = list(defaults)
    else:
        sides = listed(domain, "pairs (low, high), or one pair,", "domain")
        if len(sides) == 2 and all(np.ndim(side) == 0 for side in sides):
            sides = [tuple(sides)] * size
    try:
        if np.iscomplexobj(np.asarray(sides)):  # numpy would drop the imaginary parts
            raise TypeError("complex numbers")
        low, high = np.array(sides, dtype=float).reshape(size, 2).T
    except NO_NUMBER as reason:
        raise InputError(
            f"a pair (low, high), or one for each of the {size} variables, is expected", "domain"
        ) from reason
    if not np.all(np.isfinite([low, high])) or np.any(low > high):
        raise InputError("each pair is (low, high) with finite low <= high", "domain")
    return Points(low, high)
