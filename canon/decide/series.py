"""Power series in several variables, truncated at a total degree, with balls for coefficients.

A series is a table {position of a monomial: coefficient} without those that are exactly 0. With a point for constant
terms the coefficients are Taylor's at that point; with a box's balls for constant terms they enclose Taylor's at every
point of the box, which is what remainders are made of (Moore, Kearfott and Cloud, Introduction to Interval Analysis,
chapter 9).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations_with_replacement
from typing import Any

from flint import arb

Ball = Any  # flint.arb; the package has no type stubs
Series = dict[int, Ball]


@dataclass(frozen=True)
class Algebra:
    """Series in so many `variables` up to a total `degree`.

    `monomials` are the exponents, by increasing degree (the constant first, then the variables); `lengths[d]` is how
    many have a degree of at most d; `degrees` those of the monomials.
    """

    variables: int
    degree: int
    monomials: tuple[tuple[int, ...], ...]
    lengths: tuple[int, ...]
    degrees: tuple[int, ...]
    positions: dict[tuple[int, ...], int]
    products: dict[tuple[int, int], int]

    def constant(self, value: Ball) -> Series:
        """A number as a series."""
        return {} if value.is_zero() else {0: value}

    def variable(self, k: int, centre: Ball, scale: Ball) -> Series:
        """centre + scale · (the k-th variable)."""
        return {**self.constant(centre), 1 + k: scale}

    def add(self, f: Series, g: Series) -> Series:
        """f + g."""
        total = dict(f)
        for i, b in g.items():
            total[i] = total[i] + b if i in total else b
        return total

    def scaled(self, f: Series, factor: Ball) -> Series:
        """factor · f."""
        return {} if factor.is_zero() else {i: a * factor for i, a in f.items()}

    def multiply(self, f: Series, g: Series) -> Series:
        """f · g, truncated."""
        if len(f) > len(g):
            f, g = g, f
        if not f:
            return {}
        if len(f) == 1 and 0 in f:
            return self.scaled(g, f[0])
        total: Series = {}
        degrees, positions = self.degrees, self.products
        for i, a in f.items():
            room = self.degree - degrees[i]
            for j, b in g.items():
                if degrees[j] <= room:
                    k = positions[i, j]
                    product = a * b
                    total[k] = total[k] + product if k in total else product
        return total

    def compose(self, coefficients: Sequence[Ball], f: Series) -> Series:
        """Σ coefficients[m] · h^m, where h is f without its constant term."""
        h = {i: a for i, a in f.items() if i}
        if not h:
            return self.constant(coefficients[0])
        total: Series = {}
        for coefficient in reversed(coefficients):
            total = self.add(self.multiply(total, h), self.constant(coefficient))
        return total

    def derivative(self, f: Series, k: int) -> Series:
        """∂f/∂(the k-th variable); its terms of the highest degree are lost."""
        total: Series = {}
        for i, a in f.items():
            exponents = self.monomials[i]
            if exponents[k]:
                lower = (*exponents[:k], exponents[k] - 1, *exponents[k + 1 :])
                total[self.positions[lower]] = a * exponents[k]
        return total


@lru_cache(maxsize=32)
def algebra(variables: int, degree: int) -> Algebra:
    """The series in so many variables up to a total degree."""
    monomials: list[tuple[int, ...]] = []
    lengths = []
    for d in range(degree + 1):
        for chosen in combinations_with_replacement(range(variables), d):
            monomials.append(tuple(chosen.count(k) for k in range(variables)))
        lengths.append(len(monomials))
    positions = {exponents: k for k, exponents in enumerate(monomials)}
    degrees = tuple(sum(exponents) for exponents in monomials)
    products = {
        (i, j): positions[tuple(a + b for a, b in zip(x, y, strict=True))]
        for i, x in enumerate(monomials)
        for j, y in enumerate(monomials)
        if degrees[i] + degrees[j] <= degree
    }
    return Algebra(variables, degree, tuple(monomials), tuple(lengths), degrees, positions, products)


def constant_term(f: Series) -> Ball:
    """The value at the origin."""
    return f.get(0, arb(0))
