"""The tape back to sympy, for people: no verdict rests on it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from canon.calls import derivative_of, function
from canon.decide.tape import Node, Tape
from canon.special import EllipticPi

NAMES: dict[str, Callable[..., Any]] = {
    "sin": sp.sin, "cos": sp.cos, "exp": sp.exp, "log": sp.log, "atan": sp.atan, "asin": sp.asin, "acos": sp.acos,
    "atan2": sp.atan2, "abs": sp.Abs, "gamma": sp.gamma, "lambertw": sp.LambertW, "elliptic_k": sp.elliptic_k,
    "elliptic_e": sp.elliptic_e, "integer_power": sp.Pow, "elliptic_ei": sp.elliptic_e, "elliptic_f": sp.elliptic_f,
    "elliptic_pi": EllipticPi, "elliptic_pii": EllipticPi,
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
            maker = NAMES.get(op[1]) or function(op[1])
            values[i] = maker(*(values[j] for j in op[2]))
        else:
            values[i] = _unload_arbitrary(op[1], op[2], [values[j] for j in op[3]])
    return values[node]


def _unload_arbitrary(name: str, orders: tuple[int, ...], arguments: list[sp.Expr]) -> sp.Expr:
    return derivative_of(function(name), orders, arguments)
