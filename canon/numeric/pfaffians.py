"""Pfaffians of ω = Σ dp_i∧dq_i on tangents of a surface, each with a bound on its error.

Pf(ω(t_a, t_b)) is ωᵏ/k! on the 2k tangents. Arnold, Mathematical Methods of Classical Mechanics (1989), section 44.
"""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np

from canon.numeric.precision import UNIT

Array = Any  # numpy arrays


def pfaffians(t: Array, off: Array | None = None) -> tuple[Array, Array]:
    """Pf(ω(t_a, t_b)) at each node for tangents (2k, 2n, N), with its error for tangents off by `off`."""
    size, width, count = t.shape
    n = width // 2
    large = np.abs(t)

    def sums(x: Array, y: Array, a: int, b: int) -> tuple[Array, Array]:
        """Σ p_i q_i and Σ q_i p_i, the first factors of x_a, the second ones of y_b."""
        return np.einsum("in,in->n", x[a, n:], y[b, :n]), np.einsum("in,in->n", x[a, :n], y[b, n:])

    entries: dict[tuple[int, int], tuple[Array, Array]] = {}
    for a in range(size):
        for b in range(a + 1, size):
            first, second = sums(t, t, a, b)
            error = (n + 1) * UNIT * sum(sums(large, large, a, b))
            if off is not None:
                error = error + sum(sums(large, off, a, b)) + sum(sums(off, large, a, b))
            entries[a, b] = first - second, error
    known: dict[tuple[int, ...], tuple[Array, Array]] = {(): (np.ones(count), np.zeros(count))}
    return _pfaffian(tuple(range(size)), entries, known)


def powers(matrix: Array, off: float = 0.0) -> list[tuple[Array, Array]]:
    """For k = 1 … n the coefficients of Aᵏ/k! for the two-form (or bivector) A of an antisymmetric matrix (2n, 2n): its
    Pfaffians on all sets of 2k rows, in lexicographic order, each with its error for entries off by `off`.

    There are as many as 4ⁿ⁻¹ minors to expand: for a few degrees of freedom.
    """
    size = len(matrix)
    error = np.full(1, off)
    entries = {(a, b): (matrix[a, b : b + 1], error) for a, b in combinations(range(size), 2)}
    known: dict[tuple[int, ...], tuple[Array, Array]] = {(): (np.ones(1), np.zeros(1))}
    found = []
    for k in range(1, size // 2 + 1):
        pairs = [_pfaffian(rows, entries, known) for rows in combinations(range(size), 2 * k)]
        found.append((np.array([value[0] for value, _ in pairs]), np.array([bound[0] for _, bound in pairs])))
    return found


def _pfaffian(
    rows: tuple[int, ...],
    entries: dict[tuple[int, int], tuple[Array, Array]],
    known: dict[tuple[int, ...], tuple[Array, Array]],
) -> tuple[Array, Array]:
    """The Pfaffian of the rows by expansion along the first one, each minor once."""
    if rows not in known:
        total: Array = 0.0
        error: Array = 0.0
        first, *rest = rows
        for position, b in enumerate(rest):
            minor, off = _pfaffian(tuple(rest[:position] + rest[position + 1 :]), entries, known)
            value, bound = entries[first, b]
            total = total + (-1) ** position * value * minor
            error = error + bound * np.abs(minor) + np.abs(value) * off + len(rows) * UNIT * np.abs(value * minor)
        known[rows] = total, error
    return known[rows]
