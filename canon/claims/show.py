"""Formulas for people: no verdict rests on what happens here."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.simplify.fu import TR5, TR6

from canon.decide.tape import Node, Tape

SHORT = 40
LONG = "a long formula"


def neat(expression: sp.Expr) -> sp.Expr:
    """A shorter form of a small expression; a large one is left as it is."""
    if sp.count_ops(expression) > SHORT or expression.has(sp.Derivative, sp.Subs):
        return expression
    forms: list[Any] = [expression]
    try:
        forms.append(sp.factor_terms(sp.cancel(expression)))
        if expression.has(sp.sin, sp.cos):
            forms += [sp.expand(TR5(sp.expand(forms[-1]))), sp.expand(TR6(sp.expand(forms[-1])))]
            forms.append(sp.factor_terms(min(forms, key=sp.count_ops)))
        if forms[-1].is_polynomial(*forms[-1].free_symbols):
            forms.append(sp.factor(forms[-1]))
    except (sp.PolynomialError, NotImplementedError, TypeError, AttributeError):
        pass
    return min(forms, key=sp.count_ops)


def _powers(expression: sp.Expr) -> Any:
    """exp(a log b) as b**a."""

    def power(call: Any) -> Any:
        logs = [f for f in sp.Mul.make_args(call.args[0]) if isinstance(f, sp.log)]
        return logs[0].args[0] ** (call.args[0] / logs[0]) if len(logs) == 1 else call

    return expression.replace(lambda e: isinstance(e, sp.exp), power)


def shown(tape: Tape, node: Node) -> str:
    """A node as text."""
    value = tape.value(node)
    if value is not None:
        return str(value)
    if len(tape.reach([node])) > 2 * SHORT:
        return LONG
    text = str(neat(_powers(tape.to_sympy(node))))
    return text if len(text) <= 200 else LONG
