"""Small systems of linear equations, written out: a few equations in a compiled loop are no library's business."""

from __future__ import annotations

from typing import Any


def solve(matrix: list[list[Any]], right: list[Any]) -> list[Any]:
    """x with A x = b by elimination without exchanges: for matrices near symmetric positive definite ones.

    The entries are numbers or arrays of one shape, for as many systems.
    """
    size = len(right)
    A, b = [[*row] for row in matrix], [*right]
    for k in range(size):
        for i in range(k + 1, size):
            factor = A[i][k] / A[k][k]
            A[i] = [*A[i][: k + 1], *(A[i][j] - factor * A[k][j] for j in range(k + 1, size))]
            b[i] = b[i] - factor * b[k]
    x: list[Any] = [None] * size
    for k in reversed(range(size)):
        rest = b[k]
        for j in range(k + 1, size):
            rest = rest - A[k][j] * x[j]
        x[k] = rest / A[k][k]
    return x
