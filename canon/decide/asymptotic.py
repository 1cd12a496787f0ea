"""Asymptotic expansions on the tape: a node as Σ c_k s^k, k from some integer on, for a symbol s that tends to 0+.

The coefficients are nodes without s, and all operations are those on convergent, or at least asymptotic, series: sums,
products, quotients by a series whose leading coefficient is nowhere zero, and analytic functions of series at points
inside their domains (Olver, Asymptotics and Special Functions, §1.7). What is smaller than every power, exp(−1/s), is 0
to all orders. The coefficients are exact for all values of the other names at which the signs hold that are asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import comb, lcm
from typing import Literal

import sympy as sp

from canon.decide.derivative import derivative, substitute
from canon.decide.power_series import Series, SeriesArithmetic
from canon.decide.tape import ONE, Node, Tape, Unsupported

Sign = Literal["zero", "pos", "neg"]
SignOf = Callable[[Node], Sign | None]
"""The sign that a node without s has for all values of its names; None where it isn't known, or changes."""

HALF = Fraction(1, 2)


class Unexpanded(Exception):
    """No expansion in powers of s is known."""


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

    def _sign(self, node: Node) -> Sign | None:
        return None if self.wild(node) else self.sign_of(node)

    def leading(self, f: Series) -> tuple[Series, Sign]:
        """The series from its first nonzero coefficient on, with that one's sign."""
        for k, c in enumerate(f.coefficients):
            sign = self._sign(c)
            if sign is None:
                raise Unexpanded(f"a leading coefficient of unknown sign: {_text(self.tape, c)}")
            if sign != "zero":
                return Series(f.start + k, f.coefficients[k:]), sign
        raise Unexpanded("all coefficients vanish that were computed")

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
            return self._function(op[1], op[2], arguments)
        return self._arbitrary(op[1], op[2], op[3], arguments)

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
        f, sign = self.leading(f)
        if exponent.denominator > 1 and sign != "pos":
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

    # -- functions ----------------------------------------------------------------------------

    def _function(self, name: str, nodes: Sequence[Node], arguments: Sequence[Series]) -> Series:
        tape, u = self.tape, arguments[0]
        if name == "abs":
            f, sign = self.leading(u)
            return f if sign == "pos" else self.series.scaled(f, -ONE)
        if name == "atan2":
            return self._atan2(*arguments)
        if name == "log":
            return self._log(u)
        if name == "exp" and u.start < 0:
            u, sign = self._stripped(u)
            if u.start < 0:
                if sign == "pos":
                    raise Unexpanded("an exponential beyond every power")
                return self.series.exact(0, ())  # smaller than every power
        if name == "atan":
            return self._atan(u)
        if name in ("sin", "cos") and self._may_grow(u):
            wave = tape.symbol(sp.Dummy("wave", real=True))
            self.waves.add(wave)
            return self.series.exact(0, (wave,))
        if any(f.start < 0 and self._stripped(f)[0].start < 0 for f in arguments):
            raise Unexpanded(f"{name} of something that grows beyond all bounds")
        moving = [k for k, a in enumerate(nodes) if self.s in tape.support(a)]
        if len(moving) > 1:
            raise Unexpanded(f"{name} of several arguments that move")
        (k,) = moving
        place = tape.symbol(sp.Dummy(real=True))
        call = tape.call(name, *(place if j == k else a for j, a in enumerate(nodes)))
        return self._taylor(call, place, self._stripped(arguments[k])[0], name)

    def _may_grow(self, u: Series) -> bool:
        """Whether the series isn't seen to be bounded; a sine or cosine of it is, whatever it does."""
        try:
            return self._stripped(u)[0].start < 0
        except Unexpanded:
            return True

    def _stripped(self, f: Series) -> tuple[Series, Sign]:
        """The series without vanishing terms of negative powers, and the sign of its first term."""
        for k, c in enumerate(f.coefficients):
            if f.start + k >= 0:
                return Series(f.start + k, f.coefficients[k:]), "zero"
            sign = self._sign(c)
            if sign is None:
                raise Unexpanded(f"a leading coefficient of unknown sign: {_text(self.tape, c)}")
            if sign != "zero":
                return Series(f.start + k, f.coefficients[k:]), sign
        raise Unexpanded("too few terms")

    def _taylor(self, call: Node, place: Node, u: Series, name: str) -> Series:
        """A function of one argument at the argument's value for s = 0, which lies inside its domain."""
        tape = self.tape
        if u.start > 0:
            u = Series(0, (*([tape.zero] * u.start), *u.coefficients))
        if not u.coefficients:
            raise Unexpanded("too few terms")
        centre = u.coefficients[0]
        if self.wild(centre):
            raise Unexpanded(f"{name} of a logarithm or an oscillation")
        if name in ("elliptic_k", "elliptic_e") and self.sign_of(centre) == "zero":
            return self.series.composed(self._elliptic(name), self.series.rest(u, tape.one))
        if name in ("asin", "acos"):
            margin = tape.minus(tape.one, tape.power(centre, 2))
            if self.sign_of(margin) == "zero":
                return self._arc(name, u)
        self._inside(name, centre)
        coefficients, slope, factorial = [], call, 1
        for k in range(self.terms):
            factorial *= max(k, 1)
            at = self._plain(substitute(tape, slope, {place: centre}))
            coefficients.append(tape.scaled(at, Fraction(1, factorial)))
            if k + 1 < self.terms:
                try:
                    slope = derivative(tape, slope, place)
                except Unsupported as reason:
                    raise Unexpanded(str(reason)) from None
        return self.series.composed(coefficients, self.series.rest(u, tape.one))

    def _plain(self, node: Node) -> Node:
        """The number that a sine or cosine of a multiple of π/2, or its negative, is; else the node as it is."""
        tape, op = self.tape, self.tape.ops[node]
        if op[0] == "+" and not op[1] and len(op[2]) == 1:
            inner, factor = op[2][0]
            return tape.scaled(self._plain(inner), factor)
        if op[0] != "f" or op[1] not in ("sin", "cos"):
            return node
        turns = tape.times(op[2][0], tape.power(tape.constant("pi"), -1))
        value = tape.value(tape.scaled(turns, 2))
        if value is None or value.denominator > 1:
            return node
        quarter = (int(value) - (op[1] == "sin")) % 4  # sin x = cos(x − π/2)
        return tape.number((1, 0, -1, 0)[quarter])

    def _arc(self, name: str, u: Series) -> Series:
        """asin or acos at ±1: asin u = atan(u/√(1 − u²)) on both sides of which |u| < 1."""
        root = self.power(
            self.series.add(self.series.exact(0, (self.tape.one,)), self.series.scaled(self.series.mul(u, u), -ONE)),
            HALF,
        )
        arc = self._atan(self.series.mul(u, self.power(root, -ONE)))
        if name == "asin":
            return arc
        quarter = self.series.exact(0, (self.tape.scaled(self.tape.constant("pi"), HALF),))
        return self.series.add(quarter, self.series.scaled(arc, -ONE))

    def _elliptic(self, name: str) -> list[Node]:
        """The coefficients at m = 0 of K or E (DLMF 19.5.1, 19.5.2)."""
        squares = [Fraction(comb(2 * n, n), 4**n) ** 2 for n in range(self.terms)]
        factors = [square if name == "elliptic_k" else square / (1 - 2 * n) for n, square in enumerate(squares)]
        return [self.tape.scaled(self.tape.constant("pi"), HALF * f) for f in factors]

    def _inside(self, name: str, centre: Node) -> None:
        """Whether the function is analytic at the point."""
        tape = self.tape
        if name in ("exp", "sin", "cos", "atan"):
            return
        if name in ("asin", "acos"):
            margin = tape.minus(tape.one, tape.power(centre, 2))
        elif name in ("elliptic_k", "elliptic_e") and self.sign_of(centre) in ("pos", "neg"):
            margin = tape.minus(tape.one, centre)
        elif name in ("gamma", "log"):
            margin = centre
        else:
            raise Unexpanded(f"no expansion of {name}")
        if self.sign_of(margin) != "pos":
            raise Unexpanded(f"{name} at the edge of its domain, or beyond")

    def _log(self, u: Series) -> Series:
        tape = self.tape
        f, sign = self.leading(u)
        if sign != "pos":
            raise Unexpanded("the logarithm of something that isn't positive")
        first = f.coefficients[0]
        coefficients = [tape.zero, *(tape.number(Fraction((-1) ** (k + 1), k)) for k in range(1, self.terms))]
        inner = self.series.composed(coefficients, self.series.rest(f, tape.power(first, -1)))
        lead = tape.add([(tape.call("log", first), 1), (self.log, f.start)])
        return self.series.add(self.series.exact(0, (lead,)), inner)

    def _atan(self, u: Series) -> Series:
        tape = self.tape
        u, sign = self._stripped(u)
        place = tape.symbol(sp.Dummy(real=True))
        call = tape.call("atan", place)
        if u.start >= 0:
            return self._taylor(call, place, u, "atan")
        turned = self._taylor(call, place, self.power(u, -ONE), "atan")
        quarter = tape.scaled(tape.constant("pi"), HALF if sign == "pos" else -HALF)
        return self.series.add(self.series.exact(0, (quarter,)), self.series.scaled(turned, -ONE))

    def _atan2(self, y: Series, x: Series) -> Series:
        tape = self.tape
        x, sign = self.leading(x)
        found = self._atan(self.series.mul(y, self.power(x, -ONE)))
        if sign == "pos":
            return found
        _, above = self.leading(y)
        half = tape.scaled(tape.constant("pi"), 1 if above == "pos" else -1)
        return self.series.add(found, self.series.exact(0, (half,)))

    def _arbitrary(
        self, name: str, orders: tuple[int, ...], nodes: tuple[Node, ...], arguments: Sequence[Series]
    ) -> Series:
        tape = self.tape
        moving = [k for k, a in enumerate(nodes) if self.s in tape.support(a)]
        if len(moving) > 1:
            raise Unexpanded(f"{name} of several arguments that move")
        (k,) = moving
        u = self._stripped(arguments[k])[0]
        if u.start < 0:
            raise Unexpanded(f"{name} of something that grows beyond all bounds")
        if u.start == 0 and u.coefficients:
            centre = u.coefficients[0]
        else:
            centre = tape.zero
        self.arbitrary.add((name, tuple(centre if j == k else a for j, a in enumerate(nodes))))
        place = tape.symbol(sp.Dummy(real=True))
        call = tape.arbitrary(name, orders, tuple(place if j == k else a for j, a in enumerate(nodes)))
        return self._taylor(call, place, u, "exp")


def _text(tape: Tape, node: Node) -> str:
    text = str(tape.to_sympy(node)) if len(tape.reach([node])) < 60 else "a long formula"
    return text if len(text) < 120 else "a long formula"


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
