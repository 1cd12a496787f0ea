"""The sign that a node has on a whole box of intervals, where it has one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from canon.budget import Budget
from canon.decide.intervals import Interval, declared, exact_affine
from canon.decide.ring import TooCostly
from canon.decide.signs import classify, sign_of
from canon.decide.tape import Node, Tape, Unsupported
from canon.decide.tower import Tower, combine

OTHER = {"pos": "neg", "neg": "pos"}


def definite_sign(tape: Tape, node: Node, intervals: Mapping[Node, Interval], budget: Budget) -> str | None:
    """ "pos" or "neg" where the node has that sign on the whole box, else None."""
    image = _image(tape, node, intervals)
    if image is not None:
        return image.sign()
    seen = _of_waves(tape, node, intervals)
    if seen is not None:
        return seen
    found = _classified(tape, node, intervals, budget)
    if found is None:
        return None
    sign, known, unknown = found
    if unknown or not all(strict for strict, _ in known):
        return None
    return "pos" if sign > 0 else "neg"


def _image(tape: Tape, node: Node, intervals: Mapping[Node, Interval]) -> Interval | None:
    """The values of a node that is affine in one symbol."""
    form = exact_affine(tape, node)
    if form is None:
        return None
    constant, slope, symbol = form
    return intervals.get(symbol, declared(tape, symbol)).affine(slope, constant)


def _of_waves(tape: Tape, node: Node, intervals: Mapping[Node, Interval]) -> str | None:
    """The sign of a product of sines, cosines and affine factors, where each has one."""
    op = tape.ops[node]
    if op[0] == "+" and not op[1] and len(op[2]) == 1:
        ((inner, factor),) = op[2]
        sign = _of_waves(tape, inner, intervals)
        return sign if sign is None or factor > 0 else OTHER[sign]
    if op[0] == "*":
        signs = [_of_waves(tape, inner, intervals) for inner, _ in op[1]]
        if None in signs:
            return None
        odd = sum(sign == "neg" and e % 2 for sign, (_, e) in zip(signs, op[1], strict=True))
        return "neg" if odd % 2 else "pos"
    if op[:2] in (("f", "sin"), ("f", "cos")):
        image = _image(tape, op[2][0], intervals)
        return None if image is None else image.sine_sign() if op[1] == "sin" else image.cosine_sign()
    image = _image(tape, node, intervals)
    return None if image is None else image.sign()


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
