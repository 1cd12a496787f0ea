"""Tables of brackets most of whose entries aren't 0, as in a basis chosen at random: by products of matrices.

Jacobi's identity says that every ad x is a derivation, ad [x, y] = [ad x, ad y] for all y. Where it is one for x and
for y, it is one for [x, y], since [ad x, ad y] is a derivation then. So it suffices to look at elements that generate
the algebra, of which two at random mostly do.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from fractions import Fraction
from math import lcm
from typing import Final

from flint import fmpq, fmpq_mat, fmpz_mat, nmod_mat

from canon.mechanics.algebra.coefficients import Number

PRIME: Final = (1 << 61) - 1
SHARE: Final = 0.2
"""The share of entries that aren't 0 from which a table counts as full."""
SMALLEST: Final = 6
ATTEMPTS: Final = 4

Table = Mapping[tuple[int, int], Mapping[int, Number]]


def full_table(constants: Table, size: int) -> fmpq_mat | None:
    """The constants C^c_ab as a matrix of row a and column b·size + c, where they are rational and most aren't 0."""
    entries = sum(len(row) for row in constants.values())
    if size < SMALLEST or entries < SHARE * size**2 * (size - 1) / 2:
        return None
    flat = [fmpq(0)] * size**3
    for (a, b), row in constants.items():
        for c, value in row.items():
            if not isinstance(value, Fraction):
                return None
            number = fmpq(value.numerator, value.denominator)
            flat[(a * size + b) * size + c] = number
            flat[(b * size + a) * size + c] = -number
    return fmpq_mat(size, size * size, flat)


def ad(table: fmpq_mat, x: list[fmpq]) -> fmpq_mat:
    """ad x, whose column b is [x, e_b]."""
    n = table.nrows()
    return fmpq_mat(n, n, (fmpq_mat(1, n, x) * table).entries()).transpose()


def ad_of_basis(table: fmpq_mat, a: int) -> fmpq_mat:
    """ad e_a, whose column b is [e_a, e_b]."""
    n = table.nrows()
    return fmpq_mat(n, n, [table[a, b * n + c] for c in range(n) for b in range(n)])


def killing_form(table: fmpq_mat) -> fmpq_mat:
    """K_ab = tr(ad e_a ad e_b)."""
    n = table.nrows()
    turned = [entry for row in table.tolist() for entry in _turned(row, n)]
    return table * fmpq_mat(n, n * n, turned).transpose()


def _turned(row: list[fmpq], n: int) -> list[fmpq]:
    """The transpose of a matrix given by its rows one after the other."""
    return [row[c * n + b] for b in range(n) for c in range(n)]


def obeys_jacobi(table: fmpq_mat) -> bool:
    """Whether Jacobi's identity holds, for all triples."""
    n = table.nrows()
    numbers = _whole(table)
    # entries of ad e_a are C^c_ab in row c and column b: side by side, and one below the other
    rows = [[row[b * n : (b + 1) * n] for b in range(n)] for row in numbers.tolist()]  # rows[a][b][c]
    beside = fmpz_mat(n, n * n, [rows[a][b][c] for c in range(n) for a in range(n) for b in range(n)])
    flat = [rows[a][b][c] for a in range(n) for c in range(n) for b in range(n)]
    below, each = fmpz_mat(n * n, n, flat), fmpz_mat(n, n * n, flat)
    for x in _generators(numbers):
        X = fmpz_mat(n, n, (fmpz_mat(1, n, x) * numbers).entries()).transpose()
        left, right = (X * beside).tolist(), (below * X).entries()
        # entry (c, b) of ad_x ad_a, of ad_a ad_x, and of ad_[x, e_a] = Σ_d X_da ad_d
        first = [left[c][a * n + b] for a in range(n) for c in range(n) for b in range(n)]
        third = (X.transpose() * each).entries()
        if any(u - v != w for u, v, w in zip(first, right, third, strict=True)):
            return False
    return True


def generators(table: fmpq_mat) -> list[list[fmpq]]:
    """Elements that generate the algebra."""
    return [[fmpq(v) for v in x] for x in _generators(_whole(table))]


def _whole(table: fmpq_mat) -> fmpz_mat:
    """The table times its common denominator, as of a basis so scaled."""
    scale = lcm(*(int(entry.q) for entry in table.entries()))
    return fmpz_mat((table * fmpq(scale)).numer_denom()[0])


def _generators(numbers: fmpz_mat) -> list[list[int]]:
    """Vectors that generate the algebra: a few at random, where words in them span it modulo a prime, or the basis."""
    n, rng = numbers.nrows(), random.Random(0)
    table = nmod_mat(numbers, PRIME)
    found = [[rng.randint(-2, 2) for _ in range(n)]]
    for _ in range(ATTEMPTS):
        found.append([rng.randint(-2, 2) for _ in range(n)])
        space = nmod_mat(len(found), n, [v % PRIME for x in found for v in x], PRIME)
        ads = [nmod_mat(n, n, (row * table).entries(), PRIME) for row in _each_row(space)]  # row b is [x, e_b]
        rank = 0
        while space.rank() > rank:
            rank = space.rank()
            entries = [entry for part in (space, *(space * X for X in ads)) for entry in part.entries()]
            reduced, size = nmod_mat(len(entries) // n, n, entries, PRIME).rref()
            space = nmod_mat(size, n, reduced.entries()[: size * n], PRIME)
        if rank == n:
            return found
    return [[int(i == j) for j in range(n)] for i in range(n)]


def _each_row(values: nmod_mat) -> list[nmod_mat]:
    n, entries = values.ncols(), values.entries()
    return [nmod_mat(1, n, entries[k * n : (k + 1) * n], PRIME) for k in range(values.nrows())]
