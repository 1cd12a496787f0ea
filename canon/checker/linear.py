"""Linear algebra in exact fractions: rank, null space, coordinates, signature."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

Rows = list[list[Fraction]]


def unit(size: int) -> Rows:
    """The unit vectors."""
    return [[Fraction(int(i == j)) for j in range(size)] for i in range(size)]


def reduced(rows: Sequence[Sequence[Fraction]]) -> tuple[Rows, list[int]]:
    """The reduced echelon form, and the columns of its pivots."""
    out, pivots = [list(row) for row in rows], list[int]()
    for column in range(len(out[0]) if out else 0):
        k = next((r for r in range(len(pivots), len(out)) if out[r][column]), None)
        if k is None:
            continue
        top = len(pivots)
        out[top], out[k] = out[k], out[top]
        scale = out[top][column]
        out[top] = [x / scale for x in out[top]]
        for r, row in enumerate(out):
            if r != top and row[column]:
                out[r] = [x - row[column] * y for x, y in zip(row, out[top], strict=True)]
        pivots.append(column)
    return out[: len(pivots)], pivots


def rank(rows: Sequence[Sequence[Fraction]]) -> int:
    """The rank."""
    return len(reduced(rows)[1]) if rows else 0


def kernel(rows: Sequence[Sequence[Fraction]]) -> Rows:
    """A basis of the vectors x with rows · x = 0."""
    form, pivots = reduced(rows)
    size, found = len(rows[0]), []
    for free in (k for k in range(size) if k not in pivots):
        vector = [Fraction(int(k == free)) for k in range(size)]
        for row, pivot in zip(form, pivots, strict=True):
            vector[pivot] = -row[free]
        found.append(vector)
    return found


def solved(basis: Sequence[Sequence[Fraction]], vector: Sequence[Fraction]) -> list[Fraction] | None:
    """The coordinates of a vector in a basis; None where it isn't in its span."""
    columns = [[*(row[k] for row in basis), vector[k]] for k in range(len(vector))]
    form, pivots = reduced(columns)
    if len(basis) in pivots:
        return None
    found = [Fraction(0)] * len(basis)
    for row, pivot in zip(form, pivots, strict=True):
        found[pivot] = row[-1]
    return found


def signature(form: Sequence[Sequence[Fraction]]) -> tuple[int, int, int]:
    """The numbers of positive, negative and zero squares of a symmetric form (Sylvester), by Lagrange's reduction."""
    rows, counts = [list(row) for row in form], [0, 0]
    while rows:
        n = len(rows)
        k = next((i for i in range(n) if rows[i][i]), None)
        if k is None:
            pair = next(((i, j) for i in range(n) for j in range(n) if rows[i][j]), None)
            if pair is None:
                break
            i, j = pair  # e_i + e_j has a square
            rows[i] = [x + y for x, y in zip(rows[i], rows[j], strict=True)]
            for row in rows:
                row[i] += row[j]
            k = i
        d = rows[k][k]
        counts[d < 0] += 1
        rest = [i for i in range(n) if i != k]
        rows = [[rows[i][j] - rows[i][k] * rows[k][j] / d for j in rest] for i in rest]
    return counts[0], counts[1], len(form) - sum(counts)
