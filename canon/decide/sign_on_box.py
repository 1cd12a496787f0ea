"""The sign that a node has on a whole box of intervals, where it has one."""

from __future__ import annotations

from collections.abc import Mapping

from canon.budget import Budget
from canon.decide.intervals import Interval, declared, exact_affine
from canon.decide.ring import TooCostly
from canon.decide.signs import classify, sign_of
from canon.decide.tape import Node, Tape, Unsupported
from canon.decide.tower import Tower, combine


def definite_sign(tape: Tape, node: Node, intervals: Mapping[Node, Interval], budget: Budget) -> str | None:
    """ "pos" or "neg" where the node has that sign on the whole box, else None."""
    form = exact_affine(tape, node)
    if form is not None:
        constant, slope, symbol = form
        interval = intervals.get(symbol, declared(tape, symbol)).affine(slope, constant)
        return interval.sign()
    try:
        tower = Tower(tape, [node], intervals=intervals, budget=budget)
        value = tower.values.get(node)
        if value is None:
            field, kernels = tower.field, tower.values
            values = dict(kernels)
            for i in tape.reach([node]):
                if i not in values:
                    values[i] = combine(field, tape.ops[i], values)
            value = values[node]
        if tower.is_complex(value) or not value[0]:
            return None
        sign, _, known, unknown = classify(tower, value)
        strict = all(sign_of(tower, f) in ("pos", "neg") for f, _ in known)
    except (Unsupported, TooCostly, ZeroDivisionError):
        return None
    if unknown or not strict:
        return None
    return "pos" if sign > 0 else "neg"
