"""Semisimple real Lie algebras of small dimension, known by the signature of their Killing form alone.

Up to dimension 11 no two semisimple real algebras of one dimension have the same signature, which counting all sums of
real forms shows; beyond that some have. So an algebra whose constants are no rational numbers has a name here once
its Killing form is enclosed well enough.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Final

from canon.mechanics.algebra.complex_type import ComplexType
from canon.mechanics.algebra.identity import Identity, RealSimple
from canon.mechanics.algebra.real_forms import compact_dimensions

LARGEST: Final = 24
_TYPES: Final = tuple(
    ComplexType(*kind) for kind in (("A", 1), ("A", 2), ("B", 2), ("G", 2), ("A", 3), ("B", 3), ("C", 3), ("A", 4))
)
"""All complex types of at most 24 dimensions."""


def semisimple_of(positive: int, negative: int) -> Identity | None:
    """The only semisimple algebra whose Killing form has so many positive and negative squares; None: there are more.

    None too where there is none, or the dimension is beyond `LARGEST`.
    """
    dimension = positive + negative
    if not 0 < dimension <= LARGEST:
        return None
    fitting = [parts for parts in _sums(dimension, _simple(dimension)) if _negative(parts) == negative]
    if len(fitting) != 1:
        return None
    simple = tuple(sorted(fitting[0]))
    return Identity(simple, 0, (), "", simple, dimension)


def _negative(parts: tuple[RealSimple, ...]) -> int:
    return sum(part.compact_dimension for part in parts)


@cache
def _simple(most: int) -> tuple[RealSimple, ...]:
    """All simple real algebras of at most a dimension; forms that aren't told apart occur as often as there are."""
    found = [RealSimple(kind, True, kind.dimension) for kind in _TYPES if 2 * kind.dimension <= most]
    found += [RealSimple(kind, False, compact) for kind in _TYPES if kind.dimension <= most
              for compact in compact_dimensions(kind)]  # fmt: skip
    return tuple(sorted(found))


def _sums(dimension: int, kinds: tuple[RealSimple, ...]) -> Iterator[tuple[RealSimple, ...]]:
    """All sums of these with a dimension, each once."""
    if dimension == 0:
        yield ()
    for k, kind in enumerate(kinds):
        if kind.dimension <= dimension:
            for rest in _sums(dimension - kind.dimension, kinds[k:]):
                yield (kind, *rest)
