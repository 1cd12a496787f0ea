"""Strategies of symplectic matrices, and of matrices that miss being symplectic by a stated amount."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, Literal

import numpy as np
from hypothesis import strategies as st

from canon.expected import finite_number, one_of, whole_number

Array = np.ndarray
Made = Literal["generators", "factors"]
Rows = list[list[Fraction]]
MOST_DEGREES: Final = 100
SIZES: Final = (1e-3, 1e-6, 1e-9)


@dataclass(frozen=True)
class Turn:
    """A rotation by one angle in each of the planes."""

    planes: tuple[tuple[int, int], ...]
    cosine: Fraction
    sine: Fraction


def symplectic_matrices(
    degrees: int, *, made: Made | None = None, condition: float | None = None, max_factors: int = 4
) -> st.SearchStrategy[Array]:
    """Symplectic matrices (2n, 2n): M J Mᵀ = J.

    They are `made` of generators (shears, exchanges and squeezes by small whole numbers, exact in floats), or of
    factors R₁ D R₂ with rotations R of phase space that are symplectic, and D = diag(d, 1/d): Euler's decomposition,
    also named after Bloch and Messiah. With a `condition` κ they are made of factors, and κ is their condition number.
    They shrink to the identity, and to one generator.
    """
    degrees = whole_number(degrees, "degrees", 1, MOST_DEGREES)
    max_factors = whole_number(max_factors, "max_factors", 0)
    if condition is not None:
        finite_number(condition, "condition", least=1.0)
        return _of_factors(degrees, float(condition))
    if made is not None:
        one_of(made, ("generators", "factors"), "made")
    makers = {"generators": _of_generators(degrees, max_factors), "factors": _of_factors(degrees, None)}
    return makers[made] if made else st.one_of(*makers.values())


@st.composite
def _of_generators(draw: st.DrawFn, n: int, max_factors: int) -> Array:
    M = np.eye(2 * n)
    for _ in range(draw(st.integers(0, max_factors))):
        M = draw(_generators(n)) @ M
    return M


@st.composite
def _generators(draw: st.DrawFn, n: int) -> Array:
    """p → p + C q, q → q + C p with a symmetric C of one or two entries; a squeeze by a power of 2; an exchange."""
    M, i, j = np.eye(2 * n), draw(st.integers(0, n - 1)), draw(st.integers(0, n - 1))
    kind = draw(st.sampled_from(("kick", "drift", "squeeze", "exchange")))
    if kind in ("kick", "drift"):
        strength = draw(st.integers(-3, 3))
        row, column = (n, 0) if kind == "kick" else (0, n)
        M[row + i, column + j] = M[row + j, column + i] = strength
    elif kind == "squeeze":
        M[i, i] = 2.0 ** draw(st.integers(-3, 3))
        M[n + i, n + i] = 1 / M[i, i]
    else:
        M[[i, n + i]] = M[[n + i, i]] * np.array([[1.0], [-1.0]])
    return M


@st.composite
def _of_factors(draw: st.DrawFn, n: int, condition: float | None) -> Array:
    """R₁ D R₂, multiplied exactly and rounded once: each entry is right to half a unit in its last place."""
    largest = 2.0 ** draw(st.integers(0, 6)) if condition is None else condition**0.5
    stretches = [Fraction(largest ** (draw(st.integers(0, 4)) / 4)) for _ in range(n)]
    stretches[0] = Fraction(largest)
    rows: Rows = [[Fraction(int(i == j)) for j in range(2 * n)] for i in range(2 * n)]
    for turn in draw(_turns(n)):
        _apply(turn, rows)
    for k, stretch in enumerate(stretches):
        rows[k] = [stretch * x for x in rows[k]]
        rows[n + k] = [x / stretch for x in rows[n + k]]
    for turn in draw(_turns(n)):
        _apply(turn, rows)
    return np.array([[float(x) for x in row] for row in rows])


@st.composite
def _turns(draw: st.DrawFn, n: int, max_turns: int = 3) -> list[Turn]:
    """Orthogonal symplectic factors: phase rotations, and rotations of two degrees of freedom, with rational cosines.

    The cosine and sine are (1 − t²)/(1 + t²) and 2t/(1 + t²), t being the tangent of half the angle.
    """
    found = []
    for _ in range(draw(st.integers(0, max_turns))):
        i, j = draw(st.integers(0, n - 1)), draw(st.integers(0, n - 1))
        t = Fraction(draw(st.integers(-31, 31)), 10)
        planes = ((i, n + i),) if i == j else ((i, j), (n + i, n + j))
        found.append(Turn(planes, (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)))
    return found


def _apply(turn: Turn, rows: Rows) -> None:
    """Multiply by the rotation from the left."""
    for a, b in turn.planes:
        first, second = rows[a], rows[b]
        rows[a] = [turn.cosine * x + turn.sine * y for x, y in zip(first, second, strict=True)]
        rows[b] = [turn.cosine * y - turn.sine * x for x, y in zip(first, second, strict=True)]


@dataclass(frozen=True, eq=False)
class MatrixMutant:
    """A `matrix` that is symplectic but for one `bracket` ("{Q1,P2}"), which is off by the `defect`."""

    matrix: Array
    bracket: str
    defect: float


@st.composite
def matrix_mutants(
    draw: st.DrawFn, degrees: int, *, sizes: Sequence[float] = SIZES, condition: float | None = None
) -> MatrixMutant:
    """Symplectic matrices with one row spoiled: a factor, or a part of another row, of one of the `sizes`.

    What is spoiled comes last, so exactly one bracket of M J Mᵀ differs from J's, and by that amount (in exact
    arithmetic).
    """
    S = draw(symplectic_matrices(degrees, condition=condition))
    size = draw(st.sampled_from(list(sizes))) * draw(st.sampled_from((1, -1)))
    i = draw(st.integers(0, degrees - 1))
    family = draw(st.sampled_from(("{Q,P}", "{P,P}", "{Q,Q}") if degrees > 1 else ("{Q,P}",)))
    spoiled = np.eye(2 * degrees)
    if family == "{Q,P}":
        spoiled[i, i] += size
        return MatrixMutant(spoiled @ S, f"{{Q{i + 1},P{i + 1}}}", size)
    j = draw(st.integers(0, degrees - 2))
    j += j >= i
    low, high = sorted((i, j))
    if family == "{P,P}":
        spoiled[degrees + low, high] = size
        return MatrixMutant(spoiled @ S, f"{{P{low + 1},P{high + 1}}}", size)
    spoiled[low, degrees + high] = -size
    return MatrixMutant(spoiled @ S, f"{{Q{low + 1},Q{high + 1}}}", size)
