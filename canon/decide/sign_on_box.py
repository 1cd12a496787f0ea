"""The sign that a node has on a whole box of intervals, where it has one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

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
    found = _classified(tape, node, intervals, budget)
    if found is None:
        return None
    sign, known, unknown = found
    if unknown or not all(strict for strict, _ in known):
        return None
    return "pos" if sign > 0 else "neg"


def is_zero_free(
    tape: Tape, node: Node, intervals: Mapping[Node, Interval], budget: Budget, *, positive: Sequence[Node] = ()
) -> bool:
    """Whether the node vanishes nowhere on the box where these are positive: only factors of known sign are above.

    What is below may have zeros on the box: the node isn't defined there.
    """
    if exact_affine(tape, node) is not None:
        return definite_sign(tape, node, intervals, budget) is not None
    found = _classified(tape, node, intervals, budget, positive)
    return found is not None and all(strict or e < 0 for strict, e in found[1]) and all(e < 0 for e in found[2])


def _classified(
    tape: Tape, node: Node, intervals: Mapping[Node, Interval], budget: Budget, positive: Sequence[Node] = ()
) -> tuple[int, list[tuple[bool, int]], list[int]] | None:
    """The sign of the known factors; for each, whether it has no zero, and its exponent; the others' exponents."""
    try:
        tower = Tower(tape, [node], positive=positive, intervals=intervals, budget=budget)
        value = tower.values.get(node)
        if value is None:
            values = dict(tower.values)
            for i in tape.reach([node]):
                if i not in values:
                    values[i] = combine(tower.field, tape.ops[i], values)
            value = values[node]
        if tower.is_complex(value) or not value[0]:
            return None
        sign, _, known, unknown = classify(tower, value)
        strict = [(sign_of(tower, f) in ("pos", "neg"), e) for f, e in known]
    except (Unsupported, TooCostly, ZeroDivisionError):
        return None
    return sign, strict, [e for _, e in unknown]
