"""Structure constants with parameters or roots in them made rational by a change of scale of the basis.

With e'_a = s_a e_a the constants become C'^c_ab = C^c_ab s_a s_b / s_c. Where every s_a is real and not 0 for all
values of the parameters, the algebra is the same real algebra for all of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy as sp
from flint import fmpq, nmod_mat

from canon.mechanics.algebra import linear
from canon.mechanics.algebra.coefficients import Number
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.sign import known_sign

Powers = Mapping[Any, Any]
"""Rational exponents by base."""


@dataclass(frozen=True, slots=True)
class Rescaled:
    """A rational algebra, and the scales s_a (positive expressions) of the basis by which it is e'_a = s_a e_a."""

    algebra: LieAlgebra
    scales: tuple[sp.Expr, ...]

    @property
    def is_trivial(self) -> bool:
        """Whether nothing had to be scaled."""
        return all(scale == 1 for scale in self.scales)


def rescaled(algebra: LieAlgebra) -> Rescaled | None:
    """The algebra with rational structure constants, or None where no scaling of the basis makes them so.

    Each constant must be a rational number times powers of quantities of one sign, which the assumptions on names show.
    """
    size = algebra.dimension
    if algebra.is_rational:
        return Rescaled(algebra, (sp.S.One,) * size)
    found = rational_table(algebra.constants, size)
    return None if found is None else Rescaled(LieAlgebra(algebra.names, found[0]), tuple(found[1]))


def rational_table(
    given: Mapping[tuple[int, int], Mapping[int, Number]], size: int
) -> tuple[dict[tuple[int, int], dict[int, Number]], list[Any]] | None:
    """Structure constants so rescaled, and the scales; not verified."""
    found: dict[tuple[int, int, int], tuple[Fraction, Powers]] = {}
    for (a, b), row in given.items():
        for c, value in row.items():
            parts = monomial(value)
            if parts is None:
                return None
            found[a, b, c] = parts
    bases = sorted({base for _, powers in found.values() for base in powers}, key=sp.default_sort_key)
    scales: list[Any] = [sp.S.One] * size
    constants = {key: number for key, (number, _) in found.items()}
    for base in bases:
        exponents = {key: powers.get(base, sp.S.Zero) for key, (_, powers) in found.items()}
        x = _halves(exponents, size) if base.is_Integer else None
        x = _exactly(exponents, size) if x is None else x
        if x is None:
            return None
        scales = [scale * base**power for scale, power in zip(scales, x, strict=True)]
        if base.is_Integer:
            for (a, b, c), power in exponents.items():
                left = power + x[a] + x[b] - x[c]
                constants[a, b, c] *= Fraction(int(base)) ** int(left)
    table: dict[tuple[int, int], dict[int, Number]] = {}
    for (a, b, c), number in constants.items():
        table.setdefault((a, b), {})[c] = number
    return table, scales


def monomial(value: Number) -> tuple[Fraction, Powers] | None:
    """The value as a rational number times powers of primes and of positive quantities; None where it is none.

    Whole powers of primes are part of the number. A negative quantity n enters as −n.
    """
    if isinstance(value, Fraction):
        return value, {}
    number, powers = Fraction(1), dict[Any, Any]()
    for base, exponent in _factors(value):
        if base.is_Rational and exponent.is_Integer:
            number *= Fraction(int(base.p), int(base.q)) ** int(exponent)
            continue
        if not exponent.is_Rational:
            return None
        if base.is_Rational and base > 0:
            for prime, times in sp.factorint(base, limit=2**20).items():
                if not sp.isprime(prime):  # its factors would take long to find
                    return None
                powers[sp.Integer(prime)] = powers.get(sp.Integer(prime), sp.S.Zero) + times * exponent
            continue
        sign = known_sign(base)
        if sign == "negative" and exponent.is_Integer:
            base, number = -base, number * Fraction(-1) ** int(exponent)
        elif sign != "positive":
            return None
        powers[base] = powers.get(base, sp.S.Zero) + exponent
    for base in [base for base in powers if base.is_Integer]:
        whole = sp.floor(powers[base])
        number *= Fraction(int(base)) ** int(whole)
        powers[base] -= whole
    return number, {base: power for base, power in powers.items() if power != 0}


def _factors(value: Any) -> Iterator[tuple[Any, Any]]:
    """The factors of a product with their powers, sums taken apart once."""
    product: Any = sp.factor(value) if value.has(sp.Add) else value
    for factor in sp.Mul.make_args(product):
        base, exponent = factor.as_base_exp()
        if base.is_Mul:
            for inner, power in _factors(base):
                yield inner, power * exponent
        else:
            yield base, exponent


def _exactly(exponents: Mapping[tuple[int, int, int], Any], size: int) -> list[Any] | None:
    """Powers x with x_a + x_b − x_c = −k for each constant with power k, or None."""
    equations = []
    for (a, b, c), power in exponents.items():
        row = [fmpq(0)] * (size + 1)
        row[a] += 1
        row[b] += 1
        row[c] -= 1
        row[size] = fmpq(-int(power.p), int(power.q))
        equations.append(row)
    reduced = linear.span(equations, size + 1)
    x: list[Any] = [sp.S.Zero] * size
    for row, column in zip(linear.rows(reduced), linear.pivots(reduced), strict=True):
        if column == size:
            return None
        x[column] = sp.Rational(int(row[size].p), int(row[size].q))
    return x


def _halves(exponents: Mapping[tuple[int, int, int], Any], size: int) -> list[Any] | None:
    """Powers 0 or 1/2 that make every power whole, or None."""
    if any((2 * power).q != 1 for power in exponents.values()):
        return None
    entries = []
    for (a, b, c), power in exponents.items():
        row = [0] * (size + 1)
        for k in (a, b, c):
            row[k] ^= 1
        row[size] = int(2 * power) % 2
        entries += row
    reduced, rank = nmod_mat(len(exponents), size + 1, entries, 2).rref()
    x: list[Any] = [sp.S.Zero] * size
    for i in range(rank):
        column = next(k for k in range(size + 1) if int(reduced[i, k]))
        if column == size:
            return None
        x[column] = sp.Rational(int(reduced[i, size]), 2)
    return x
