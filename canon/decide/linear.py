"""Bases over Q among the arguments of exponentials and trigonometric functions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from canon.decide.fraction_field import Element
from canon.decide.ring import Monomial
from canon.decide.tape import ZERO, Unsupported

if TYPE_CHECKING:
    from canon.decide.tower import Tower

Vector = dict[Monomial, Fraction]
Combination = dict[int, Fraction]
Row = tuple[Monomial, Vector, Combination]


def rational_basis(tower: Tower, old: Sequence[Element], new: Sequence[Element]) -> tuple[list[Combination], list[int]]:
    """Each new element as a Q-combination of the old ones and of chosen new ones (simplest first).

    Returns the combinations (by position in old + new) and the chosen positions.
    """
    vectors = _numerators(tower, [*old, *new])
    rows: list[Row] = []
    chosen: list[int] = []
    out: dict[int, Combination] = {}
    first = len(old)
    order = [*range(first), *sorted(range(first, len(vectors)), key=lambda i: (len(vectors[i]), i))]
    for i in order:
        rest, combination = _reduced(rows, vectors[i])
        if not rest:
            if i >= first:
                out[i] = {k: c for k, c in combination.items() if c}
            continue
        pivot = next(iter(rest))
        scale = rest[pivot]
        vector = {m: c / scale for m, c in rest.items()}
        row = {k: -c / scale for k, c in combination.items()}
        row[i] = 1 / scale
        rows = [_eliminated(other, pivot, vector, row) for other in rows]
        rows.append((pivot, vector, row))
        if i >= first:
            chosen.append(i)
            out[i] = {i: Fraction(1)}
    return [out[i] for i in range(first, len(vectors))], chosen


def divided_basis(
    tower: Tower, old: Sequence[Element], new: Sequence[Element], most: int
) -> tuple[list[Combination], dict[int, int]]:
    """`rational_basis`, with the denominators that make whole multiples of the chosen elements' fractions.

    Returns the combinations, and for each chosen position the number by which the element there is to be divided.

    Raises: Unsupported where a multiple, or the coefficient of an old element, is larger than `most`.
    """
    combinations, chosen = rational_basis(tower, old, new)
    parts = dict.fromkeys(chosen, 1)
    for combination in combinations:
        for k, q in combination.items():
            if k in parts:
                parts[k] = math.lcm(parts[k], q.denominator)
    if any(abs(q * parts.get(k, 1)) > most for combination in combinations for k, q in combination.items()):
        raise Unsupported("multiples of an angle, or powers of an exponential, too high to compute with")
    return combinations, parts


def _numerators(tower: Tower, elements: Sequence[Element]) -> list[Vector]:
    """The numerators over a common denominator, as vectors of coefficients."""
    least: dict[int, int] = {}
    for _, den in elements:
        for k, e in den.items():
            least[k] = max(least.get(k, 0), e)
    out = []
    for n, den in elements:
        for k, e in least.items():
            if e > den.get(k, 0):
                n = tower.field.normal(tower.ring.times(n, tower.field.factor_power(k, e - den.get(k, 0))))
        out.append(tower.ring.terms(n))
    return out


def _reduced(rows: Sequence[Row], vector: Vector) -> tuple[Vector, Combination]:
    rest, combination = dict(vector), {}
    for pivot, basis, own in rows:
        c = rest.get(pivot)
        if c:
            _subtract(rest, basis, c)
            for k, x in own.items():
                combination[k] = combination.get(k, ZERO) + c * x
    return rest, combination


def _eliminated(row: Row, pivot: Monomial, vector: Vector, combination: Combination) -> Row:
    c = row[1].get(pivot)
    if not c:
        return row
    basis, own = dict(row[1]), dict(row[2])
    _subtract(basis, vector, c)
    _subtract(own, combination, c)
    return row[0], basis, own


def _subtract(target: dict, other: dict, factor: Fraction) -> None:
    for k, x in other.items():
        value = target.get(k, ZERO) - factor * x
        if value:
            target[k] = value
        else:
            target.pop(k, None)
