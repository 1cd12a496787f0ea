"""Formulas for people: no verdict rests on what happens here."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.simplify.fu import TR5, TR6

from canon.decide.tape import Node, Tape

if TYPE_CHECKING:
    from canon.claims.outcome import Outcome
    from canon.claims.question import Question

SHORT = 40
STEEP = 40
LONG = "a long formula"
FAILURES = (ArithmeticError, AttributeError, LookupError, RuntimeError, TypeError, ValueError, sp.PolynomialError)
"""What sympy raises where it can't help; nothing rests on its help here."""


def neat(expression: sp.Expr) -> sp.Expr:
    """A shorter form of a small expression; a large one is left as it is."""
    if sp.count_ops(expression) > SHORT or expression.has(sp.Derivative, sp.Subs) or is_steep(expression):
        return expression
    forms: list[Any] = [expression]
    try:
        forms.append(sp.factor_terms(sp.cancel(expression)))
        if expression.has(sp.sin, sp.cos):
            forms += [sp.expand(TR5(sp.expand(forms[-1]))), sp.expand(TR6(sp.expand(forms[-1])))]
            forms.append(sp.factor_terms(min(forms, key=sp.count_ops)))
        if forms[-1].is_polynomial(*forms[-1].free_symbols):
            forms.append(sp.factor(forms[-1]))
    except FAILURES:
        pass
    return min(forms, key=sp.count_ops)


def is_steep(expression: sp.Expr) -> bool:
    """True where an exponent has a long number in it: as a polynomial, the expression would have that degree."""
    exponents = [power.exp for power in expression.atoms(sp.Pow)] + [e.args[0] for e in expression.atoms(sp.exp)]
    return any(abs(r.p) > STEEP or r.q > STEEP for e in exponents for r in e.atoms(sp.Rational))


def _powers(expression: sp.Expr) -> Any:
    """exp(a log b) as b**a."""

    def power(call: Any) -> Any:
        logs = [f for f in sp.Mul.make_args(call.args[0]) if isinstance(f, sp.log)]
        return logs[0].args[0] ** (call.args[0] / logs[0]) if len(logs) == 1 else call

    return expression.replace(lambda e: isinstance(e, sp.exp), power)


def is_short(tape: Tape, node: Node, limit: int = 4 * SHORT) -> bool:
    """True where the node written out as a formula, shared parts repeated, has no more than so many operations."""
    sizes: dict[Node, int] = {}
    for i in tape.reach([node]):
        sizes[i] = 1 + sum(sizes[a] for a in tape.arguments(i))
        if sizes[i] > limit:
            return False
    return True


def shown(tape: Tape, node: Node, *, shorten: bool = True) -> str:
    """A node as text, `shorten`ed where that is cheap."""
    value = tape.value(node)
    if value is not None:
        return _text(value)
    if not is_short(tape, node):
        return LONG
    expression = tape.to_sympy(node)
    try:
        text = str(neat(_powers(expression)) if shorten else expression)
    except FAILURES:
        text = _text(expression)
    return text if len(text) <= 200 else LONG


def _text(value: object) -> str:
    """Its text, unless a number in it has more digits than Python writes (`sys.get_int_max_str_digits`)."""
    try:
        return str(value)
    except ValueError:
        return LONG


def with_value(question: Question, outcome: Outcome) -> Outcome:
    """A refutation with the value that the quantity really has."""
    failed = outcome.failed
    if failed is None or failed.residual.actual is None:
        return outcome
    return outcome.with_detail(value=question.show(failed.residual.actual))
