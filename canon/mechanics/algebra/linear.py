"""Exact linear algebra over the rationals: null spaces, coordinates, signatures (python-flint).

Vectors are rows. A subspace is a matrix whose rows are its basis, in reduced echelon form.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from fractions import Fraction

from flint import fmpq, fmpq_mat, fmpz_mat

Vector = Sequence[fmpq]


def rational(value: Fraction | int) -> fmpq:
    """The number as flint has it."""
    return fmpq(value.numerator, value.denominator)


def fraction(value: fmpq) -> Fraction:
    """The number as Python has it."""
    return Fraction(int(value.p), int(value.q))


def matrix(rows: Iterable[Vector], width: int) -> fmpq_mat:
    """The matrix of these rows; `width` counts where there is none."""
    listed = list(rows)
    return fmpq_mat(len(listed), width, [entry for row in listed for entry in row])


def rows(values: fmpq_mat) -> list[list[fmpq]]:
    """The rows of a matrix."""
    return values.tolist()


def span(vectors: Iterable[Vector], width: int) -> fmpq_mat:
    """The subspace that the vectors span."""
    given = matrix(vectors, width)
    if not given.nrows():
        return given
    reduced, rank = given.rref()
    return matrix(rows(reduced)[:rank], width)


def pivots(space: fmpq_mat) -> list[int]:
    """The column of the first entry of each row of a subspace."""
    return [next(k for k, entry in enumerate(row) if entry != 0) for row in rows(space)]


def null_space(equations: fmpq_mat) -> fmpq_mat:
    """All v with A v = 0."""
    width = equations.ncols()
    reduced = span(rows(equations), width)
    leading = pivots(reduced)
    table = rows(reduced)
    found = []
    for free in (k for k in range(width) if k not in set(leading)):
        v = [fmpq(0)] * width
        v[free] = fmpq(1)
        for row, column in zip(table, leading, strict=True):
            v[column] = -row[free]
        found.append(v)
    return span(found, width)


def contains(space: fmpq_mat, vector: Vector) -> bool:
    """Whether a vector lies in a subspace."""
    rest = list(vector)
    for row, column in zip(rows(space), pivots(space), strict=True):
        factor = rest[column]
        if factor != 0:
            rest = [a - factor * b for a, b in zip(rest, row, strict=True)]
    return all(entry == 0 for entry in rest)


def intersection(a: fmpq_mat, b: fmpq_mat) -> fmpq_mat:
    """The vectors that lie in both subspaces."""
    width = a.ncols()
    if not a.nrows() or not b.nrows():
        return matrix([], width)
    combinations = null_space(matrix([*rows(a), *rows(b)], width).transpose())
    return span(rows(matrix([row[: a.nrows()] for row in rows(combinations)], a.nrows()) * a), width)


def complement(space: fmpq_mat, within: fmpq_mat) -> fmpq_mat:
    """Vectors of the second space that, with the first, which lies in it, are a basis of the second."""
    known, found = space, []
    for row in rows(within):
        if not contains(known, row):
            found.append(row)
            known = span([*rows(known), row], within.ncols())
    return matrix(found, within.ncols())


def coordinates(basis: fmpq_mat, vectors: fmpq_mat) -> fmpq_mat:
    """The rows of `vectors` as combinations of the rows of `basis`, in which they lie; **raises** ValueError else."""
    independent = pivots(span(rows(basis), basis.ncols()))
    if len(independent) < basis.nrows():
        raise ValueError("the basis is linearly dependent")
    picked = matrix([[row[k] for k in independent] for row in rows(basis)], len(independent))
    values = matrix([[row[k] for k in independent] for row in rows(vectors)], len(independent))
    found = values * picked.inv() if basis.nrows() else matrix([[]] * vectors.nrows(), 0)
    if found * basis != vectors:
        raise ValueError("a vector lies outside of the span")
    return found


def signature(form: fmpq_mat) -> tuple[int, int, int]:
    """How many positive, negative and zero squares a symmetric form has.

    Its characteristic polynomial has real roots only, so that Descartes' rule of signs counts them exactly.
    """
    size = form.nrows()
    if not size:
        return 0, 0, 0
    scaled, _ = form.numer_denom()
    coefficients = [int(c) for c in fmpz_mat(scaled).charpoly().coeffs()]
    zero = next(k for k, c in enumerate(coefficients) if c)
    signs = [c > 0 for c in coefficients if c]
    positive = sum(a != b for a, b in itertools.pairwise(signs))
    return positive, size - zero - positive, zero
