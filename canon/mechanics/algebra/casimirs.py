"""Casimirs: polynomials in the basis that commute with every element in the Lie–Poisson bracket."""

from __future__ import annotations

from itertools import combinations_with_replacement
from math import comb, lcm
from typing import Final

import sympy as sp
from flint import fmpq

from canon.errors import InputError
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.lie_algebra import LieAlgebra

LARGEST: Final = 1500
"""The most monomials of one degree for which the equations are solved."""

Monomial = tuple[int, ...]
"""The positions of the factors, in order."""


def casimirs(algebra: LieAlgebra, degree: int = 2) -> tuple[sp.Expr, ...]:
    """A basis of the homogeneous polynomials of a degree that are invariant: {e_a, f} = 0 for every a.

    With {e_a, e_b} = Σ C^c_ab e_c the equations are linear in the coefficients of f. Products of Casimirs of lower
    degree are among them. For rational structure constants.

    **Raises:** `InputError` for too many monomials.
    """
    n = algebra.dimension
    if degree < 1 or comb(n + degree - 1, degree) > LARGEST:
        raise InputError(f"there are too many monomials of degree {degree} in {n} elements: at most {LARGEST}")
    monomials = list(combinations_with_replacement(range(n), degree))
    equations: list[list[fmpq]] = []
    for a in range(n):
        rows: dict[Monomial, list[fmpq]] = {}
        for k, monomial in enumerate(monomials):
            for place, b in enumerate(monomial):
                rest = (*monomial[:place], *monomial[place + 1 :])
                for c, value in algebra.bracket_of(a, b).items():
                    image = tuple(sorted((*rest, c)))
                    row = rows.setdefault(image, [fmpq(0)] * len(monomials))
                    row[k] += linear.rational(value)  # pyright: ignore[reportArgumentType]
        equations = linear.rows(linear.span([*equations, *rows.values()], len(monomials)))
    solutions = linear.null_space(linear.matrix(equations, len(monomials)))
    names = [sp.Symbol(name) for name in algebra.names]
    found = []
    for row in linear.rows(solutions):
        scale = lcm(*(int(value.q) for value in row))
        terms = [
            sp.Integer(int(value.p) * (scale // int(value.q))) * sp.Mul(*(names[b] for b in monomials[k]))
            for k, value in enumerate(row)
            if value != 0
        ]
        found.append(sp.Add(*terms))
    return tuple(found)
