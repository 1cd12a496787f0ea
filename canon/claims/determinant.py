"""Determinants and Pfaffians on the tape, by expansion with shared minors: no divisions, so no case distinctions."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from canon.decide.tape import Node, Tape

Matrix = Sequence[Sequence[Node]]


def determinant(tape: Tape, matrix: Matrix) -> Node:
    """det of a square matrix: Laplace's expansion row by row, each minor of the rows below computed once."""
    size = len(matrix)
    minors: dict[frozenset[int], Node] = {frozenset(): tape.one}

    def minor(row: int, columns: frozenset[int]) -> Node:
        if columns not in minors:
            terms = []
            for position, column in enumerate(sorted(columns)):
                entry = matrix[row][column]
                if tape.value(entry) == 0:
                    continue
                rest = minor(row + 1, columns - {column})
                terms.append((tape.times(entry, rest), -1 if position % 2 else 1))
            minors[columns] = tape.add(terms)
        return minors[columns]

    return minor(0, frozenset(range(size)))


def pfaffian(tape: Tape, matrix: Matrix, indices: Sequence[int]) -> Node:
    """The Pfaffian of an antisymmetric matrix restricted to some of its indices (an even number)."""
    known: dict[tuple[int, ...], Node] = {(): tape.one}

    def part(rest: tuple[int, ...]) -> Node:
        if rest not in known:
            first, others = rest[0], rest[1:]
            terms = []
            for position, other in enumerate(others):
                entry = matrix[first][other]
                if tape.value(entry) == 0:
                    continue
                inner = part(others[:position] + others[position + 1 :])
                terms.append((tape.times(entry, inner), -1 if position % 2 else 1))
            known[rest] = tape.add(terms)
        return known[rest]

    return part(tuple(indices))


def product(tape: Tape, left: Matrix, right: Matrix) -> list[list[Node]]:
    """The matrix product."""
    columns = list(zip(*right, strict=True))
    return [
        [tape.plus(*(tape.times(a, b) for a, b in zip(row, column, strict=True))) for column in columns] for row in left
    ]


def lagrange_matrix(tape: Tape, jacobian: Matrix) -> list[list[Node]]:
    """DᵀJD of a Jacobian D whose rows are positions first, then momenta: the Lagrange brackets of the coordinates."""
    half = len(jacobian) // 2
    size = len(jacobian[0])

    def entry(a: int, b: int) -> Node:
        terms = []
        for i in range(half):
            terms.append((tape.times(jacobian[i][a], jacobian[i + half][b]), 1))
            terms.append((tape.times(jacobian[i + half][a], jacobian[i][b]), -1))
        return tape.add(terms)

    upper = {(a, b): entry(a, b) for a in range(size) for b in range(a + 1, size)}
    return [
        [tape.zero if a == b else upper[a, b] if a < b else tape.negative(upper[b, a]) for b in range(size)]
        for a in range(size)
    ]


def dot(tape: Tape, left: Sequence[Node], right: Sequence[Node]) -> Node:
    """Σ left·right."""
    return reduce(tape.plus, (tape.times(a, b) for a, b in zip(left, right, strict=True)), tape.zero)
