"""Tails of integrals to infinity, with rigorous bounds: ∫ from X to ∞ of a formula of numbers and one variable.

With s = 1/x every value is enclosed as s^p·I for all 0 < s ≤ 1/X, I an interval; exponentials that grow or fall are
taken out first (`canon.decide.growth`). Where x^-p·I is left, the tail is I·X^(1−p)/(p − 1), else it is bounded by that
of x^-p·exp(−c x^k).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from flint import arb

from canon.decide.asymptotic import Expander, Ramified, SignOf
from canon.decide.derivative import substitute
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision, whole_power
from canon.decide.growth import Tamed, tamed
from canon.decide.power_series import Unexpanded
from canon.decide.tape import Node, Tape, Unsupported

TERMS = 6
LOG_POWER = Fraction(1, 4)
LOG_BOUND = arb("1.4716")
"""s^(1/4)·|log s| ≤ 4/e < 1.4716 for 0 < s ≤ 1."""


@dataclass(frozen=True)
class Envelope:
    """All values of a node for 0 < s ≤ S: in s^`power`·`ball`."""

    power: Fraction
    ball: Ball


@dataclass(frozen=True)
class Tail:
    """A formula of x near infinity: what its integral from X on is.

    **Arguments:** `s`, the symbol that 1/x is; `main`, the formula in it.
    """

    tape: Tape
    s: Node
    main: Tamed

    def beyond(self, X: int, bits: int) -> Ball | None:
        """The integral from X to infinity as a ball; None where no bound is found."""
        with precision(bits):
            try:
                known = _envelopes(self.tape, self.s, [self.main.rest, self.main.exponent], arb(1) / X)
            except (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError):
                return None
            rest, exponent = known[self.main.rest], known[self.main.exponent]
            if self.main.exponent == self.tape.zero:
                return _by_power(rest, X)
            return _by_exponential(rest, exponent, X)


def tail_of(tape: Tape, node: Node, x: Node, s: Node, sign_of: SignOf) -> Tail:
    """A formula of x alone (and numbers) near infinity; `s` is a positive symbol of its own.

    **Raises:** `Unexpanded` where it has no such form.
    """
    if tape.is_complex(node):
        raise Unexpanded("complex values")
    target = substitute(tape, node, {x: tape.power(s, -1)})
    try:
        return Tail(tape, s, tamed(Expander(tape, s, sign_of, TERMS), target))
    except Ramified:
        return Tail(tape, s, Tamed(tape.zero, target))  # fractional powers: envelopes have them, exponents are left


def _by_power(rest: Envelope, X: int) -> Ball | None:
    p = rest.power
    if not p > 1 or not rest.ball.is_finite():
        return None
    return rest.ball * _power(arb(X), 1 - p) / _number(p - 1)


def _by_exponential(rest: Envelope, exponent: Envelope, X: int) -> Ball | None:
    """|∫| ≤ sup|I| g(X)/X with g(x) = x^(2 − p) exp(−c x^k), where g falls from X on: c k X^k ≥ 2 − p."""
    k, c = -exponent.power, -exponent.ball.upper()
    if not (k > 0 and c > 0) or not rest.ball.is_finite():
        return None
    place = arb(X)
    steep = c * _number(k) * _power(place, k)
    if not steep >= _number(2 - rest.power):
        return None
    size = rest.ball.abs_upper() * _power(place, 1 - rest.power) * (-c * _power(place, k)).exp()
    return (-size).union(size)


def _number(value: Fraction) -> Ball:
    return arb(value.numerator) / value.denominator


def _power(base: Ball, exponent: Fraction) -> Ball:
    return base ** _number(exponent)


def _up_to(edge: Ball) -> Ball:
    """The interval from 0 to a positive number."""
    return arb(0).union(edge)


def _envelopes(tape: Tape, s: Node, nodes: list[Node], S: Ball) -> Mapping[Node, Envelope]:
    known: dict[Node, Envelope] = {}
    for i in tape.reach(nodes):
        if i == s:
            known[i] = Envelope(Fraction(1), arb(1))
        elif s not in tape.support(i):
            known[i] = Envelope(Fraction(0), evaluate(tape, tape.reach([i]), {})[i])
        else:
            known[i] = _step(tape.ops[i], known, S)
    return known


def _step(op: tuple, known: Mapping[Node, Envelope], S: Ball) -> Envelope:
    if op[0] == "+":
        parts = [(known[a], _number(c)) for a, c in op[2]]
        return _sum([(Envelope(Fraction(0), _number(op[1])), arb(1))] * bool(op[1]) + parts, S)
    if op[0] == "*":
        power, ball = Fraction(0), arb(1)
        for a, e in op[1]:
            inner = known[a]
            if e < 0 and inner.ball.contains(0):
                raise OutOfDomain("a denominator that may be zero")
            factor = whole_power(inner.ball, abs(e))
            power, ball = power + e * inner.power, ball * (factor if e > 0 else 1 / factor)
        return Envelope(power, ball)
    if op[0] == "r":
        inner, e = known[op[1]], Fraction(op[2], op[3])
        if not inner.ball > 0:
            raise OutOfDomain("a radicand that may be negative or zero")
        return Envelope(inner.power * e, _power(inner.ball, e))
    if op[0] == "f" and len(op[2]) == 1:
        return _function(op[1], known[op[2][0]], S)
    raise Unsupported("no envelope")


def _sum(terms: list[tuple[Envelope, Ball]], S: Ball) -> Envelope:
    least = min(term.power for term, _ in terms)
    total = arb(0)
    for term, c in terms:
        above = term.power - least
        total += c * term.ball * (_up_to(_power(S, above)) if above else arb(1))
    return Envelope(least, total)


def _function(name: str, u: Envelope, S: Ball) -> Envelope:
    if name == "exp" and u.power < 0:
        if not u.ball < 0:
            raise OutOfDomain("an exponential that may grow")
        return Envelope(Fraction(0), _up_to((_power(S, u.power) * u.ball).exp().upper()))
    if name == "log":
        if not u.ball > 0:
            raise OutOfDomain("the logarithm of something that may be zero or negative")
        if u.power == 0:
            return Envelope(Fraction(0), u.ball.log())
        if not S <= 1:
            raise OutOfDomain("too near")
        size = arb(0).union(-LOG_BOUND) * _number(u.power)
        return _sum([(Envelope(-LOG_POWER, size), arb(1)), (Envelope(Fraction(0), u.ball.log()), arb(1))], S)
    if u.power < 0:
        if name in ("sin", "cos"):
            return Envelope(Fraction(0), arb(-1).union(arb(1)))
        if name == "abs":
            return Envelope(u.power, abs(u.ball))
        raise Unsupported(f"{name} of something that grows")
    whole = u.ball * (_up_to(_power(S, u.power)) if u.power else arb(1))
    if name == "abs":
        return Envelope(u.power, abs(u.ball))
    if name in ("exp", "sin", "cos", "atan"):
        value = getattr(whole, name)()
        if name in ("sin", "atan") and u.power > 0:  # |sin u| and |atan u| are at most |u|
            return Envelope(u.power, u.ball.union(-u.ball))
        return Envelope(Fraction(0), value)
    raise Unsupported(f"no envelope of {name}")
