"""Polynomials over Q in the generators of the tower (FLINT), with the cost of every product known beforehand.

Generator 0 is the lowest; the order is lexicographic with the last generator highest, as the
division by the tower's triangular relations needs it.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import flint
from flint.utils.flint_exceptions import DomainError

from canon.budget import Budget

Polynomial = Any  # flint.fmpq_mpoly; the package has no type stubs
Monomial = tuple[int, ...]
FEW = 40
HIGHEST = 4000
LONG, PACE, PACE_OF_POWERS = 1e6, 5e7, 6e6
"""Term products that take a while, and how many FLINT makes in a second, in products and in powers."""


class TooCostly(Exception):
    """A product was refused because its cost exceeds what this attempt may spend."""


class Ring:
    """Q[g0, …, g(n−1)], lexicographic, with an account of term products spent."""

    def __init__(self, size: int, limit: float, budget: Budget) -> None:
        self.size = size
        names = tuple(f"g{k}" for k in reversed(range(size)))
        self.context = flint.fmpq_mpoly_ctx.get(names, flint.Ordering.lex)
        self.generators: list[Polynomial] = list(reversed(self.context.gens()))
        self.zero: Polynomial = self.context.constant(0)
        self.one: Polynomial = self.context.constant(1)
        self.limit, self.budget = limit, budget
        self.spent = 0.0

    def constant(self, value: Fraction | int) -> Polynomial:
        """A rational number as a polynomial."""
        return self.context.constant(flint.fmpq(*value.as_integer_ratio()))

    def scaled(self, p: Polynomial, value: Fraction) -> Polynomial:
        """value · p."""
        return p * flint.fmpq(*value.as_integer_ratio())

    def charge(self, cost: float, pace: float = PACE) -> None:
        """Book a cost in term products; raises TooCostly beyond the limit, BudgetExceeded beyond the time.

        FLINT looks at no clock: what can't be done in time, at a `pace` of so many term products a second, isn't begun.
        """
        if cost > LONG and cost > pace * self.budget.left():
            raise TooCostly(f"{cost:.1e} term products in the time that is left")
        self.spent += cost
        if self.spent > self.limit:
            raise TooCostly(f"{self.spent:.1e} term products")
        if cost > 2e4:
            self.budget.check()

    def times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """a · b."""
        cost = len(a) * len(b)
        if cost > 2e8:
            raise TooCostly(f"a product of {len(a)} by {len(b)} terms")
        self.charge(cost)
        return a * b

    def power(self, a: Polynomial, exponent: int) -> Polynomial:
        """a ** exponent: by so many terms, and by the words of 64 bits that each of their coefficients takes."""
        words = 1 + exponent * (_longest(a) - 1 + (len(a) - 1).bit_length()) // 64
        if len(a) > 1 or words > 1:
            self.charge(2.0 * words * math.comb(len(a) + exponent - 1, exponent), PACE_OF_POWERS)
        return a**exponent

    def degrees(self, p: Polynomial) -> tuple[int, ...]:
        """The degree in each generator, lowest generator first."""
        return p.degrees()[::-1]

    def terms(self, p: Polynomial) -> dict[Monomial, Fraction]:
        """The coefficients by exponents, lowest generator first."""
        return {tuple(map(int, m))[::-1]: Fraction(int(c.p), int(c.q)) for m, c in p.to_dict().items()}

    def polynomial(self, terms: dict[Monomial, Fraction]) -> Polynomial:
        """The polynomial of these coefficients."""
        return self.context.from_dict({m[::-1]: flint.fmpq(*c.as_integer_ratio()) for m, c in terms.items()})

    def factor(self, p: Polynomial) -> tuple[Fraction, list[tuple[Polynomial, int]]]:
        """Content and irreducible factors over Q."""
        if p.total_degree() == 1 and len(p) > 1:
            return Fraction(1), [(p, 1)]
        if p.total_degree() > HIGHEST:
            raise TooCostly(f"a factorisation in degree {p.total_degree()}")
        self.charge(20.0 * len(p))
        content, factors = self._factors(p)
        return Fraction(int(content.p), int(content.q)), [(f, int(e)) for f, e in factors]

    def _factors(self, p: Polynomial) -> tuple[Any, list[tuple[Polynomial, int]]]:
        """FLINT's factors, found in a ring of no more generators than p contains: what isn't there costs too."""
        used = [f"g{k}" for k, e in enumerate(self.degrees(p)) if e]
        if 2 * len(used) > self.size or self.size < FEW:
            return p.factor()
        names = [f"g{k}" for k in range(len(used))]
        small = flint.fmpq_mpoly_ctx.get(tuple(reversed(names)), flint.Ordering.lex)
        content, factors = p.project_to_context(small, dict(zip(used, names, strict=True))).factor()
        back = dict(zip(names, used, strict=True))
        return content, [(f.project_to_context(self.context, back), e) for f, e in factors]

    def square_root(self, p: Polynomial) -> Polynomial | None:
        """A square root over Q where p is a square, else None: much quicker than the factors."""
        try:
            return p.sqrt()
        except DomainError:
            return None

    def quotient(self, a: Polynomial, b: Polynomial) -> Polynomial | None:
        """a / b where the division is exact, else None."""
        self.charge(len(a))
        q, r = divmod(a, b)
        return None if r else q

    def leading(self, p: Polynomial) -> Fraction:
        """The leading coefficient."""
        c = p.leading_coefficient()
        return Fraction(int(c.p), int(c.q))


def _longest(p: Polynomial) -> int:
    """The bits of the longest numerator or denominator of its coefficients, 1 at least."""
    return max((int(c.height_bits()) for c in p.coeffs()), default=1)
