"""Connectedness of a part of a box that conditions cut out, by moving along one coordinate after the other.

Where every condition c > 0 grows as y moves towards a finite end of its interval, the points over each x are an
interval that reaches that end, or none: for continuous c there are some just where c > 0 holds at the end itself. The
part is then connected if its projection, cut out by the conditions at the end, is. Monotone conditions on one
coordinate cut out an interval.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from canon.budget import Budget
from canon.decide.derivative import derivative, substitute
from canon.decide.intervals import Edge, Interval
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Node, Tape
from canon.errors import InputError


def is_connected(tape: Tape, conditions: Sequence[Node], box: Mapping[Node, Interval], budget: Budget) -> bool:
    """True where {c > 0 for all conditions} is shown to be a connected (or empty) part of the box."""
    left = [c for c in conditions if definite_sign(tape, c, box, budget) != "pos"]
    if not left:
        return True
    names = sorted(set().union(*(tape.support(c) for c in left)))
    if len(names) == 1 and names[0] in box:
        slopes = [definite_sign(tape, derivative(tape, c, names[0]), box, budget) for c in left]
        if None not in slopes and all(_is_polynomial_in(tape, c, names[0]) for c in left):
            return True
    for y in names:
        if y not in box:
            continue
        for edge, wanted in ((box[y].low, "neg"), (box[y].high, "pos")):
            if edge is None or not all(_grows(tape, c, y, wanted, box, budget) for c in left):
                continue
            try:
                projected = [substitute(tape, c, {y: _number(tape, edge)}) for c in left]
            except (InputError, ZeroDivisionError):
                continue
            if is_connected(tape, projected, {x: i for x, i in box.items() if x != y}, budget):
                return True
    return False


def _grows(tape: Tape, c: Node, y: Node, wanted: str, box: Mapping[Node, Interval], budget: Budget) -> bool:
    """c is free of y, or a polynomial in it whose derivative has the wanted sign on the whole box."""
    if y not in tape.support(c):
        return True
    return _is_polynomial_in(tape, c, y) and definite_sign(tape, derivative(tape, c, y), box, budget) == wanted


def _is_polynomial_in(tape: Tape, c: Node, y: Node) -> bool:
    for i in tape.reach([c]):
        if i == y or y not in tape.support(i):
            continue
        op = tape.ops[i]
        if op[0] != "+" and not (op[0] == "*" and all(e > 0 or y not in tape.support(a) for a, e in op[1])):
            return False
    return True


def _number(tape: Tape, edge: Edge) -> Node:
    return tape.add(((tape.constant("pi"), edge.pi),), Fraction(edge.rational))
