"""Exponentials that outgrow every power, or fall below it, taken out of a formula.

As s tends to 0+, a node is Σ exp(E)·rest with exponents E that tend to an infinity, or are 0, and nothing of the kind
left in any `rest`: cosh x − sinh x is exp(−x), tanh x is (1 − exp(−2x))/(1 + exp(−2x)). What is divided by, or under a
root, has its largest exponential in front (the scale of Gruntz, On computing limits in a symbolic manipulation system,
1996, without his comparison of logarithms). All of it is exact.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import NamedTuple

from canon.decide.asymptotic import Expander, Sign
from canon.decide.power_series import Unexpanded
from canon.decide.tape import Node

TERMS = 12
"""Exponentials of one sum that are kept apart."""

Exponentials = Mapping[Node, Node]
"""exponent → rest: their sum of products."""


class Tamed(NamedTuple):
    """A node as exp(`exponent`)·`rest`."""

    exponent: Node
    rest: Node


def tamed(expander: Expander, node: Node) -> Tamed:
    """The node with its largest exponential taken out, exactly. **Raises:** `Unexpanded`, `Ramified`."""
    return _Taming(expander).of(node)


def growth(expander: Expander, exponent: Node) -> Sign:
    """Whether an exponent tends to +∞ ("pos"), to −∞ ("neg"), or stays bounded ("zero").

    **Raises:** `Unexpanded`, `Ramified`.
    """
    return _Taming(expander).growth(exponent)


class _Taming:
    """The nodes that have been taken apart."""

    def __init__(self, expander: Expander) -> None:
        self.expander = expander
        self.tape = expander.tape
        self.known: dict[Node, Exponentials] = {}

    def of(self, node: Node) -> Tamed:
        for i in self.tape.reach([node]):
            if i not in self.known:
                moves = self.expander.s in self.tape.support(i)
                self.known[i] = self._step(i) if moves else {self.tape.zero: i}
        return self._collapsed(self.known[node])

    def growth(self, exponent: Node) -> Sign:
        if self.tape.is_complex(exponent):
            raise Unexpanded("complex values")
        if self.tape.value(exponent) is not None:
            return "zero"
        part = self.of(exponent)
        series = self.expander.of(part.rest)
        if part.exponent == self.tape.zero:
            return self.expander.tends(series)
        inner = self.growth(part.exponent)
        return self.expander.leading(series)[1] if inner == "pos" else "zero"

    def _step(self, i: Node) -> Exponentials:
        tape, op = self.tape, self.tape.ops[i]
        if op[0] == "s":
            return {tape.zero: i}
        if op[0] == "+":
            parts = [(exponent, rest, c) for a, c in op[2] for exponent, rest in self.known[a].items()]
            return self._gathered([(tape.zero, tape.one, op[1]), *parts])
        if op[0] == "*":
            return self._product(op[1])
        if op[0] == "r":
            power, inner = Fraction(op[2], op[3]), self._collapsed(self.known[op[1]])
            return {tape.scaled(inner.exponent, power): tape.root(inner.rest, power)}
        parts = [self._collapsed(self.known[a]) for a in op[-1]]
        plain = [self._whole(part) for part in parts]
        if op[0] != "f":
            return {tape.zero: tape.arbitrary(op[1], op[2], tuple(plain))}
        if op[1] == "exp" and self.growth(plain[0]) != "zero":
            return {plain[0]: tape.one}
        if op[1] == "log":
            return {tape.zero: tape.plus(parts[0].exponent, tape.call("log", parts[0].rest))}
        if op[1] == "abs":
            return {parts[0].exponent: tape.call("abs", parts[0].rest)}
        if op[1] == "atan" and self.growth(parts[0].exponent) == "pos":
            return {tape.zero: self._arc(parts[0])}
        return {tape.zero: tape.call(op[1], *plain)}

    def _arc(self, part: Tamed) -> Node:
        """atan u = ±π/2 − atan(1/u) where u grows."""
        tape, (_, sign) = self.tape, self.expander.leading(self.expander.of(part.rest))
        quarter = tape.scaled(tape.constant("pi"), Fraction(1 if sign == "pos" else -1, 2))
        inverse = self._whole(Tamed(tape.negative(part.exponent), tape.power(part.rest, -1)))
        return tape.minus(quarter, tape.call("atan", inverse))

    def _product(self, powers: Iterable[tuple[Node, int]]) -> Exponentials:
        tape = self.tape
        total: Exponentials = {tape.zero: tape.one}
        for a, e in powers:
            parts = self.known[a]
            if len(parts) > 1 and not 0 < e < TERMS:
                one = self._collapsed(parts)
                parts = {one.exponent: one.rest}
            if len(parts) == 1:
                ((exponent, rest),) = parts.items()
                factors = [(tape.scaled(exponent, e), tape.power(rest, e))]
                total = self._times(total, factors)
                continue
            for _ in range(e):
                total = self._times(total, parts.items())
        return total

    def _times(self, left: Exponentials, right: Iterable[tuple[Node, Node]]) -> Exponentials:
        tape = self.tape
        return self._gathered(
            (tape.plus(a, b), tape.times(x, y), Fraction(1)) for b, y in right for a, x in left.items()
        )

    def _gathered(self, terms: Iterable[tuple[Node, Node, Fraction]]) -> Exponentials:
        """The sum, one term for each exponent; those that differ by something bounded are one."""
        tape = self.tape
        found: dict[Node, list[tuple[Node, Fraction]]] = {}
        for exponent, rest, c in terms:
            if not c:
                continue
            if exponent != tape.zero and self.growth(exponent) == "zero":
                exponent, rest = tape.zero, tape.times(tape.call("exp", exponent), rest)
            near = next((other for other in found if self._beside(exponent, other)), None)
            if near is None:
                found[exponent] = [(rest, c)]
            else:
                found[near].append((tape.times(tape.call("exp", tape.minus(exponent, near)), rest), c))
        if len(found) > TERMS:
            raise Unexpanded("too many exponentials")
        sums = {exponent: tape.add(parts) for exponent, parts in found.items()}
        kept = {exponent: rest for exponent, rest in sums.items() if tape.value(rest) != 0}
        return kept or {tape.zero: tape.zero}

    def _beside(self, exponent: Node, other: Node) -> bool:
        return exponent == other or self.growth(self.tape.minus(exponent, other)) == "zero"

    def _collapsed(self, parts: Exponentials) -> Tamed:
        """The sum with its largest exponential in front."""
        tape = self.tape
        exponents = list(parts)
        largest = exponents[0]
        for exponent in exponents[1:]:
            if self.growth(tape.minus(exponent, largest)) == "pos":
                largest = exponent
        smaller = (
            tape.times(tape.call("exp", tape.minus(exponent, largest)), rest) for exponent, rest in parts.items()
        )
        return Tamed(largest, tape.plus(*smaller))

    def _whole(self, part: Tamed) -> Node:
        return self.tape.times(self.tape.call("exp", part.exponent), part.rest)
