"""The order conditions of a splitting, exactly: a step as a series in the words of two non-commuting letters."""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial

import numpy as np


def residual(substeps: Sequence[tuple[int, float]], order: int, count: int | None = None) -> float:
    """The largest difference of a coefficient of Π exp(c X) from that of exp(A + B), over words up to a length.

    With a `count`, over words with as many letters B.
    """
    words = _words(substeps, order)
    worst = 0.0
    for n in range(1, order + 1):
        miss = np.abs(words[n] - np.longdouble(1) / factorial(n))
        chosen = [count is None or word.bit_count() == count for word in range(2**n)]
        worst = max(worst, float(miss[chosen].max(initial=0)))
    return worst


def _words(substeps: Sequence[tuple[int, float]], order: int) -> list[np.ndarray]:
    """The coefficients of the words of each length, in extended precision.

    Words of a length n are numbers of n bits; a letter is appended on the right.
    """
    words = [np.zeros(2**n, dtype=np.longdouble) for n in range(order + 1)]
    words[0][0] = 1
    for letter, length in substeps:
        for n in range(order, 0, -1):
            for k in range(1, n + 1):
                tail = (2**k - 1) * letter
                places = (np.arange(2 ** (n - k)) << k) | tail
                words[n][places] += words[n - k] * (np.longdouble(length) ** k / factorial(k))
    return words


def substeps(a: Sequence[float], b: Sequence[float]) -> list[tuple[int, float]]:
    """The substeps of a step, as (letter, fraction), A being 0."""
    pairs = [pair for x, y in zip(a, b, strict=False) for pair in ((0, x), (1, y))]
    return [*pairs, (0, a[-1])]


def nystrom_residual(substeps: Sequence[tuple[int, float]], order: int) -> float:
    """The same, up to the ideal of [B,[B,[B,A]]], which vanishes for B = V(q) beside A = T(p) quadratic."""
    words = _words(substeps, order)
    worst = 0.0
    for n in range(1, order + 1):
        miss = np.asarray(words[n] - np.longdouble(1) / factorial(n), dtype=float)
        ideal = _ideal(n)
        if len(ideal):
            basis = np.linalg.svd(ideal)[2][: np.linalg.matrix_rank(ideal)]
            miss = miss - basis.T @ (basis @ miss)
        worst = max(worst, float(np.abs(miss).max()))
    return worst


def _ideal(n: int) -> np.ndarray:
    """u [B,[B,[B,A]]] v for all words u and v that make the length n, one a row."""
    bracket = {0b1110: 1, 0b1101: -3, 0b1011: 3, 0b0111: -1}
    rows = []
    for left in range(n - 3):
        right = n - 4 - left
        for u in range(2**left):
            for v in range(2**right):
                row = np.zeros(2**n)
                for word, sign in bracket.items():
                    row[(u << (n - left)) | (word << right) | v] += sign
                rows.append(row)
    return np.array(rows)
