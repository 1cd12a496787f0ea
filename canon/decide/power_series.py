"""Arithmetic of truncated series in powers of a symbol s, with nodes for coefficients."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from canon.decide.tape import Node, Tape


class Unexpanded(Exception):
    """No expansion in powers of s is known."""


@dataclass(frozen=True)
class Series:
    """Σ c_i s^(start + i) + o(s^(start + len(c) − 1)); without coefficients, o(s^(start − 1))."""

    start: int
    coefficients: tuple[Node, ...]

    @property
    def end(self) -> int:
        """The first power of which nothing is known."""
        return self.start + len(self.coefficients)


@dataclass(frozen=True)
class SeriesArithmetic:
    """Sums, products and compositions of series with at most so many terms."""

    tape: Tape
    terms: int

    def exact(self, start: int, coefficients: Sequence[Node]) -> Series:
        """The series with these coefficients alone."""
        return Series(start, (*coefficients, *([self.tape.zero] * (self.terms - len(coefficients)))))

    def scaled(self, f: Series, factor: Fraction) -> Series:
        """A multiple of f."""
        return Series(f.start, tuple(self.tape.scaled(c, factor) for c in f.coefficients))

    def add(self, f: Series, g: Series) -> Series:
        """f + g."""
        start, end = min(f.start, g.start), min(f.end, g.end, min(f.start, g.start) + self.terms)
        return Series(start, tuple(self.tape.plus(self.at(f, k), self.at(g, k)) for k in range(start, end)))

    def at(self, f: Series, power: int) -> Node:
        """The coefficient of a power below the end."""
        return f.coefficients[power - f.start] if power >= f.start else self.tape.zero

    def mul(self, f: Series, g: Series) -> Series:
        """f · g."""
        tape, count = self.tape, min(len(f.coefficients), len(g.coefficients))
        out = []
        for k in range(count):
            pairs = ((f.coefficients[i], g.coefficients[k - i]) for i in range(k + 1))
            kept = [(a, b) for a, b in pairs if tape.zero not in (a, b)]
            out.append(tape.plus(*(tape.times(a, b) for a, b in kept)) if kept else tape.zero)
        return Series(f.start + g.start, tuple(out))

    def rest(self, f: Series, factor: Node) -> Series:
        """The series without its first term, which is of order 0, times a factor: what tends to 0."""
        return Series(1, tuple(self.tape.times(factor, c) for c in f.coefficients[1:]))

    def composed(self, coefficients: Sequence[Node], u: Series) -> Series:
        """Σ a_k u^k for u = O(s), by Horner's rule; the tail is of the order of the first term left out."""
        total = Series(0, (coefficients[-1],))
        for a in reversed(coefficients[:-1]):
            product = self.mul(self._padded(total, u), u) if u.coefficients else Series(1, ())
            total = Series(0, (a, *product.coefficients))
        return Series(0, total.coefficients[: self.terms])

    def _padded(self, f: Series, u: Series) -> Series:
        """A partial sum of Horner's rule, exact to the order that is needed of it: its further terms don't matter."""
        return Series(f.start, (*f.coefficients, *([self.tape.zero] * (len(u.coefficients) - len(f.coefficients)))))


def shortly(tape: Tape, node: Node) -> str:
    """A coefficient in a message."""
    text = str(tape.to_sympy(node)) if len(tape.reach([node])) < 60 else "a long formula"
    return text if len(text) < 120 else "a long formula"
