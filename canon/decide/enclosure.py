"""Rigorous balls for every node of the tape at a point (Arb's arithmetic, through python-flint).

A value is a real ball where the node is real, a complex ball where it isn't. Evaluation stops with
OutOfDomain wherever a principal value isn't certified to exist: nothing is continued across a cut.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from flint import acb, arb

from canon.ball_precision import precision as precision
from canon.decide.arbitrary import ChosenFunction, rational
from canon.decide.jacobi import jacobi
from canon.decide.tape import Node, Tape, Unsupported

Ball = Any  # flint.arb or flint.acb; the package has no type stubs


class OutOfDomain(Exception):
    """The point isn't certified to lie where the expression is defined."""


def evaluate(
    tape: Tape,
    order: Sequence[Node],
    point: Mapping[Node, Ball],
    functions: Mapping[str, ChosenFunction] | None = None,
    values: dict[Node, Ball] | None = None,
) -> dict[Node, Ball]:
    """Balls for the nodes of `order` (an order of evaluation) at a point given by its symbol nodes.

    Raises OutOfDomain where the value isn't certified to exist, Unsupported where there is no enclosure.
    """
    ball: dict[Node, Ball] = {} if values is None else values
    ops = tape.ops
    for i in order:
        if i in ball:
            continue
        op = ops[i]
        kind = op[0]
        if kind == "*":
            value = _product(op[1], ball)
        elif kind == "+":
            value = _sum(op[1], op[2], ball)
        elif kind == "n":
            value = arb(rational(op[1]))
        elif kind == "s":
            value = point[i]
        elif kind == "r":
            value = _root(ball[op[1]], op[2], op[3])
        elif kind == "f":
            value = _function(op[1], [ball[a] for a in op[2]])
        elif kind == "c":
            value = arb.pi() if op[1] == "pi" else acb(0, 1)
        else:
            if not functions or op[1] not in functions:
                raise Unsupported(f"no value of the arbitrary function {op[1]}")
            value = functions[op[1]].derivative_at(op[2], [ball[a] for a in op[3]])
        if not value.is_finite():
            raise OutOfDomain("a value that is not finite")
        ball[i] = value
    return ball


def excludes_zero(ball: Ball) -> bool:
    """True when the number in the ball is certainly not 0."""
    return not ball.contains(0)


def certainly_positive(ball: Ball) -> bool:
    """True when the ball is real and certainly positive."""
    return isinstance(ball, arb) and bool(ball > 0)


def off_the_slit(ball: Ball) -> bool:
    """True when the number is certainly not in (−∞, 0]."""
    if isinstance(ball, arb):
        return bool(ball > 0)
    return bool(ball.real > 0) or not ball.imag.contains(0)


def _product(factors: Sequence[tuple[Node, int]], ball: Mapping[Node, Ball]) -> Ball:
    value = None
    for node, exponent in factors:
        factor = ball[node]
        if exponent < 0:
            if factor.contains(0):
                raise OutOfDomain("a denominator that may be zero")
            factor = 1 / (factor if exponent == -1 else whole_power(factor, -exponent))
        elif exponent > 1:
            factor = whole_power(factor, exponent)
        value = factor if value is None else value * factor
    return value


def whole_power(base: Ball, exponent: int) -> Ball:
    """base ** exponent for an exponent of at least 1; flint answers nan for a real ball whose midpoint is 0."""
    value = base**exponent
    if value.is_finite() or not base.is_finite():
        return value
    value = None
    while exponent:
        if exponent % 2:
            value = base if value is None else value * base
        exponent //= 2
        base = base * base if exponent else base
    return value


def _sum(constant: Any, terms: Sequence[tuple[Node, Any]], ball: Mapping[Node, Ball]) -> Ball:
    value = arb(rational(constant)) if constant else None
    for node, coefficient in terms:
        term, numerator, denominator = ball[node], coefficient.numerator, coefficient.denominator
        if numerator == -1:
            term = -term
        elif numerator != 1:
            term = term * numerator
        if denominator != 1:
            term = term / denominator
        value = term if value is None else value + term
    return value


def _root(base: Ball, numerator: int, denominator: int) -> Ball:
    if not off_the_slit(base):
        raise OutOfDomain("a radicand that may be negative or zero")
    if isinstance(base, arb):
        value = base.sqrt() if denominator == 2 else base.root(denominator)
    else:
        value = base.sqrt() if denominator == 2 else (base.log() / denominator).exp()
    return value**numerator if numerator >= 0 else 1 / value ** (-numerator)


def _function(name: str, arguments: list[Ball]) -> Ball:
    u = arguments[0]
    if name in ("exp", "sin", "cos"):
        return getattr(u, name)()
    if name == "log":
        if not off_the_slit(u):
            raise OutOfDomain("the logarithm of something that may be zero or negative")
        return u.log()
    if name == "abs":
        return _abs(u)
    if not all(isinstance(a, arb) for a in arguments):
        raise Unsupported(f"{name} of a complex argument")
    rule = REAL.get(name)
    if rule is None:
        raise Unsupported(f"no enclosure of {name}")
    return rule(*arguments)


def _abs(u: Ball) -> Ball:
    if u.contains(0):
        raise OutOfDomain("the argument of an absolute value may be zero")
    return abs(u)


def _within(name: str) -> Callable[[Ball], Ball]:
    def rule(u: Ball) -> Ball:
        if not abs(u) < 1:
            raise OutOfDomain(f"the argument of {name} may leave (-1, 1)")
        return getattr(u, name)()

    return rule


def _atan2(y: Ball, x: Ball) -> Ball:
    if not x > 0 and y.contains(0):
        raise OutOfDomain("atan2 on its cut")
    return arb.atan2(y, x)


def _integer_power(base: Ball, exponent: Ball) -> Ball:
    if not (exponent.is_exact() and exponent.is_integer()):
        raise OutOfDomain("an exponent that is not an exact integer")
    n = int(exponent.unique_fmpz())
    if abs(n) > 10_000:
        raise OutOfDomain("a large exponent")
    if n < 0 and base.contains(0):
        raise OutOfDomain("a denominator that may be zero")
    if n == 0:
        return base**0
    return whole_power(base, n) if n > 0 else 1 / whole_power(base, -n)


def _gamma(u: Ball) -> Ball:
    return u.gamma()


def _lambertw(u: Ball) -> Ball:
    if not u * arb(1).exp() > -1:
        raise OutOfDomain("lambertw needs an argument above -1/e")
    return u.lambertw()


def _complete(name: str) -> Callable[[Ball], Ball]:
    def rule(m: Ball) -> Ball:
        if not m < 1:
            raise OutOfDomain("a complete elliptic integral needs m < 1")
        return getattr(acb(m), name)().real

    return rule


def _incomplete(name: str) -> Callable[[Ball, Ball], Ball]:
    def rule(phi: Ball, m: Ball) -> Ball:
        if not m * phi.sin() ** 2 < 1 or not (m < 1 or abs(phi) < arb.pi() / 2):
            raise OutOfDomain("an incomplete elliptic integral needs m sin(phi)^2 < 1 along its path")
        return getattr(acb, name)(acb(phi), acb(m)).real

    return rule


def _third_kind(n: Ball, m: Ball) -> Ball:
    if not (n < 1 and m < 1):
        raise OutOfDomain("a complete elliptic integral of the third kind needs n < 1 and m < 1")
    return acb.elliptic_pi(acb(n), acb(m)).real


def _third_kind_incomplete(n: Ball, phi: Ball, m: Ball) -> Ball:
    square, short = phi.sin() ** 2, abs(phi) < arb.pi() / 2
    if not all(x * square < 1 and (x < 1 or short) for x in (n, m)):
        raise OutOfDomain("an incomplete elliptic integral needs n sin(phi)^2 < 1 and m sin(phi)^2 < 1 along its path")
    return acb.elliptic_pi_inc(acb(n), acb(phi), acb(m)).real


def _jacobi(which: str) -> Callable[[Ball, Ball], Ball]:
    inner = jacobi(which)

    def rule(u: Ball, m: Ball) -> Ball:
        value = inner(u, m)
        if value is None:
            raise OutOfDomain("a parameter of Jacobi's functions not told from 0 or 1")
        return value

    return rule


REAL: dict[str, Callable[..., Ball]] = {
    "abs": _abs, "atan": lambda u: u.atan(), "asin": _within("asin"), "acos": _within("acos"), "atan2": _atan2,
    "gamma": _gamma, "integer_power": _integer_power, "lambertw": _lambertw, "elliptic_k": _complete("elliptic_k"),
    "elliptic_e": _complete("elliptic_e"),
    "elliptic_f": _incomplete("elliptic_f"), "elliptic_ei": _incomplete("elliptic_e_inc"),
    "elliptic_pi": _third_kind, "elliptic_pii": _third_kind_incomplete,
    "jacobi_sn": _jacobi("sn"), "jacobi_cn": _jacobi("cn"), "jacobi_dn": _jacobi("dn"),
    "jacobi_epsilon": _jacobi("epsilon"), "jacobi_dn over": lambda u, m, under: under * _jacobi("dn")(u, m),
}  # fmt: skip
