"""Balls for the generators of a tower at a point, from what each generator stands for."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING

from flint import acb, arb

from canon.decide.arbitrary import rational
from canon.decide.enclosure import REAL, Ball, OutOfDomain, off_the_slit, precision
from canon.decide.fraction_field import Element
from canon.decide.ring import Monomial, Polynomial
from canon.decide.tape import Node, Unsupported

if TYPE_CHECKING:
    from canon.decide.tower import Generator, Tower

SIGN_BITS = (128, 1024)


class GeneratorBalls:
    """Lazy balls for the generators at one point (symbol and arbitrary-function nodes as balls)."""

    def __init__(self, tower: Tower, point: Mapping[Node, Ball]) -> None:
        self.tower, self.point = tower, point
        self.known: dict[int, Ball] = {}

    def polynomial(self, p: Polynomial) -> Ball:
        """The value of a polynomial in the generators."""
        return self.value_of_terms(self.tower.ring.terms(p))

    def value_of_terms(self, terms: Mapping[Monomial, Fraction]) -> Ball:
        """The value of a polynomial given by its terms, which may come from another ring of the same generators."""
        total = arb(0)
        for monomial, coefficient in terms.items():
            term = arb(rational(coefficient))
            for k, e in enumerate(monomial):
                if e:
                    term = term * self.generator(k) ** e
            total = total + term
        return total

    def element(self, x: Element) -> Ball:
        """The value of a fraction."""
        value = self.polynomial(x[0])
        for k, e in x[1].items():
            divisor = self.polynomial(self.tower.field.factors[k])
            if divisor.contains(0):
                raise OutOfDomain("a denominator that may be zero")
            value = value / divisor**e
        return value

    def generator(self, k: int) -> Ball:
        """The value of one generator."""
        if k not in self.known:
            value = self._value(self.tower.generators[k])
            if not value.is_finite():
                raise OutOfDomain("a value that is not finite")
            self.known[k] = value
        return self.known[k]

    def _value(self, g: Generator) -> Ball:
        kind, data = g.kind, g.data
        if kind == "symbol":
            if data not in self.point:
                raise Unsupported("a generator that isn't a number")
            return self.point[data]
        if kind == "arbitrary":
            raise Unsupported("the value of an arbitrary function")
        if kind == "pi":
            return arb.pi()
        if kind == "I":
            return acb(0, 1)
        if kind in ("cos", "sin"):
            return getattr(self.element(data), kind)()
        if kind in ("cos of pi/n", "sin of pi/n"):
            angle = arb.pi() / data
            return angle.cos() if kind.startswith("cos") else angle.sin()
        if kind == "exp":
            return self.element(data).exp()
        if kind == "log":
            return _log(self.polynomial(data[1]) / (1 if len(data) == 2 else self.polynomial(data[2])))
        if kind == "root" and data[0] == "chain":
            return _root(self.polynomial(data[1]), data[2] ** data[3])
        if kind == "root":
            under = self.polynomial(data[2])
            return under * _root(self.polynomial(data[1]) / under, data[3])
        if kind == "abs":
            return abs(self.polynomial(data))
        return REAL[kind](*(self.element(x) for x in data))


def _root(base: Ball, degree: int) -> Ball:
    if not off_the_slit(base):
        raise OutOfDomain("a radicand that may be negative or zero")
    return base.root(degree) if isinstance(base, arb) else (base.log() / degree).exp()


def _log(base: Ball) -> Ball:
    if not off_the_slit(base):
        raise OutOfDomain("the logarithm of something that may be zero or negative")
    return base.log()


def constant_sign(tower: Tower, p: Polynomial) -> str | None:
    """The sign of a number made of constants, by a ball that excludes 0."""
    if not all(g.constant for g in tower.used(p)):
        return None
    for bits in SIGN_BITS:
        with precision(bits):
            try:
                value = GeneratorBalls(tower, {}).polynomial(p)
            except (OutOfDomain, Unsupported, ZeroDivisionError):
                return None
            if not isinstance(value, arb):
                return None
            if value > 0:
                return "pos"
            if value < 0:
                return "neg"
    return None
