"""Sympy expressions onto the tape."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.decide.defined_functions import COMPLEX, RULES
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
