"""Textbook bases of matrix algebras, as nested lists of whole numbers and (real, imaginary) pairs.

They are what `algebra_of_matrices` takes.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def unit(size: int, *entries: tuple[int, int, Any]) -> list[list[Any]]:
    """The matrix with these entries, else 0."""
    found: list[list[Any]] = [[0] * size for _ in range(size)]
    for i, j, value in entries:
        found[i][j] = value
    return found


def orthogonal(p: int, q: int = 0) -> Mapping[str, Any]:
    """so(p, q): all X with Xᵀ g + g X = 0, g = diag(1, …, −1)."""
    n, g = p + q, [1] * p + [-1] * q
    return {f"L{i}_{j}": unit(n, (i, j, -g[j]), (j, i, g[i])) for i in range(n) for j in range(i + 1, n)}


def symplectic(n: int) -> Mapping[str, Any]:
    """sp(2n, R): all X with Xᵀ J + J X = 0."""
    found = {}
    for i in range(n):
        for j in range(n):
            found[f"a{i}_{j}"] = unit(2 * n, (i, j, 1), (n + j, n + i, -1))
            if i <= j:
                found[f"b{i}_{j}"] = unit(2 * n, (i, n + j, 1), (j, n + i, 1))
                found[f"c{i}_{j}"] = unit(2 * n, (n + i, j, 1), (n + j, i, 1))
    return found


def hermitian(n: int, *, trace: bool = False) -> Mapping[str, Any]:
    """Physicists' generators of su(n), or of u(n) with `trace`: hermitian matrices."""
    found = {}
    for i in range(n):
        for j in range(i + 1, n):
            found[f"s{i}_{j}"] = unit(n, (i, j, 1), (j, i, 1))
            found[f"a{i}_{j}"] = unit(n, (i, j, (0, -1)), (j, i, (0, 1)))
        if i:
            found[f"d{i}"] = unit(n, (i, i, 1), (0, 0, -1))
    if trace:
        found["one"] = unit(n, *((i, i, 1) for i in range(n)))
    return found


def euclidean(p: int, q: int = 0) -> Mapping[str, Any]:
    """iso(p, q) as matrices of size p + q + 1."""
    n = p + q
    found = {name: [[*row, 0] for row in rows] + [[0] * (n + 1)] for name, rows in orthogonal(p, q).items()}
    return {**found, **{f"P{i}": unit(n + 1, (i, n, 1)) for i in range(n)}}


def special_linear(n: int, *, complex_field: bool = False) -> Mapping[str, Any]:
    """sl(n, R), or sl(n, C) as a real algebra: twice as many matrices."""
    found = {f"E{i}_{j}": unit(n, (i, j, 1)) for i in range(n) for j in range(n) if i != j}
    found |= {f"H{i}": unit(n, (i, i, 1), (i + 1, i + 1, -1)) for i in range(n - 1)}
    if complex_field:
        found |= {f"i{name}": [[(0, e) for e in row] for row in rows] for name, rows in found.items()}
    return found
