"""Cartan matrices and roots of the complex simple types, Bourbaki's numbering of the simple roots."""

from __future__ import annotations

from canon.expected import instance_of
from canon.mechanics.algebra.complex_type import ComplexType

Root = tuple[int, ...]
"""The coefficients of a root in the simple roots."""


def cartan_matrix(kind: ComplexType) -> tuple[tuple[int, ...], ...]:
    """a_ij = 2 (α_i, α_j)/(α_i, α_i), so that α_j, α_j + α_i, …, α_j − a_ij α_i are roots.

    Kac's convention; Humphreys, Introduction to Lie Algebras (1972), 11.4, has the transposed matrix.
    """
    instance_of(kind, ComplexType, "type")
    n = kind.rank
    a = [[2 * int(i == j) for j in range(n)] for i in range(n)]

    def bond(i: int, j: int, forth: int = -1, back: int = -1) -> None:
        a[i][j], a[j][i] = forth, back

    if kind.letter == "E":
        for i, j in ((0, 2), (1, 3), (2, 3), *((k, k + 1) for k in range(3, n - 1))):
            bond(i, j)
        return tuple(map(tuple, a))
    for i in range(n - 1):
        bond(i, i + 1)
    if kind.letter == "B":
        bond(n - 2, n - 1, -1, -2)  # the last root is short
    elif kind.letter == "C":
        bond(n - 2, n - 1, -2, -1)  # the last root is long
    elif kind.letter == "D":
        bond(n - 2, n - 1, 0, 0)
        bond(n - 3, n - 1)
    elif kind.letter == "F":
        bond(1, 2, -1, -2)
    elif kind.letter == "G":
        bond(0, 1, -3, -1)  # the first root is short
    return tuple(map(tuple, a))


def positive_roots(kind: ComplexType) -> tuple[Root, ...]:
    """The positive roots by height, each with its coefficients in the simple roots.

    By strings: β + α_i is a root where the string of β downwards along α_i is longer than 〈β, α_i〉.
    """
    a = cartan_matrix(kind)
    n = kind.rank
    simple = [tuple(int(i == j) for j in range(n)) for i in range(n)]
    known = set(simple)
    layer = list(simple)
    found = list(simple)
    while layer:
        following: set[Root] = set()
        for root in layer:
            for i in range(n):
                down, lower = 0, list(root)
                while True:
                    lower[i] -= 1
                    if tuple(lower) not in known:
                        break
                    down += 1
                if down > sum(a[i][j] * root[j] for j in range(n)):
                    upper = list(root)
                    upper[i] += 1
                    following.add(tuple(upper))
        layer = sorted(following - known)
        known |= following
        found += layer
    return tuple(found)
