"""Numbers modulo a random prime, with roots: where a formula is 0 in them, it is 0 by the relations of its functions.

Names and functions without a relation stand at random values; a root g^n = R is a basis 1, g, … g^(n−1) over those
before it, nothing chosen between the roots: an element that is 0 is 0 for each of them, and one that has an inverse
vanishes for none. An element is a table monomial → number; a monomial, pairs (generator, exponent).
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

from canon.checker import core
from canon.checker.functions import Unknown

Monomial = tuple[tuple[int, int], ...]
Element = dict[Monomial, int]
LARGEST, HIGHEST = 3_000_000, 60
"""Products of terms in one tower, beyond which it is given up; and the highest degree of a root."""


class Tower:
    """Generators in order, each with its relation, over a prime field."""

    def __init__(self, prime: int, rng: random.Random) -> None:
        self.prime, self.rng, self.spent = prime, rng, 0
        self._roots: list[tuple[int, Element]] = []  # of each generator g its n and its R, with g^n = R

    def free(self) -> Element:
        """A new quantity without a relation: a random number."""
        return self.constant(self.rng.randrange(1, self.prime))

    def constant(self, value: Any) -> Element:
        """A rational number."""
        x = value.numerator * pow(value.denominator, -1, self.prime) % self.prime
        return {(): x} if x else {}

    def root(self, radicand: Element, degree: int) -> Element:
        """A new generator g with g^degree = radicand."""
        if degree > HIGHEST:
            raise Unknown(f"a root of degree {degree}")
        self._roots.append((degree, radicand))
        return {((len(self._roots) - 1, 1),): 1}

    def add(self, a: Element, b: Element, factor: int = 1) -> Element:
        """a + factor b."""
        out = dict(a)
        for m, c in b.items():
            out[m] = (out.get(m, 0) + factor * c) % self.prime
        return {m: c for m, c in out.items() if c}

    def mul(self, a: Element, b: Element) -> Element:
        """The product, g^n replaced by R in it."""
        self.spent += 1 + len(a) * len(b)
        if self.spent > LARGEST:
            raise Unknown("relations that are too many to be followed")
        out: Element = {}
        for m, c in core.combined({}, a, b).items():
            over = [(g, e) for g, e in m if e >= self._roots[g][0]]
            if not over:
                out[m] = (out.get(m, 0) + c) % self.prime
                continue
            (g, e), (n, radicand) = over[-1], self._roots[over[-1][0]]
            rest = tuple((h, e - n if h == g else k) for h, k in m if h != g or e > n)
            out = self.add(out, self.mul({rest: c % self.prime}, radicand))
        return {m: c for m, c in out.items() if c}

    def power(self, a: Element, n: int) -> Element:
        """a^n. Raises ZeroDivisionError for an inverse that isn't there."""
        if n < 0:
            return self.power(self.inverse(a), -n)
        half = self.power(a, n // 2) if n else self.constant(1)
        square = self.mul(half, half)
        return self.mul(square, a) if n % 2 else square

    def inverse(self, a: Element) -> Element:
        """1/a, by its characteristic polynomial over the generators before its last one (Faddeev and LeVerrier).

        The trace of a product is n times what is free of g in it. Raises ZeroDivisionError for a divisor of 0.
        """
        g = max((g for m in a for g, _ in m), default=-1)
        if not a:
            raise ZeroDivisionError
        if g < 0:
            return {(): pow(a[()], -1, self.prime)}
        n, rest, last, constant = self._roots[g][0], self.constant(1), self.constant(1), self.constant(0)
        for k in range(1, n + 1):
            last, moved = rest, self.mul(a, rest)
            free = {m: c for m, c in moved.items() if g not in dict(m)}
            constant = self.mul(free, {(): n * pow(-k, -1, self.prime) % self.prime})
            rest = self.add(moved, constant)
        return self.mul(last, self.inverse(self.mul(constant, {(): self.prime - 1})))

    def polynomial(self, p: core.Polynomial, of: Mapping[str, Element]) -> Element:
        """The value of a polynomial, its names' values being given."""
        total: Element = {}
        for monomial, c in p.items():
            term = self.constant(c)
            for name, e in monomial:
                term = self.mul(term, self.power(of[name], e))
            total = self.add(total, term)
        return total
