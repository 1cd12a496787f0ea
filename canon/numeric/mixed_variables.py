"""Which type of generating function is best conditioned for a map: one of types 1 to 4 in each degree of freedom.

With an old argument x and a new one y in each degree, the map has a generating function of these where the block
∂y/∂v of its Jacobian is regular, v being the old variables that are no arguments. Arnold (1989), section 48.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np

Array = np.ndarray
Types = tuple[int, ...]
ALL_UP_TO: Final = 5
"""Degrees of freedom up to which all 4ⁿ patterns are compared; beyond, they are improved one degree at a time."""

FLOOR: Final = 1e-12
COMPARABLE: Final = 10.0
"""A type that is better conditioned by no more than this isn't worth a change."""


@dataclass(frozen=True)
class Pattern:
    """The mixed variables of a type: indices into z = (q, p), and the signs in conjugate = sign · ∂F/∂argument."""

    types: Types

    def _momenta(self, old: bool) -> Array:
        return np.array([kind in ((3, 4) if old else (2, 4)) for kind in self.types])

    @property
    def old_arguments(self) -> Array:
        """Where the old arguments x stand in z."""
        return np.arange(len(self.types)) + len(self.types) * self._momenta(True)

    @property
    def old_conjugates(self) -> Array:
        """Where the other old variables v stand in z."""
        return np.arange(len(self.types)) + len(self.types) * ~self._momenta(True)

    @property
    def new_arguments(self) -> Array:
        """Where the new arguments y stand in Z."""
        return np.arange(len(self.types)) + len(self.types) * self._momenta(False)

    @property
    def new_conjugates(self) -> Array:
        """Where the other new variables stand in Z."""
        return np.arange(len(self.types)) + len(self.types) * ~self._momenta(False)

    @property
    def old_signs(self) -> Array:
        """v = sign · ∂F/∂x: −1 where x is a momentum."""
        return np.where(self._momenta(True), -1.0, 1.0)

    @property
    def new_signs(self) -> Array:
        """The other new variable = sign · ∂F/∂y: +1 where y is a momentum."""
        return np.where(self._momenta(False), 1.0, -1.0)


@dataclass(frozen=True)
class Conditioned:
    """A type, and its `condition`: the most by which it amplifies an error, infinite where a caustic is in reach.

    `compared` is the number of types among which it was chosen.
    """

    types: Types
    condition: float
    compared: int


def condition_of(types: Types, M: Array) -> float:
    """max ‖(∂y/∂v)⁻¹‖ ‖M‖ over Jacobians M (N, 2n, 2n); infinite where det ∂y/∂v vanishes or changes its sign."""
    values, same_sign = _singular_values(types, M)
    least = values[:, -1]
    if not same_sign or not least.min() > 0:
        return float("inf")
    return float((np.linalg.norm(M, ord=2, axis=(1, 2)) / least).max())


def best_conditioned(M: Array) -> Conditioned:
    """The type with the smallest condition for Jacobians M (N, 2n, 2n), in units that make variables comparable."""
    n = M.shape[1] // 2
    if n <= ALL_UP_TO:
        patterns: Iterable[Types] = product((2, 3, 1, 4), repeat=n)
        scored = [(condition_of(types, M), types) for types in patterns]
        condition, types = min(scored, key=lambda pair: pair[0])
        return Conditioned(types, condition, len(scored))
    compared = 0
    best: tuple[float, Types] | None = None
    for kind in (2, 3, 1, 4):
        types, tried = _improved((kind,) * n, M)
        compared += tried
        condition = condition_of(types, M)
        if best is None or condition < best[0]:
            best = condition, types
    assert best is not None
    return Conditioned(best[1], best[0], compared)


def comparable(M: Array, own: Types) -> tuple[Types, ...]:
    """The types that are conditioned for M about as well as the best: those with the fewest changes from `own` first.

    That is `own` alone, where it is one of them; and the best alone in more than `ALL_UP_TO` degrees of freedom.
    """
    best = best_conditioned(M)
    limit = COMPARABLE * best.condition
    if condition_of(own, M) <= limit:
        return (own,)
    if len(own) > ALL_UP_TO:
        return (best.types,)
    found = [types for types in product((2, 3, 1, 4), repeat=len(own)) if condition_of(types, M) <= limit]
    return tuple(sorted(found, key=lambda types: sum(a != b for a, b in zip(types, own, strict=True))))


def _improved(types: Types, M: Array) -> tuple[Types, int]:
    """The types changed in one degree of freedom after another, as long as the block's volume grows."""
    volume, tried, changed = _volume(types, M), 1, True
    while changed:
        changed = False
        for k in range(len(types)):
            for kind in (1, 2, 3, 4):
                other = (*types[:k], kind, *types[k + 1 :])
                candidate = _volume(other, M)
                tried += 1
                if candidate > volume + 1e-9:
                    types, volume, changed = other, candidate, True
    return types, tried


def _volume(types: Types, M: Array) -> float:
    """log |det ∂y/∂v| at the worst point, with singular values that vanish counted as very small."""
    values, _ = _singular_values(types, M)
    return float(np.log(np.maximum(values, FLOOR)).sum(axis=1).min())


def _singular_values(types: Sequence[int], M: Array) -> tuple[Array, bool]:
    pattern = Pattern(tuple(types))
    block = M[:, pattern.new_arguments[:, None], pattern.old_conjugates]
    signs = np.sign(np.linalg.slogdet(block)[0])
    return np.linalg.svd(block, compute_uv=False), bool(np.all(signs == signs[0]))
