"""Levi's decomposition g = S ⊕ R: a semisimple subalgebra and the radical."""

from __future__ import annotations

from itertools import combinations, pairwise

from flint import fmpq, fmpq_mat

from canon.mechanics.algebra import linear
from canon.mechanics.algebra.ideals import radical, series_of, whole
from canon.mechanics.algebra.lie_algebra import LieAlgebra


def levi_decomposition(algebra: LieAlgebra) -> tuple[fmpq_mat, fmpq_mat]:
    """A semisimple subalgebra S with g = S ⊕ R, and the radical R, each as rows.

    A complement of R is corrected by elements of R, R', R'' … in turn, each time by linear equations that Levi's
    theorem says are soluble: de Graaf, Lie Algebras: Theory and Algorithms (2000), 4.13.
    """
    n = algebra.dimension
    R = radical(algebra)
    S = linear.complement(R, whole(algebra))
    if not R.nrows() or not S.nrows():
        return S, R
    series = [*series_of(algebra, R), linear.matrix([], n)]
    for upper, lower in pairwise(series):
        if upper.nrows() > lower.nrows():
            S = _corrected(algebra, S, R, upper, lower)
    return S, R


def _corrected(algebra: LieAlgebra, S: fmpq_mat, R: fmpq_mat, upper: fmpq_mat, lower: fmpq_mat) -> fmpq_mat:
    """S, which closes modulo `upper`, changed by elements of `upper` so that it closes modulo `lower`."""
    n = algebra.dimension
    layer = linear.complement(lower, upper)
    size, height = S.nrows(), layer.nrows()
    rest = linear.complement(upper, R)
    full = linear.matrix([*linear.rows(S), *linear.rows(layer), *linear.rows(lower), *linear.rows(rest)], n)
    to_full = full.inv()
    s, u = linear.rows(S), linear.rows(layer)

    def parts(vector: list[fmpq]) -> tuple[list[fmpq], list[fmpq]]:
        (row,) = linear.rows(linear.matrix([vector], n) * to_full)
        return row[:size], row[size : size + height]

    # [s_i + r_i, s_j + r_j] = Σ c_ijk (s_k + r_k) modulo `lower`, with r_i = Σ t_ia u_a: linear in t
    acts = [[parts(algebra.product(x, y))[1] for y in u] for x in s]
    equations: list[list[fmpq]] = []
    right: list[fmpq] = []
    for i, j in combinations(range(size), 2):
        c, defect = parts(algebra.product(s[i], s[j]))
        for b in range(height):
            row = [fmpq(0)] * (size * height)
            for a in range(height):
                row[j * height + a] += acts[i][a][b]
                row[i * height + a] -= acts[j][a][b]
            for k in range(size):
                row[k * height + b] -= c[k]
            equations.append(row)
            right.append(-defect[b])
    solution = _solved(equations, right, size * height)
    moved = []
    for i in range(size):
        vector = list(s[i])
        for a in range(height):
            t = solution[i * height + a]
            if t != 0:
                vector = [x + t * y for x, y in zip(vector, u[a], strict=True)]
        moved.append(vector)
    return linear.matrix(moved, n)


def _solved(equations: list[list[fmpq]], right: list[fmpq], unknowns: int) -> list[fmpq]:
    """One solution of linear equations that have one."""
    reduced = linear.span(([*row, value] for row, value in zip(equations, right, strict=True)), unknowns + 1)
    solution = [fmpq(0)] * unknowns
    for row, column in zip(linear.rows(reduced), linear.pivots(reduced), strict=True):
        if column == unknowns:
            raise ArithmeticError("the equations of Levi's theorem have no solution")
        solution[column] = row[unknowns]
    return solution
