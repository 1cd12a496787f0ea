"""Functions that the tape has no operation for, by those that it has: hyperbolic ones, quotients, moduli."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from canon.decide.derivative import substitute
from canon.decide.tape import ONE, Node, Tape, Unsupported

HALF = Fraction(1, 2)


def conjugate(tape: Tape, node: Node) -> Node:
    """The complex conjugate, for nodes of real symbols: I becomes −I.

    Every function of the tape is real on the real axis, so it commutes with conjugation off its cuts.
    """
    if any(not symbol.is_real for symbol in tape.symbols_of(node)):
        raise Unsupported("the modulus of an expression in complex symbols")
    unit = tape.constant("I")
    return substitute(tape, node, {unit: tape.negative(unit)})


def _abs(tape: Tape, u: Node) -> Node:
    if not tape.is_complex(u):
        return tape.call("abs", u)
    if not all(symbol.is_real for symbol in tape.symbols_of(u)):
        return tape.call("abs", u)
    return tape.sqrt(tape.times(u, conjugate(tape, u)))


def _sign(tape: Tape, u: Node) -> Node:
    if tape.is_complex(u):
        raise Unsupported("the sign of a complex expression")
    return tape.mul(((tape.call("abs", u), 1), (u, -1)))


def _log(tape: Tape, u: Node, base: Node | None = None) -> Node:
    if base is None:
        return tape.call("log", u)
    return tape.mul(((tape.call("log", u), 1), (tape.call("log", base), -1)))


def _ratio(over: str, under: str) -> Callable[[Tape, Node], Node]:
    def rule(tape: Tape, u: Node) -> Node:
        return tape.mul(((tape.call(over, u), 1), (tape.call(under, u), -1)))

    return rule


def _inverse_of(name: str) -> Callable[[Tape, Node], Node]:
    return lambda tape, u: tape.power(tape.call(name, u), -1)


def _sinh(tape: Tape, u: Node) -> Node:
    e = tape.call("exp", u)
    return tape.add(((e, HALF), (tape.power(e, -1), -HALF)))


def _cosh(tape: Tape, u: Node) -> Node:
    e = tape.call("exp", u)
    return tape.add(((e, HALF), (tape.power(e, -1), HALF)))


def _asinh(tape: Tape, u: Node) -> Node:
    return tape.call("log", tape.plus(u, tape.sqrt(tape.plus(tape.power(u, 2), tape.one))))


def _acosh(tape: Tape, u: Node) -> Node:
    below, above = tape.add(((u, ONE),), -1), tape.add(((u, ONE),), 1)
    if tape.is_complex(u):
        return tape.call("log", tape.plus(u, tape.times(tape.sqrt(below), tape.sqrt(above))))
    return tape.call("log", tape.plus(u, tape.sqrt(tape.times(below, above))))


def _atanh(tape: Tape, u: Node) -> Node:
    over, under = tape.add(((u, ONE),), 1), tape.add(((u, -ONE),), 1)
    return tape.add(((tape.call("log", over), HALF), (tape.call("log", under), -HALF)))


def _complex_asin(tape: Tape, u: Node) -> Node:
    """−i log(iu + √(1 − u²)), principal value (DLMF 4.23.19)."""
    unit = tape.constant("I")
    root = tape.sqrt(tape.add(((tape.power(u, 2), -ONE),), 1))
    return tape.negative(tape.times(unit, tape.call("log", tape.plus(tape.times(unit, u), root))))


def _complex_acos(tape: Tape, u: Node) -> Node:
    return tape.add(((tape.constant("pi"), HALF), (_complex_asin(tape, u), -ONE)))


def _complex_atan(tape: Tape, u: Node) -> Node:
    """(i/2)·[log(1 − iu) − log(1 + iu)], principal value (DLMF 4.23.26)."""
    unit = tape.constant("I")
    turned = tape.times(unit, u)
    above, below = (tape.call("log", tape.add(((turned, sign),), 1)) for sign in (-ONE, ONE))
    return tape.scaled(tape.times(unit, tape.minus(above, below)), HALF)


COMPLEX: dict[str, Callable[[Tape, Node], Node]] = {
    "asin": _complex_asin, "acos": _complex_acos, "atan": _complex_atan,
}  # fmt: skip


def _elliptic_e(tape: Tape, *arguments: Node) -> Node:
    return tape.call("elliptic_e" if len(arguments) == 1 else "elliptic_ei", *arguments)


def _elliptic_pi(tape: Tape, n: Node, *rest: Node) -> Node:
    """Π(n, m) or Π(n, φ, m); of the first and second kind where it is written that n = 0 or n = m
    (DLMF 19.6.2, 19.6.13).."""
    m = rest[-1]
    complete = len(rest) == 1
    if n == tape.zero:
        return tape.call("elliptic_k" if complete else "elliptic_f", *rest)
    if complete and m == tape.zero:
        root = tape.root(tape.add(((n, -ONE),), 1), -HALF)
        return tape.scaled(tape.times(tape.constant("pi"), root), HALF)
    if n != m:
        return tape.call("elliptic_pi" if complete else "elliptic_pii", n, *rest)
    second, last = _elliptic_e(tape, *rest), tape.power(tape.add(((m, -ONE),), 1), -1)
    if not complete:
        sine, cosine = (tape.call(name, rest[0]) for name in ("sin", "cos"))
        root = tape.sqrt(tape.add(((tape.times(m, tape.power(sine, 2)), -ONE),), 1))
        second = tape.minus(second, tape.mul(((m, 1), (sine, 1), (cosine, 1), (root, -1))))
    return tape.times(second, last)


def _special(name: str) -> Callable[..., Node]:
    return lambda tape, *arguments: tape.call(name, *arguments)


def _jacobi(name: str) -> Callable[[Tape, Node, Node], Node]:
    """A function of Jacobi's, elementary where its parameter is written as 0 or 1 (DLMF 22.5(ii))."""

    def rule(tape: Tape, u: Node, m: Node) -> Node:
        if m == tape.zero:
            if name in ("jacobi_sn", "jacobi_cn"):
                return tape.call("sin" if name == "jacobi_sn" else "cos", u)
            return tape.one if name == "jacobi_dn" else u
        if m == tape.one:
            inverse = tape.power(_cosh(tape, u), -1)
            return tape.times(_sinh(tape, u), inverse) if name in ("jacobi_sn", "jacobi_epsilon") else inverse
        return tape.call(name, u, m)

    return rule


RULES: dict[str, Callable[..., Node]] = {
    "Abs": _abs, "sign": _sign, "log": _log, "tan": _ratio("sin", "cos"), "cot": _ratio("cos", "sin"),
    "sec": _inverse_of("cos"), "csc": _inverse_of("sin"), "sinh": _sinh, "cosh": _cosh,
    "tanh": lambda tape, u: tape.mul(((_sinh(tape, u), 1), (_cosh(tape, u), -1))),
    "coth": lambda tape, u: tape.mul(((_cosh(tape, u), 1), (_sinh(tape, u), -1))),
    "sech": lambda tape, u: tape.power(_cosh(tape, u), -1), "csch": lambda tape, u: tape.power(_sinh(tape, u), -1),
    "asinh": _asinh, "acosh": _acosh, "atanh": _atanh, "elliptic_e": _elliptic_e, "LambertW": _special("lambertw"),
    "JacobiSN": _jacobi("jacobi_sn"), "JacobiCN": _jacobi("jacobi_cn"), "JacobiDN": _jacobi("jacobi_dn"),
    "JacobiEpsilon": _jacobi("jacobi_epsilon"), "EllipticPi": _elliptic_pi,
    "conjugate": lambda tape, u: u if not tape.is_complex(u) else conjugate(tape, u),
    "re": lambda tape, u: tape.scaled(tape.plus(u, conjugate(tape, u)), HALF),
}  # fmt: skip
