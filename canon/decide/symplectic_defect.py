"""Rigorous bounds on M J Mᵀ − scale J over a box, for the Jacobian M of a straight-line program.

Each entry is expanded in Taylor's series at the centre up to a degree; the coefficients of that last degree are
enclosed over the whole box, which is Lagrange's remainder. An entry that vanishes identically has coefficients that are
rounding only, and a remainder that shrinks as the box's size to the power degree + 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb, inf, nextafter
from typing import Final

from flint import arb

from canon.decide.series import Algebra, Ball, Series, algebra, constant_term
from canon.decide.series_program import number, run_series, working
from canon.program import Program

MOST_PRODUCTS: Final = 20_000
"""A product of two series may have so many terms: that decides to which degree they are taken."""

BITS: Final = 128


@dataclass(frozen=True)
class Box:
    """The points whose k-th coordinate is at most `radii[k]` away from `centre[k]`, exactly."""

    centre: tuple[Fraction, ...]
    radii: tuple[Fraction, ...]

    def halves(self, k: int) -> tuple[Box, Box]:
        """The box cut in two across the k-th direction."""
        radius = self.radii[k] / 2
        radii = (*self.radii[:k], radius, *self.radii[k + 1 :])
        left, right = ((*self.centre[:k], self.centre[k] + sign * radius, *self.centre[k + 1 :]) for sign in (-1, 1))
        return Box(left, radii), Box(right, radii)


@dataclass(frozen=True)
class BoxBound:
    """`upper` bounds every |entry| of M J Mᵀ − scale J over a box; at its centre one is at least `lower`.

    `entry` is the row and column of the largest bound, and `direction` the variable that it depends on most.
    """

    upper: float
    lower: float
    entry: tuple[int, int]
    direction: int


def degree_for(variables: int) -> int:
    """To which degree M is expanded in so many variables."""
    degree = 1
    while degree < 8 and comb(2 * variables + degree + 2, degree + 2) <= MOST_PRODUCTS:
        degree += 1
    return degree


def defect_over(program: Program, box: Box, scale: Fraction, degree: int, bits: int = BITS) -> BoxBound:
    """A bound on the symplectic defect over a box, of a program whose outputs are a map's 2n values.

    **Raises:** `Unenclosed` where the program isn't certified to be smooth on the box.
    """
    space = algebra(program.inputs, degree + 1)
    with working(bits, degree + 1):
        scales = [number(r) if r else arb(1) for r in box.radii]
        centres = [number(c) for c in box.centre]
        sides = [(c + number(r)).union(c - number(r)) for c, r in zip(centres, box.radii, strict=True)]
        over = _residuals(program, sides, scales, scale, space)
        at = _residuals(program, centres, scales, scale, space)
        still = [not r for r in box.radii]
        largest, lower, entry, direction = arb(-1), 0.0, (0, 1), 0
        for (place, coarse), (_, fine) in zip(over, at, strict=True):
            sizes = {}
            for k in {*coarse, *fine}:
                exponents = space.monomials[k]
                if space.degrees[k] > degree or any(e and s for e, s in zip(exponents, still, strict=True)):
                    continue
                ball = (coarse if space.degrees[k] == degree else fine).get(k, arb(0))
                sizes[k] = ball.abs_upper()
            total = sum(sizes.values(), arb(0)).upper()
            lower = max(lower, _below(constant_term(fine).abs_lower()))
            if total > largest:
                largest, entry = total, place
                weights = [
                    sum(float(size) * space.monomials[k][j] for k, size in sizes.items()) for j in range(program.inputs)
                ]
                direction = max(range(program.inputs), key=lambda j: (weights[j], box.radii[j]))
    return BoxBound(_above(largest), lower, entry, direction)


def defect_at(
    program: Program, point: Sequence[Fraction], scale: Fraction, bits: int = BITS
) -> dict[tuple[int, int], Ball]:
    """The entries of M J Mᵀ − scale J above the diagonal at one exact point, as balls, by row and column.

    **Raises:** `Unenclosed` where the program isn't certified to be smooth there.
    """
    space = algebra(program.inputs, 1)
    with working(bits, 1):
        ones = [arb(1)] * program.inputs
        found = _residuals(program, [number(x) for x in point], ones, scale, space)
        return {place: constant_term(series) for place, series in found}


def _residuals(
    program: Program, centres: Sequence[Ball], scales: Sequence[Ball], scale: Fraction, space: Algebra
) -> list[tuple[tuple[int, int], Series]]:
    size = program.inputs
    inputs = [space.variable(k, centres[k], scales[k]) for k in range(size)]
    values = run_series(program, inputs, space)
    M = [[space.scaled(space.derivative(Z, k), 1 / scales[k]) for k in range(size)] for Z in values]
    return list(_entries(M, scale, space))


def _entries(M: list[list[Series]], scale: Fraction, space: Algebra) -> Iterator[tuple[tuple[int, int], Series]]:
    n = len(M) // 2
    for a in range(2 * n):
        for b in range(a + 1, 2 * n):
            total: Series = {}
            for k in range(n):
                total = space.add(total, space.multiply(M[a][k], M[b][k + n]))
                total = space.add(total, space.scaled(space.multiply(M[a][k + n], M[b][k]), arb(-1)))
            if b == a + n:
                total = space.add(total, space.constant(-number(scale)))
            yield (a, b), total


def _above(ball: Ball) -> float:
    """A float that is no smaller."""
    upper = ball.upper()
    value = float(upper)
    while not arb(value) >= upper:
        value = nextafter(value, inf)
    return value


def _below(ball: Ball) -> float:
    """A float that is no larger, and not negative."""
    lower = ball.lower()
    value = max(0.0, float(lower))
    while value and not arb(value) <= lower:
        value = nextafter(value, 0.0)
    return value
