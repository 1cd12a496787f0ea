"""Exact open intervals of symbols, with end points in Q + Q·π, and what they say of signs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

from flint import arb

from canon import sign
from canon.decide.arbitrary import rational
from canon.decide.enclosure import precision
from canon.decide.region import Region
from canon.decide.tape import Node, Tape


@dataclass(frozen=True)
class Edge:
    """The number rational + pi · π."""

    rational: Fraction = Fraction(0)
    pi: Fraction = Fraction(0)

    def scaled(self, factor: Fraction) -> Edge:
        """factor · edge."""
        return Edge(self.rational * factor, self.pi * factor)

    def plus(self, other: Edge) -> Edge:
        """The sum."""
        return Edge(self.rational + other.rational, self.pi + other.pi)

    def compare(self, other: Edge) -> int:
        """−1, 0 or 1, exactly: π is irrational, so only equal data are equal."""
        a, b = self.rational - other.rational, self.pi - other.pi
        if not b:
            return (a > 0) - (a < 0)
        for bits in (64, 256, 4096):
            with precision(bits):
                value = arb(rational(a)) + arb(rational(b)) * arb.pi()
                if value > 0:
                    return 1
                if value < 0:
                    return -1
        raise ArithmeticError("two numbers too close to compare")

    def floor_of_multiple_of_pi(self) -> int:
        """The floor of edge / π."""
        if not self.rational:
            return self.pi.numerator // self.pi.denominator
        for bits in (64, 256, 4096):
            with precision(bits):
                whole = (arb(rational(self.rational)) / arb.pi() + arb(rational(self.pi))).floor().unique_fmpz()
                if whole is not None:
                    return int(whole)
        raise ArithmeticError("a number too close to a multiple of pi")


ORIGIN = Edge()


@dataclass(frozen=True)
class Interval:
    """An open interval; None is an infinite end."""

    low: Edge | None = None
    high: Edge | None = None

    def meet(self, other: Interval) -> Interval:
        """The intersection."""
        lows = [e for e in (self.low, other.low) if e is not None]
        highs = [e for e in (self.high, other.high) if e is not None]
        low = lows[0] if lows else None
        for e in lows[1:]:
            low = e if low is None or e.compare(low) > 0 else low
        high = highs[0] if highs else None
        for e in highs[1:]:
            high = e if high is None or e.compare(high) < 0 else high
        return Interval(low, high)

    def is_empty(self) -> bool:
        """True when no number lies inside."""
        return self.low is not None and self.high is not None and self.low.compare(self.high) >= 0

    def contains(self, value: Fraction | Edge) -> bool:
        """True for a number inside."""
        edge = value if isinstance(value, Edge) else Edge(value)
        above = self.low is None or self.low.compare(edge) < 0
        return above and (self.high is None or self.high.compare(edge) > 0)

    def sign(self) -> str | None:
        """ "pos" or "neg" where every number inside has that sign."""
        if self.low is not None and self.low.compare(ORIGIN) >= 0:
            return "pos"
        if self.high is not None and self.high.compare(ORIGIN) <= 0:
            return "neg"
        return None

    def affine(self, slope: Fraction, shift: Edge) -> Interval:
        """The image under x → slope · x + shift, for a slope that isn't 0."""
        low = None if self.low is None else self.low.scaled(slope).plus(shift)
        high = None if self.high is None else self.high.scaled(slope).plus(shift)
        return Interval(low, high) if slope > 0 else Interval(high, low)

    def sine_sign(self) -> str | None:
        """The sign of sin on the interval, where it has one."""
        if self.low is None or self.high is None or self.is_empty():
            return None
        k = self.low.floor_of_multiple_of_pi()
        if self.high.compare(Edge(Fraction(0), Fraction(k + 1))) > 0:
            return None
        return "pos" if k % 2 == 0 else "neg"

    def cosine_sign(self) -> str | None:
        """The sign of cos on the interval, where it has one."""
        return self.affine(Fraction(1), Edge(Fraction(0), Fraction(1, 2))).sine_sign()


def exact_affine(tape: Tape, node: Node) -> tuple[Edge, Fraction, Node] | None:
    """(constant, slope, symbol) of constant + slope · symbol with constant in Q + Q·π; None for other nodes."""
    op = tape.ops[node]
    if op[0] == "s":
        return ORIGIN, Fraction(1), node
    if op[0] != "+":
        return None
    constant, found = Edge(op[1]), None
    for inner, coefficient in op[2]:
        kind = tape.ops[inner]
        if kind == ("c", "pi"):
            constant = constant.plus(Edge(Fraction(0), coefficient))
        elif kind[0] == "s" and found is None:
            found = (coefficient, inner)
        else:
            return None
    return None if found is None else (constant, *found)


def half_line(constant: Edge, slope: Fraction) -> Interval:
    """Where constant + slope · x > 0."""
    edge = constant.scaled(-1 / slope)
    return Interval(low=edge) if slope > 0 else Interval(high=edge)


def declared(tape: Tape, node: Node) -> Interval:
    """The interval that a symbol's assumptions allow."""
    facts = sign.declared(tape.symbol_at(node))
    if facts.get("nonnegative"):
        return Interval(low=ORIGIN)
    return Interval(high=ORIGIN) if facts.get("nonpositive") else Interval()


def leaves_out_zero(tape: Tape, node: Node, interval: Interval) -> bool:
    """Whether 0 is inside a symbol's interval and its assumptions exclude it: then the interval is two, with a gap."""
    symbol = tape.symbol_at(node)
    return bool(symbol.is_real) and symbol.is_zero is False and interval.contains(ORIGIN)


def may_be_zero(tape: Tape, node: Node) -> bool:
    """Whether a name, which is said to be of one sign, may be 0 besides: intervals are open, and leave this end out."""
    facts = sign.declared(tape.symbol_at(node))
    return bool(facts.get("nonnegative") or facts.get("nonpositive")) and facts.get("zero") is not False


def with_zeros(tape: Tape, region: Region, symbols: Iterable[Node]) -> dict[Node, Interval]:
    """`intervals_of`, with 0 inside for those of the symbols that may be 0.

    What holds for a > 0 holds for a = 0 too, by continuity, where a may be varied; on a surface a = 0 may be a piece of
    its own, and an integer has nothing beside it.
    """
    out = intervals_of(tape, region)
    for node in symbols:
        if may_be_zero(tape, node):
            bounds = (half_line(*form[:2]) for form in _affine_conditions(tape, region) if form[2] == node)
            out[node] = reduce(Interval.meet, bounds, Interval())
    return out


def intervals_of(tape: Tape, region: Region) -> dict[Node, Interval]:
    """The exact interval of every symbol that a condition affine in it alone bounds."""
    out: dict[Node, Interval] = {}
    for constant, slope, symbol in _affine_conditions(tape, region):
        if tape.symbol_at(symbol).is_real:
            out[symbol] = out.get(symbol, declared(tape, symbol)).meet(half_line(constant, slope))
    return out


def _affine_conditions(tape: Tape, region: Region) -> Iterator[tuple[Edge, Fraction, Node]]:
    """constant + slope · symbol of each condition that is one > 0."""
    for requirement in region.requirements:
        form = exact_affine(tape, requirement.nodes[0]) if requirement.kind == "positive" else None
        if form is not None:
            yield form
