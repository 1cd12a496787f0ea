"""Asymptotic expansions on the tape: a node as Σ c_k s^k, k from some integer on, for a symbol s that tends to 0+.

The coefficients are nodes without s, and all operations are those on convergent, or at least asymptotic, series: sums,
products, quotients by a series whose leading coefficient is nowhere zero, and analytic functions of series at points
inside their domains (Olver, Asymptotics and Special Functions, §1.7). What is smaller than every power, exp(−1/s), is 0
to all orders. The coefficients are exact for all values of the other names at which the signs hold that are asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import lcm
from typing import Literal

import sympy as sp

from canon.decide.asymptotic_functions import of_arbitrary, of_function
from canon.decide.derivative import substitute
from canon.decide.power_series import Series, SeriesArithmetic, Unexpanded, shortly
from canon.decide.tape import Node, Tape

Sign = Literal["zero", "pos", "neg"]
Known = Sign | Literal["nonzero"]
SignOf = Callable[[Node], Known | None]
"""The sign that a node without s has for all values of its names; None where it isn't known, or changes, but "nonzero"
where it is known to vanish nowhere."""


class Ramified(Exception):
    """The expansion is one in powers of s^(1/root)."""

    def __init__(self, root: int) -> None:
        super().__init__(f"powers of s**(1/{root})")
        self.root = root


class Expander:
    """Expansions of nodes in a symbol, with so many terms each, where `sign_of` tells the signs of coefficients."""

    def __init__(self, tape: Tape, s: Node, sign_of: SignOf, terms: int) -> None:
        self.tape, self.s, self.sign_of, self.terms = tape, s, sign_of, terms
        self.series = SeriesArithmetic(tape, terms)
        self.log = tape.symbol(sp.Dummy("log_s", real=True))
        self.waves: set[Node] = set()
        self.known: dict[Node, Series] = {}
        self.arbitrary: set[tuple[str, tuple[Node, ...]]] = set()

    def of(self, node: Node) -> Series:
        """The node's expansion. **Raises:** `Unexpanded`, `Ramified`."""
        for i in self.tape.reach([node]):
            if i not in self.known:
                self.known[i] = self._step(i)
        return self.known[node]

    def wild(self, node: Node) -> bool:
        """Whether the node has log s in it, or the sine or cosine of what grows: symbols here, the latter bounded."""
        return not {self.log, *self.waves}.isdisjoint(self.tape.support(node))

    def sign(self, node: Node) -> Sign | None:
        """The sign of a coefficient, where it is known."""
        sign = None if self.wild(node) else self.sign_of(node)
        return None if sign == "nonzero" else sign

    def from_nonzero(self, f: Series) -> Series:
        """The series from its first nonzero coefficient on, whose sign need not be known."""
        for k, c in enumerate(f.coefficients):
            sign = None if self.wild(c) else self.sign_of(c)
            if sign is None:
                raise Unexpanded(f"a leading coefficient that may be 0: {shortly(self.tape, c)}")
            if sign != "zero":
                return Series(f.start + k, f.coefficients[k:])
        raise Unexpanded("all coefficients vanish that were computed")

    def leading(self, f: Series) -> tuple[Series, Sign]:
        """The series from its first nonzero coefficient on, with that one's sign."""
        for k, c in enumerate(f.coefficients):
            sign = self.sign(c)
            if sign is None:
                raise Unexpanded(f"a leading coefficient of unknown sign: {shortly(self.tape, c)}")
            if sign != "zero":
                return Series(f.start + k, f.coefficients[k:]), sign
        raise Unexpanded("all coefficients vanish that were computed")

    def stripped(self, f: Series) -> tuple[Series, Sign]:
        """The series without vanishing terms of negative powers, and the sign of its first term."""
        for k, c in enumerate(f.coefficients):
            if f.start + k >= 0:
                return Series(f.start + k, f.coefficients[k:]), "zero"
            sign = self.sign(c)
            if sign is None:
                raise Unexpanded(f"a leading coefficient of unknown sign: {shortly(self.tape, c)}")
            if sign != "zero":
                return Series(f.start + k, f.coefficients[k:]), sign
        raise Unexpanded("too few terms")

    def tends(self, f: Series) -> Sign:
        """Whether the series tends to +∞ ("pos"), to −∞ ("neg"), or to a finite value ("zero").

        **Raises:** `Unexpanded`.
        """
        f, sign = self.stripped(f)
        if f.start < 0:
            return sign
        if f.coefficients and self.wild(f.coefficients[0]) and f.start == 0:
            raise Unexpanded("a logarithm or an oscillation in an exponent")
        return "zero"

    # -- operations ---------------------------------------------------------------------------

    def _step(self, i: Node) -> Series:
        tape, op = self.tape, self.tape.ops[i]
        if i == self.s:
            return self.series.exact(1, (tape.one,))
        if self.s not in tape.support(i):
            return self.series.exact(0, (i,))
        if tape.is_complex(i):
            raise Unexpanded("complex values")
        if op[0] == "+":
            total = self.series.exact(0, (tape.number(op[1]),))
            for a, c in op[2]:
                total = self.series.add(total, self.series.scaled(self.known[a], c))
            return total
        if op[0] == "*":
            total = self.series.exact(0, (tape.one,))
            for a, e in op[1]:
                total = self.series.mul(total, self._integer_power(self.known[a], e))
            return total
        if op[0] == "r":
            return self.power(self.known[op[1]], Fraction(op[2], op[3]))
        arguments = [self.known[a] for a in op[-1]]
        if op[0] == "f":
            return of_function(self, op[1], op[2], arguments)
        return of_arbitrary(self, op[1], op[2], op[3], arguments)

    def _integer_power(self, f: Series, exponent: int) -> Series:
        if exponent < 0:
            return self.power(f, Fraction(exponent))
        total = self.series.exact(0, (self.tape.one,))
        for _ in range(exponent):
            total = self.series.mul(total, f)
        return total

    def power(self, f: Series, exponent: Fraction) -> Series:
        """f ** exponent by the binomial series; a root needs a positive leading coefficient."""
        tape = self.tape
        if exponent.denominator == 1:
            f = self.from_nonzero(f)
        else:
            f, sign = self.leading(f)
            if sign != "pos":
                raise Unexpanded("a radicand that isn't positive")
        start = f.start * exponent
        if start.denominator > 1:
            raise Ramified(start.denominator)
        first = f.coefficients[0]
        rest = self.series.rest(f, tape.power(first, -1))
        coefficients, factor = [tape.one], Fraction(1)
        for k in range(1, self.terms):
            factor = factor * (exponent - k + 1) / k
            coefficients.append(tape.number(factor))
        inner = self.series.composed(coefficients, rest)
        lead = tape.root(first, exponent) if exponent.denominator > 1 else tape.power(first, int(exponent))
        return Series(int(start), tuple(tape.times(lead, c) for c in inner.coefficients))


def expand(
    tape: Tape, nodes: Sequence[Node], s: Node, sign_of: SignOf, terms: int, *, root: int = 1
) -> tuple[list[Series], int, Expander]:
    """The nodes' expansions in s^(1/root), the smallest root that serves, with that root and the expander.

    **Raises:** `Unexpanded`.
    """
    for _ in range(4):
        shift = {s: tape.power(s, root)}
        expander = Expander(tape, s, sign_of, terms)
        try:
            return [expander.of(substitute(tape, node, shift)) for node in nodes], root, expander
        except Ramified as need:
            root = lcm(root, root * need.root)
    raise Unexpanded("no expansion in fractional powers")
