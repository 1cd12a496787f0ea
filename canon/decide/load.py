"""Sympy expressions onto the tape and back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.decide.derivative import derivative, substitute
from canon.decide.tape import ONE, Node, Tape, Unsupported

HALF = Fraction(1, 2)
DIRECT = {
    sp.sin: "sin", sp.cos: "cos", sp.exp: "exp", sp.asin: "asin", sp.acos: "acos", sp.atan: "atan", sp.atan2: "atan2",
    sp.gamma: "gamma", sp.elliptic_k: "elliptic_k", sp.elliptic_f: "elliptic_f",
}  # fmt: skip


def load(tape: Tape, expression: sp.Basic | int) -> Node:
    """The node of a sympy expression, each subexpression imported once.

    Raises Unsupported for what the tape has no operation for (floats, noncommuting symbols,
    Piecewise, …).
    """
    root = expression if isinstance(expression, sp.Basic) else sp.Integer(expression)
    memo = tape.loaded
    stack: list[sp.Basic] = [root]
    while stack:
        item = stack[-1]
        if item in memo:
            stack.pop()
            continue
        if isinstance(item, (sp.Derivative, sp.Subs)):
            memo[stack.pop()] = _import(tape, item, ())
            continue
        try:
            arguments = [memo[argument] for argument in item.args]
        except KeyError:
            stack.extend(argument for argument in item.args if argument not in memo)
            continue
        memo[stack.pop()] = _import(tape, item, arguments)
    return memo[root]


def _import(tape: Tape, item: sp.Basic, arguments: Sequence[Node]) -> Node:
    """The node of the item, whose arguments are on the tape already."""
    if isinstance(item, sp.Add):
        return tape.add([(a, ONE) for a in arguments])
    if isinstance(item, sp.Mul):
        return tape.mul([(a, 1) for a in arguments])
    if isinstance(item, sp.Pow):
        return _import_power(tape, item, arguments)
    if isinstance(item, sp.Rational):
        return tape.number(Fraction(int(item.p), int(item.q)))
    if isinstance(item, sp.Symbol):
        if not item.is_commutative:
            raise Unsupported(f"{item} does not commute")
        return tape.symbol(item)
    if item is sp.pi:
        return tape.constant("pi")
    if item is sp.I:
        return tape.constant("I")
    if item is sp.E:
        return tape.call("exp", tape.one)
    if isinstance(item, sp.Derivative):
        return _import_derivative(tape, item)
    if isinstance(item, sp.Subs):
        inner = load(tape, item.expr)
        variables: Any = item.variables
        points: Any = item.point
        pairs = zip(variables, points, strict=True)
        return substitute(tape, inner, {tape.symbol(s): load(tape, v) for s, v in pairs})
    if isinstance(item, AppliedUndef):
        if item.func.is_real is False or any(
            (item.is_positive, item.is_negative, item.is_nonnegative, item.is_integer)
        ):
            raise Unsupported(f"an arbitrary function with assumptions: {item.func}")
        return tape.arbitrary(item.func.__name__, (0,) * len(arguments), tuple(arguments))
    name = DIRECT.get(item.func)
    if name in COMPLEX and tape.is_complex(arguments[0]):
        return COMPLEX[name](tape, arguments[0])
    if name is not None:
        return tape.call(name, *arguments)
    rule = RULES.get(item.func.__name__)
    if rule is None:
        raise Unsupported(f"no exact argument about {item.func.__name__}")
    return rule(tape, *arguments)


def _import_power(tape: Tape, item: sp.Pow, arguments: Sequence[Node]) -> Node:
    base: Any = item.base
    exponent: Any = item.exp
    if isinstance(exponent, sp.Integer):
        return tape.power(arguments[0], int(exponent))
    if isinstance(exponent, sp.Rational):
        return tape.root(arguments[0], Fraction(int(exponent.p), int(exponent.q)))
    if base is sp.E:
        return tape.call("exp", arguments[1])
    if exponent.is_integer and not base.is_positive:
        return _integer_power(tape, base, exponent)
    return tape.call("exp", tape.times(arguments[1], tape.call("log", arguments[0])))


def _integer_power(tape: Tape, base: sp.Expr, exponent: sp.Expr) -> Node:
    """base ** exponent for a symbolic integer exponent and a base of any sign, one factor for each term of it.

    A negative number has (−b)**n = b**n·cos(πn); any other base stands in a kernel of its own.
    """
    total = tape.one
    for term in sp.Add.make_args(exponent):
        count, rest = term.as_coeff_Mul()
        if not isinstance(count, sp.Integer):
            count, rest = sp.Integer(1), term
        if rest is sp.S.One:
            factor = load(tape, base)
        elif isinstance(base, sp.Rational):
            turn = tape.call("cos", tape.times(tape.constant("pi"), load(tape, rest)))
            size = tape.call("exp", tape.times(load(tape, rest), tape.call("log", load(tape, -base))))
            factor = tape.times(turn, size)
        else:
            factor = tape.call("integer_power", load(tape, base), load(tape, rest))
        total = tape.times(total, tape.power(factor, int(count)))
    return total


def _by_argument(tape: Tape, node: Node, call: AppliedUndef, argument: AppliedUndef, count: Any) -> Node:
    """V'(u(x)), which sympy writes as a derivative of V(u(x)) by u(x): by the one argument that is u(x)."""
    places = [k for k, given in enumerate(call.args) if given.has(argument)]
    if len(places) != 1 or call.args[places[0]] != argument or not isinstance(count, sp.Integer):
        raise Unsupported(f"a derivative with respect to {argument}")
    _, name, orders, arguments = tape.ops[node]
    return tape.arbitrary(name, tuple(n + int(count) * (k == places[0]) for k, n in enumerate(orders)), arguments)


def _import_derivative(tape: Tape, item: sp.Derivative) -> Node:
    node = load(tape, item.expr)
    counts: Any = item.variable_count
    if len(counts) == 1 and isinstance(item.expr, AppliedUndef) and isinstance(counts[0][0], AppliedUndef):
        return _by_argument(tape, node, item.expr, *counts[0])
    for variable, count in counts:
        if not isinstance(variable, sp.Symbol) or not isinstance(count, sp.Integer):
            raise Unsupported(f"a derivative with respect to {variable}, {count} times")
        for _ in range(int(count)):
            node = derivative(tape, node, tape.symbol(variable))
    return node


# -- functions that are defined through others -------------------------------------------------


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
    "JacobiEpsilon": _jacobi("jacobi_epsilon"),
    "conjugate": lambda tape, u: u if not tape.is_complex(u) else conjugate(tape, u),
    "re": lambda tape, u: tape.scaled(tape.plus(u, conjugate(tape, u)), HALF),
}  # fmt: skip


# -- back, for people ---------------------------------------------------------------------------

NAMES: dict[str, Callable[..., sp.Expr]] = {
    "sin": sp.sin, "cos": sp.cos, "exp": sp.exp, "log": sp.log, "atan": sp.atan, "asin": sp.asin, "acos": sp.acos,
    "atan2": sp.atan2, "abs": sp.Abs, "gamma": sp.gamma, "lambertw": sp.LambertW, "elliptic_k": sp.elliptic_k,
    "elliptic_e": sp.elliptic_e, "integer_power": sp.Pow, "elliptic_ei": sp.elliptic_e, "elliptic_f": sp.elliptic_f,
}  # fmt: skip


def unload(tape: Tape, node: Node) -> sp.Expr:
    """The node as a sympy expression (for showing; no verdict rests on it)."""
    values: dict[Node, sp.Expr] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        kind = op[0]
        if kind == "n":
            values[i] = sp.Rational(op[1].numerator, op[1].denominator)
        elif kind == "s":
            values[i] = tape.symbols[op[1]]
        elif kind == "c":
            values[i] = sp.pi if op[1] == "pi" else sp.I
        elif kind == "+":
            terms = [sp.Rational(c.numerator, c.denominator) * values[j] for j, c in op[2]]
            values[i] = sp.Add(sp.Rational(op[1].numerator, op[1].denominator), *terms)
        elif kind == "*":
            values[i] = sp.Mul(*(values[j] ** e for j, e in op[1]))
        elif kind == "r":
            values[i] = values[op[1]] ** sp.Rational(op[2], op[3])
        elif kind == "f":
            maker = NAMES.get(op[1]) or sp.Function(op[1])
            values[i] = maker(*(values[j] for j in op[2]))
        else:
            values[i] = _unload_arbitrary(op[1], op[2], [values[j] for j in op[3]])
    return values[node]


def _unload_arbitrary(name: str, orders: tuple[int, ...], arguments: list[sp.Expr]) -> sp.Expr:
    function = sp.Function(name)
    if not any(orders):
        return function(*arguments)
    dummies = [a if isinstance(a, sp.Symbol) else sp.Dummy(f"a{k + 1}") for k, a in enumerate(arguments)]
    if len(set(dummies)) < len(dummies):
        dummies = [sp.Dummy(f"a{k + 1}") for k in range(len(arguments))]
    inner = sp.Derivative(function(*dummies), *((d, k) for d, k in zip(dummies, orders, strict=True) if k))
    moved = [(d, a) for d, a in zip(dummies, arguments, strict=True) if d is not a]
    return sp.Subs(inner, [d for d, _ in moved], [a for _, a in moved]) if moved else inner
