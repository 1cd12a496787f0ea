"""Actions and periods in intervals: ∫ (e + u D^r) dq between two simple zeros of D, or over a period of the coordinate.

D, u and e are formulas of the coordinate. A piece in which D is positive gives its length times the value in its middle
plus length³/24 times the second derivative, all of it in intervals. At an end D grows across a short piece, from below
0 to above: there is one zero in it, and ∫ D^r dq = D^(r + 1)/((r + 1) D') for some D' of the piece.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

from canon.checker.formulas import Formulas
from canon.checker.intervals import Intervals, Open, is_allowed

LEVELS, DEEPEST = 24, 12
"""Pieces get half as long so often towards an end; and one in which D isn't seen to be positive is halved so often."""


class Integrand(NamedTuple):
    """e + u D^r, of the coordinate x, as formulas; r is 1/2 or -1/2."""

    f: Formulas
    x: str
    e: int
    u: int
    D: int
    r: Fraction

    def all(self) -> list[int]:
        """e, u, D and their first and second derivatives."""
        first = [self.f.slope(a, self.x) for a in (self.e, self.u, self.D)]
        return [self.e, self.u, self.D, *first, *(self.f.slope(a, self.x) for a in first)]


class Enclosure:
    """An integral in intervals, with values for all names but the coordinate's; `conditions` hold along it."""

    def __init__(
        self,
        own: Intervals,
        of: Mapping[str, Any],
        integrand: Integrand,
        conditions: Sequence[tuple[int, str]],
        words: Sequence[str],
    ) -> None:
        self.own, self.of, self.g, self.conditions, self.words = own, of, integrand, conditions, words
        self.nodes = integrand.all()

    def _values(self, at: Any) -> list[Any]:
        """All of the integrand's parts in an interval, where the domain has all of it. Raises Open."""
        signed = [a for a, _ in self.conditions]
        found = self.own.values(self.g.f, [*self.nodes, *signed], {**self.of, self.g.x: at})
        inside = all(found[a].a > 0 if kind == "positive" else 0 not in found[a] for a, kind in self.conditions)
        if not inside or not is_allowed(self.words, at):
            raise Open
        return [found[a] for a in self.nodes]

    def between(self, low: Fraction, high: Fraction, n: int) -> Any:
        """Between two zeros of D, one near each of these places; the pieces' number grows with n. Raises Open."""
        half, near = (high - low) / 2, (high - low) / 2 / 2**LEVELS
        total = self._end(low - near, low + near, 1) + self._end(high + near, high - near, -1)
        steps = [Fraction(1, 2**k) for k in range(LEVELS, -1, -1)]
        for a, b in pairwise(steps):
            for k in range(n):
                c, d = (half * (a + (b - a) * Fraction(j, n)) for j in (k, k + 1))
                total = total + self._piece(low + c, low + d) + self._piece(high - d, high - c)
        return total

    def over(self, period: Any, n: int) -> Any:
        """Over a period of the coordinate, in which D is positive. Raises Open."""
        iv, total = self.own.iv, self.own.iv.mpf(0)
        for k in range(n):
            low, middle, high = (period * j / (2 * n) for j in (2 * k, 2 * k + 1, 2 * k + 2))
            total = total + self._summed(iv.mpf([low.a, high.b]), middle, period / n)
        return total

    def _end(self, out: Fraction, inside: Fraction, sign: int) -> Any:
        """From a zero of D, between two places, to the second of them; `sign` is that of D' there."""
        own = self.own
        piece = own.iv.mpf([own.number(min(out, inside)).a, own.number(max(out, inside)).b])
        e, u, _, *first, _, _, _ = self._values(piece)
        there, beyond = self._values(own.number(inside))[2], self._values(own.number(out))[2]
        steep = first[2] * sign
        if not (steep.a > 0 and there.a > 0 and beyond.b < 0):
            raise Open
        r = self.g.r
        root = there**2 / own.iv.sqrt(there) if r > 0 else own.iv.sqrt(there)  # D^(r + 1)
        return e * own.iv.mpf([0, own.number(abs(inside - out)).b]) + u * root / (own.number(r + 1) * steep)

    def _piece(self, a: Fraction, b: Fraction, depth: int = 0) -> Any:
        own = self.own
        try:
            whole = own.iv.mpf([own.number(a).a, own.number(b).b])
            return self._summed(whole, own.number((a + b) / 2), own.number(b - a))
        except Open:
            if depth == DEEPEST:
                raise
            c = (a + b) / 2
            return self._piece(a, c, depth + 1) + self._piece(c, b, depth + 1)

    def _summed(self, at: Any, middle: Any, length: Any) -> Any:
        """The integral over a piece of so much length within an interval; its middle is an interval too."""
        own, r = self.own, self.own.number(self.g.r)
        e0, u0, D0, *_ = self._values(middle)
        _, u, D, _, u1, D1, e2, u2, D2 = self._values(at)
        other = D0 + D1 * (at - middle)  # the nearer of two enclosures
        D = own.iv.mpf([max(D.a, other.a), min(D.b, other.b)])
        if not D.a > 0:
            raise Open
        root = own.iv.sqrt(D)
        power = root if self.g.r > 0 else 1 / root  # D^r
        curved = u2 * power + 2 * r * u1 * power / D * D1
        curved = e2 + curved + u * r * power / D * ((r - 1) * D1**2 / D + D2)
        root = own.iv.sqrt(D0)
        return length * (e0 + u0 * (root if self.g.r > 0 else 1 / root)) + length**3 / 24 * curved


def refined(enclosure: Enclosure, low: Fraction, high: Fraction) -> Iterator[Any]:
    """Ever narrower intervals that hold the integral between two ends."""
    for n in (3, 8, 24):
        yield enclosure.between(low, high, n)
