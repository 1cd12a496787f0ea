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
LARGEST = 3_000_000
"""Products of terms in one tower, beyond which it is given up."""


class Tower:
    """Generators in order, each with its relation, over a prime field."""

    def __init__(self, prime: int, rng: random.Random) -> None:
        self.prime, self.rng, self.spent = prime, rng, 0
        self._powers: list[list[Element]] = []  # of each generator: 1, g, … g^n and further as they are needed
        self._degrees: list[int] = []

    def free(self) -> Element:
        """A new quantity without a relation: a random number."""
        return self.constant(self.rng.randrange(1, self.prime))

    def constant(self, value: Any) -> Element:
        """A rational number."""
        x = value.numerator * pow(value.denominator, -1, self.prime) % self.prime
        return {(): x} if x else {}

    def root(self, radicand: Element, degree: int) -> Element:
        """A new generator g with g^degree = radicand."""
        k = len(self._degrees)
        self._degrees.append(degree)
        self._powers.append([{((k, e),): 1} if e else {(): 1} for e in range(degree)] + [radicand])
        return {((k, 1),): 1}

    def add(self, a: Element, b: Element, factor: int = 1) -> Element:
        """a + factor b."""
        out = dict(a)
        for m, c in b.items():
            out[m] = (out.get(m, 0) + factor * c) % self.prime
        return {m: c for m, c in out.items() if c}

    def mul(self, a: Element, b: Element) -> Element:
        """The product, powers of generators reduced by their relations."""
        self.spent += len(a) * len(b)
        if self.spent > LARGEST:
            raise Unknown("relations that are too many to be followed")
        out: Element = {}
        over: list[tuple[Monomial, int]] = []
        for m, c in a.items():
            for n, d in b.items():
                powers = dict(m)
                for g, e in n:
                    powers[g] = powers.get(g, 0) + e
                key = tuple(sorted(powers.items()))
                if any(e >= self._degrees[g] for g, e in key):
                    over.append((key, c * d))
                else:
                    out[key] = (out.get(key, 0) + c * d) % self.prime
        out = {m: c for m, c in out.items() if c}
        for key, c in over:
            g, e = max((g, e) for g, e in key if e >= self._degrees[g])
            rest: Element = {tuple(pair for pair in key if pair[0] != g): c % self.prime}
            out = self.add(out, self.mul(rest, self._power_of(g, e)))
        return out

    def _power_of(self, g: int, e: int) -> Element:
        known = self._powers[g]
        while len(known) <= e:
            known.append(self.mul(known[-1], {((g, 1),): 1}))
        return known[e]

    def power(self, a: Element, n: int) -> Element:
        """a^n. Raises ZeroDivisionError for an inverse that isn't there."""
        if n < 0:
            return self.power(self.inverse(a), -n)
        out, square = self.constant(1), a
        while n:
            out = self.mul(out, square) if n & 1 else out
            n >>= 1
            square = self.mul(square, square) if n else square
        return out

    def inverse(self, a: Element) -> Element:
        """1/a, by Cayley and Hamilton for the last generator in it. Raises ZeroDivisionError for a divisor of 0."""
        g = max((g for m in a for g, _ in m), default=-1)
        if g < 0:
            if not a:
                raise ZeroDivisionError
            return {(): pow(a[()], -1, self.prime)}
        n, powers, traces = self._degrees[g], [self.constant(1)], list[Element]()
        for _ in range(n):
            powers.append(self.mul(powers[-1], a))
            traces.append(self._trace(powers[-1], g))
        symmetric = [self.constant(1)]  # elementary ones of the conjugates (Newton)
        for k in range(1, n + 1):
            total: Element = {}
            for i in range(1, k + 1):
                total = self.add(total, self.mul(symmetric[k - i], traces[i - 1]), (-1) ** (i - 1))
            symmetric.append(self.mul(total, {(): pow(k, -1, self.prime)}))
        found: Element = {}
        for k in range(n):  # a^n − e1 a^(n−1) + … ± en = 0
            found = self.add(found, self.mul(symmetric[k], powers[n - 1 - k]), (-1) ** (n - 1 - k))
        return self.mul(found, self.inverse(symmetric[n]))

    def _trace(self, a: Element, g: int) -> Element:
        """The trace of the multiplication by a over the generators before g."""
        total: Element = {}
        for j in range(self._degrees[g]):
            moved = self.mul(a, {((g, j),): 1} if j else {(): 1})
            here = {tuple(p for p in m if p[0] != g): c for m, c in moved.items() if dict(m).get(g, 0) == j}
            total = self.add(total, here)
        return total

    def polynomial(self, p: core.Polynomial, of: Mapping[str, Element]) -> Element:
        """The value of a polynomial, its names' values being given."""
        total: Element = {}
        for monomial, c in p.items():
            term = self.constant(c)
            for name, e in monomial:
                term = self.mul(term, self.power(of[name], e))
            total = self.add(total, term)
        return total
