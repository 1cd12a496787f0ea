"""Lie algebras by structure constants in fractions, for `counterexample_algebras.py`: of matrices, of names, and
what isomorphic ones have in common."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from typing import Any

if __package__:
    from canon.checker.alone import Stop
else:  # as a program's part, beside the other files
    from alone import Stop  # type: ignore

Number = tuple[Fraction, Fraction]
"""A complex number with rational parts."""
LARGEST, ZERO = 16, Fraction(0)


def rank(rows: Any) -> int:
    """The rank of a matrix of fractions."""
    rows, found = [[*row] for row in rows], 0
    for c in range(len(rows[0]) if rows else 0):
        pivot = next((k for k in range(found, len(rows)) if rows[k][c]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        for k in range(found + 1, len(rows)):
            if rows[k][c]:
                ratio = rows[k][c] / rows[found][c]
                rows[k] = [x - ratio * y for x, y in zip(rows[k], rows[found], strict=True)]
        found += 1
    return found


def solved(columns: Any, right: Any) -> list[Fraction] | None:
    """The coefficients of a combination of independent columns; None where there is none."""
    rows = [[*row, y] for row, y in zip(zip(*columns, strict=True), right, strict=True)]
    n, k = len(columns), 0
    for c in range(n):
        pivot = next((m for m in range(k, len(rows)) if rows[m][c]), None)
        if pivot is None:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][c] for x in rows[k]]
        for m in range(len(rows)):
            if m != k and rows[m][c]:
                rows[m] = [x - rows[m][c] * y for x, y in zip(rows[m], rows[k], strict=True)]
        k += 1
    return None if any(row[n] for row in rows[k:]) else [rows[c][n] for c in range(n)]


def inertia(form: Any) -> tuple[int, int]:
    """How many squares of a symmetric form are positive, and negative: by completing them."""
    form, plus, minus = [[*row] for row in form], 0, 0
    while form:
        n = range(len(form))
        k = next((k for k in n if form[k][k]), None)
        if k is None:
            pair = next(((i, j) for i, j in combinations(n, 2) if form[i][j]), None)
            if pair is None:
                break
            i, j = pair  # x_i + x_j in the place of x_i
            form[i] = [a + b for a, b in zip(form[i], form[j], strict=True)]
            for row in form:
                row[i] += row[j]
            k = i
        d = form[k][k]
        plus, minus = plus + (d > 0), minus + (d < 0)
        form = [[form[a][b] - form[a][k] * form[k][b] / d for b in n if b != k] for a in n if a != k]
    return plus, minus


@dataclass(frozen=True)
class Invariants:
    """The dimension, the Killing form's signature, the dimensions of the derived algebras and of the centre."""

    dimension: int
    signature: tuple[int, int]
    derived: tuple[int, int]
    centre: int

    @staticmethod
    def of(c: Any) -> Invariants:
        """Those of structure constants [x_i, x_j] = Σ c[i][j][k] x_k."""
        n = range(len(c))
        form = [[sum((c[i][k][m] * c[j][m][k] for k in n for m in n), ZERO) for j in n] for i in n]
        first = [c[i][j] for i, j in combinations(n, 2)]
        second = [[sum((x[i] * y[j] * c[i][j][k] for i in n for j in n if x[i] and y[j]), ZERO) for k in n]
                  for x, y in combinations(independent(first), 2)]  # fmt: skip
        whole = [[c[i][j][k] for j in n for k in n] for i in n]
        return Invariants(len(c), inertia(form), (rank(first), rank(second)), len(c) - rank(whole))


def independent(rows: Any) -> list[Any]:
    """As many of them as are independent, with the same span."""
    kept = list[Any]()
    for row in rows:
        if rank([*kept, row]) > len(kept):
            kept.append(row)
    return kept


def times(a: Any, b: Any) -> Any:
    """A product of complex matrices."""
    n = range(len(a))
    part = lambda i, j, f: sum((f(a[i][k], b[k][j]) for k in n), ZERO)
    return [[(part(i, j, lambda x, y: x[0] * y[0] - x[1] * y[1]), part(i, j, lambda x, y: x[0] * y[1] + x[1] * y[0]))
             for j in n] for i in n]  # fmt: skip


def flat(a: Any) -> list[Fraction]:
    """The real and imaginary parts of a matrix."""
    return [part for row in a for x in row for part in x]


def structure_of(matrices: Any) -> Any:
    """Structure constants of the real span under [A, B], or else −i [A, B]; None where it closes under neither, or
    the matrices depend on each other."""
    columns, n = [flat(a) for a in matrices], range(len(matrices))
    if rank(columns) < len(columns):
        return None
    for turned in (False, True):
        found = [[[ZERO] * len(matrices) for _ in n] for _ in n]
        for i, j in combinations(n, 2):
            ab, ba = times(matrices[i], matrices[j]), times(matrices[j], matrices[i])
            pairs = [zip(*rows, strict=True) for rows in zip(ab, ba, strict=True)]
            right = [[(x[0] - y[0], x[1] - y[1]) for x, y in row] for row in pairs]
            right = [[(im, -re) for re, im in row] for row in right] if turned else right
            if (row := solved(columns, flat(right))) is None:
                break
            found[i][j], found[j][i] = row, [-x for x in row]
        else:
            return found
    return None


def matrix(size: int, *entries: tuple[int, int, int]) -> Any:
    """A matrix of integers by those of its entries that aren't 0."""
    found = [[(ZERO, ZERO)] * size for _ in range(size)]
    for i, j, x in entries:
        found[i][j] = (Fraction(x), ZERO)
    return found


def orthogonal(p: int, q: int, size: int = 0) -> list[Any]:
    """so(p, q), in matrices of that size."""
    sign = [1] * p + [-1] * q
    return [matrix(size or p + q, (i, j, sign[j]), (j, i, -sign[i])) for i, j in combinations(range(p + q), 2)]


def fundamental() -> dict[str, list[Any]]:
    """Galilei's algebra, and sl(2, R), as matrices."""
    turns = orthogonal(3, 0, 5)
    boosts, shifts = ([matrix(5, (k, column, 1)) for k in range(3)] for column in (3, 4))
    galilei = [*turns, *boosts, *shifts, matrix(5, (3, 4, 1))]
    special = [matrix(2, (0, 0, 1), (1, 1, -1)), matrix(2, (0, 1, 1)), matrix(2, (1, 0, 1))]
    return {"galilei": galilei, "sl(2,r)": special}


def summand(name: str) -> Any:
    """Structure constants of an algebra by its name."""
    name = re.sub(r"\s", "", name.lower())
    if name in fundamental():
        return structure_of(fundamental()[name])
    if m := re.fullmatch(r"(so|iso|e)\((\d+)(?:,(\d+))?\)", name):
        p, q = int(m[2]), int(m[3] or 0)
        if 2 <= p + q <= 5 and not (m[1] == "e" and q):
            size = p + q + (m[1] != "so")
            shifts = [matrix(size, (k, p + q, 1)) for k in range(p + q)] if m[1] != "so" else []
            return structure_of([*orthogonal(p, q, size), *shifts])
    if m := re.fullmatch(r"u\(1\)(?:\^(\d+))?", name):
        n = int(m[1] or 1)
        if n <= LARGEST:
            return [[[ZERO] * n for _ in range(n)] for _ in range(n)]
    raise Stop("not shown", f"the algebra {name[:40]}")


def named(name: str) -> Invariants:
    """The invariants of a direct sum of algebras by their names."""
    parts = [summand(part) for part in str(name).split("+")]
    size = sum(map(len, parts))
    if size > LARGEST:
        raise Stop("not shown", "an algebra of so many dimensions")
    found, before = [[[ZERO] * size for _ in range(size)] for _ in range(size)], 0
    for part in parts:
        for i, j, k in product(range(len(part)), repeat=3):
            found[before + i][before + j][before + k] = part[i][j][k]
        before += len(part)
    return Invariants.of(found)
