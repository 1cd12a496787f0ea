"""The Euler–Lagrange equations of a functional of functions of several variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.outcome import Outcome, Residual
from canon.claims.show import with_value
from canon.decide.derivative import derivative, rebuild, substitute
from canon.decide.tape import Node, Tape
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question


def field_equations(question: Question) -> Outcome:
    """`field_equations`: Σ (−1)^|α| D^α ∂L/∂(D^α u) are `equations`, one for each of the functions `fields`.

    L holds the fields and their derivatives of any order, all at the fields' own arguments (Goldstein, eq. 13.23;
    Courant & Hilbert I, ch. IV, §3).
    """
    fields: tuple[sp.Expr, ...] = question.key("fields")
    L = question.formula("L", side="both")
    equations = question.formulas("equations", len(fields), side="both")
    tape, node = question.tape, question.load(L)
    region = question.region(L, *equations)

    def residuals() -> Iterator[Residual]:
        for call, equation in zip(fields, equations, strict=True):
            left = _variation(tape, node, call)
            difference = tape.minus(left, question.load(equation))
            yield Residual(f"equation of {call}", question.chart.pull(difference), question.chart.pull(left))

    return with_value(question, question.decide(residuals(), region))


def _variation(tape: Tape, L: Node, call: sp.Expr) -> Node:
    """The variational derivative of L by the function."""
    name, arguments = call.func.__name__, tuple(tape.symbol(x) for x in call.args)  # pyright: ignore[reportArgumentType]
    jets: dict[Node, Node] = {}
    for i in tape.reach([L]):
        op = tape.ops[i]
        if op[0] == "u" and op[1] == name:
            if op[3] != arguments:
                raise InputError(f"{name!r} occurs at other arguments than those of {call}", "key 'L'")
            jets[i] = tape.symbol(sp.Dummy(f"{name}{''.join(map(str, op[2]))}", real=True))
    if not jets:
        raise InputError(f"L has nothing of {call} in it", "key 'fields'")
    free = _replaced(tape, L, jets)
    back = {symbol: jet for jet, symbol in jets.items()}
    terms = []
    for jet, symbol in jets.items():
        slope = substitute(tape, derivative(tape, free, symbol), back)
        orders = tape.ops[jet][2]
        for x, order in zip(arguments, orders, strict=True):
            for _ in range(order):
                slope = derivative(tape, slope, x)
        terms.append(tape.scaled(slope, (-1) ** sum(orders)))
    return tape.plus(*terms)


def _replaced(tape: Tape, node: Node, images: Mapping[Node, Node]) -> Node:
    """The node with these nodes, of any kind, replaced."""
    values: dict[Node, Node] = {}
    for i in tape.reach([node]):
        values[i] = images[i] if i in images else rebuild(tape, i, values)
    return values[node]


KINDS = {"field_equations": field_equations}
