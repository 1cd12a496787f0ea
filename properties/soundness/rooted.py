"""Polynomials made of their real roots, so that their signs are known exactly, by comparing fractions."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from properties.soundness.formula import Formula, of

TINY = tuple(Fraction(1, 10**k) for k in (1, 2, 3, 4, 6, 9, 12))


@dataclass(frozen=True)
class Polynomial:
    """`factor` · Π (u − root)**multiplicity · Π (u² + d) with every d positive."""

    factor: Fraction
    roots: tuple[tuple[Fraction, int], ...]
    positive: tuple[Fraction, ...] = ()

    def sign(self, u: Fraction) -> int:
        """The sign at u, where roots of even multiplicity count as if the polynomial weren't 0 there."""
        value = 1 if self.factor > 0 else -1
        for root, power in self.roots:
            if power % 2 and u < root:
                value = -value
        return value

    def changes(self) -> list[Fraction]:
        """Where the sign changes."""
        return [root for root, power in self.roots if power % 2]

    def written(self, rng: random.Random, u: Formula) -> Formula:
        """The polynomial of u, as its factors or multiplied out."""
        parts = [(-root, Fraction(1)) for root, power in self.roots for _ in range(power)]
        parts += [(d, Fraction(0), Fraction(1)) for d in self.positive]
        if len(parts) > 1 and rng.random() < 0.5:
            return _sum(_product(self.factor, parts), u)
        out: Formula | None = None
        for root, power in self.roots:
            part = u - root if power == 1 else (u - root) ** power
            out = part if out is None else out * part
        for d in self.positive:
            out = u**2 + d if out is None else out * (u**2 + d)
        assert out is not None
        return out if self.factor == 1 else self.factor * out


def _product(factor: Fraction, parts: Sequence[tuple[Fraction, ...]]) -> list[Fraction]:
    total = [factor]
    for part in parts:
        new = [Fraction(0)] * (len(total) + len(part) - 1)
        for i, c in enumerate(total):
            for j, d in enumerate(part):
                new[i + j] += c * d
        total = new
    return total


def _sum(coefficients: Sequence[Fraction], u: Formula) -> Formula:
    out: Formula | None = None
    for power, c in enumerate(coefficients):
        if c:
            term = of(c) if power == 0 else c * u if power == 1 else c * u**power
            out = term if out is None else out + term
    assert out is not None
    return out


def polynomial(rng: random.Random, near: Sequence[Fraction]) -> Polynomial:
    """A random polynomial whose roots are at, or close to, some of these numbers."""
    roots: dict[Fraction, int] = {}
    for _ in range(rng.choice((1, 1, 1, 2, 2, 3))):
        root = rng.choice(near)
        if rng.random() < 0.4:
            root += rng.choice((1, -1)) * rng.choice(TINY)
        roots[root] = roots.get(root, 0) + rng.choice((1, 1, 1, 2))
    positive = (rng.choice((Fraction(1), Fraction(1, 1000), Fraction(2))),) if rng.random() < 0.2 else ()
    factor = rng.choice((Fraction(1), Fraction(1), Fraction(-1), Fraction(2), Fraction(-1, 3)))
    return Polynomial(factor, tuple(roots.items()), positive)
