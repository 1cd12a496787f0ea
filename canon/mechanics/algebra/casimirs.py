"""Casimirs: polynomials in the basis that commute with every element in the Lie–Poisson bracket."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations_with_replacement
from math import comb, isqrt, lcm
from typing import Final

import sympy as sp
from flint import fmpq, nmod_mat

from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.lie_algebra import LieAlgebra

LARGEST: Final = 3200
"""The most monomials of one degree for which the equations are solved."""
PRIMES: Final = ((1 << 61) - 1, (1 << 62) - 57, (1 << 60) - 93)

Monomial = tuple[int, ...]
"""The positions of the factors, in order."""
Polynomial = dict[Monomial, Fraction]


def casimirs(algebra: LieAlgebra, degree: int = 2) -> tuple[sp.Expr, ...]:
    """A basis of the homogeneous polynomials of a degree that are invariant: {e_a, f} = 0 for every a.

    With {e_a, e_b} = Σ C^c_ab e_c the equations are linear in the coefficients of f. Products of Casimirs of lower
    degree are among them. For rational structure constants. The equations are solved modulo a prime, which can only
    give too many solutions, and each is verified over the rationals. For large orthogonal algebras and those of
    motions, see `canon.mechanics.algebra.invariants`.

    **Raises:** `InputError` for too many monomials, or irrational constants.
    """
    instance_of(algebra, LieAlgebra, "algebra")
    whole_number(degree, "degree", 1)
    n = algebra.dimension
    if not algebra.is_rational:
        raise InputError("Casimirs are computed for rational structure constants: rescale the basis first")
    if comb(n + degree - 1, degree) > LARGEST:
        raise InputError(f"there are too many monomials of degree {degree} in {n} elements: at most {LARGEST}")
    monomials = list(combinations_with_replacement(range(n), degree))
    generators = _generators(algebra)
    denominators = {value.denominator for row in algebra.constants.values() for value in row.values()}  # pyright: ignore
    for prime in PRIMES if n else ():
        if any(denominator % prime == 0 for denominator in denominators):
            continue
        found = [_lifted(row, monomials, prime) for row in _solutions(algebra, monomials, generators, prime)]
        if all(f is not None and not any(poisson(algebra, a, f) for a in generators) for f in found):
            return tuple(_shown(algebra, f) for f in found if f is not None)
    return tuple(_shown(algebra, f) for f in _over_the_rationals(algebra, monomials, generators))


def poisson(algebra: LieAlgebra, a: int, f: Polynomial) -> Polynomial:
    """{e_a, f} in the Lie–Poisson bracket; {} where it is 0."""
    total: Polynomial = {}
    for monomial, value in f.items():
        for image, factor in _image(algebra, a, monomial).items():
            total[image] = total.get(image, Fraction(0)) + value * factor
    return {monomial: value for monomial, value in total.items() if value}


def _image(algebra: LieAlgebra, a: int, monomial: Monomial) -> Polynomial:
    row: Polynomial = {}
    for place, b in enumerate(monomial):
        rest = (*monomial[:place], *monomial[place + 1 :])
        for c, value in algebra.bracket_of(a, b).items():
            image = tuple(sorted((*rest, c)))
            row[image] = row.get(image, Fraction(0)) + value  # pyright: ignore[reportArgumentType]
    return row


def _generators(algebra: LieAlgebra) -> list[int]:
    """Basis elements that generate the algebra: what commutes with them commutes with everything (Jacobi)."""
    n = algebra.dimension
    chosen: list[int] = []
    space = linear.matrix([], n)
    for a in range(n):
        unit = [fmpq(int(k == a)) for k in range(n)]
        if linear.contains(space, unit):
            continue
        chosen.append(a)
        space = linear.span([*linear.rows(space), unit], n)
        while True:
            products = [algebra.product([fmpq(int(k == b)) for k in range(n)], x)
                        for b in chosen for x in linear.rows(space)]  # fmt: skip
            wider = linear.span([*linear.rows(space), *products], n)
            if wider.nrows() == space.nrows():
                break
            space = wider
    return chosen


def _solutions(algebra: LieAlgebra, monomials: list[Monomial], generators: list[int], prime: int) -> list[list[int]]:
    """The invariants modulo a prime, in reduced form: the kernels of the generators one inside the other."""
    size = len(monomials)
    position = {monomial: k for k, monomial in enumerate(monomials)}
    kernel: nmod_mat | None = None
    for a in generators:
        action = nmod_mat(size, size, prime)
        for k, monomial in enumerate(monomials):
            for image, value in _image(algebra, a, monomial).items():
                if value:
                    action[k, position[image]] = value.numerator * pow(value.denominator, -1, prime) % prime
        images = action if kernel is None else kernel * action
        null = _null_space(images.transpose(), prime)
        kernel = null if kernel is None else null * kernel
        if not kernel.nrows():
            return []
    if kernel is None:
        return [[int(j == k) for j in range(size)] for k in range(size)]
    reduced, rank = kernel.rref()
    return [[int(reduced[i, j]) for j in range(size)] for i in range(rank)]


def _null_space(values: nmod_mat, prime: int) -> nmod_mat:
    """All v with A v = 0, as rows."""
    reduced, rank = values.rref()
    width = values.ncols()
    leading = []
    for i in range(rank):
        start = leading[-1] + 1 if leading else 0
        leading.append(next(j for j in range(start, width) if int(reduced[i, j])))
    free = [j for j in range(width) if j not in set(leading)]
    found = nmod_mat(len(free), width, prime)
    for k, j in enumerate(free):
        found[k, j] = 1
        for i, column in enumerate(leading):
            value = int(reduced[i, j])
            if value:
                found[k, column] = prime - value
    return found


def _lifted(row: list[int], monomials: list[Monomial], prime: int) -> Polynomial | None:
    """The rational coefficients of small numerator and denominator with these residues; None where there are none."""
    found: Polynomial = {}
    bound = isqrt(prime // 2)
    for monomial, residue in zip(monomials, row, strict=True):
        if not residue:
            continue
        (r0, t0), (r1, t1) = (prime, 0), (residue, 1)
        while r1 > bound:
            quotient = r0 // r1
            (r0, t0), (r1, t1) = (r1, t1), (r0 - quotient * r1, t0 - quotient * t1)
        if abs(t1) > bound:
            return None
        found[monomial] = Fraction(r1, t1)
    return found


def _over_the_rationals(algebra: LieAlgebra, monomials: list[Monomial], generators: list[int]) -> list[Polynomial]:
    """The same without a prime, which takes longer."""
    equations: list[list[fmpq]] = []
    for a in generators:
        rows: dict[Monomial, list[fmpq]] = {}
        for k, monomial in enumerate(monomials):
            for image, value in _image(algebra, a, monomial).items():
                rows.setdefault(image, [fmpq(0)] * len(monomials))[k] = linear.rational(value)
        equations = linear.rows(linear.span([*equations, *rows.values()], len(monomials)))
    solutions = linear.null_space(linear.matrix(equations, len(monomials)))
    return [
        {monomial: linear.fraction(v) for monomial, v in zip(monomials, row, strict=True) if v != 0}
        for row in linear.rows(solutions)
    ]


def _shown(algebra: LieAlgebra, f: Polynomial) -> sp.Expr:
    """The polynomial with whole coefficients, as a formula."""
    names = [sp.Symbol(name) for name in algebra.names]
    scale = lcm(*(value.denominator for value in f.values()))
    return sp.Add(
        *(sp.Integer(int(value * scale)) * sp.Mul(*(names[b] for b in monomial)) for monomial, value in f.items())
    )
