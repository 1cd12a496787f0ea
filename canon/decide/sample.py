"""A certified point of a region, and the balls of residuals there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from flint import acb, arb

from canon.decide.arbitrary import ChosenFunction, rational
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.proposal import Coordinate
from canon.decide.tape import Node, Tape, Unsupported


@dataclass(frozen=True)
class Sample:
    """A certified point of the region.

    `point` holds the exact coordinates; `solved` the enclosures of coordinates that a surface equation fixes.
    """

    point: Mapping[Node, Coordinate]
    solved: Mapping[Node, Ball]
    functions: Mapping[str, ChosenFunction]
    balls: Mapping[Node, Ball] = field(compare=False)


def ball_point(point: Mapping[Node, Coordinate], solved: Mapping[Node, Ball]) -> dict[Node, Ball]:
    """The coordinates as balls at the working precision."""
    out: dict[Node, Ball] = {}
    for node, value in point.items():
        out[node] = acb(*(rational(part) for part in value)) if isinstance(value, tuple) else arb(rational(value))
    out.update(solved)
    return out


def evaluate_again(tape: Tape, nodes: Sequence[Node], sample: Sample, bits: int) -> dict[Node, Ball]:
    """Balls for further nodes at an exact sample, in another precision."""
    with precision(bits):
        return evaluate(tape, tape.reach(nodes), ball_point(sample.point, sample.solved), sample.functions)


def extended(tape: Tape, nodes: Sequence[Node], known: Sequence[Sample]) -> list[Sample]:
    """The samples with balls of these nodes too; none at all if they aren't defined at one of them."""
    order = tape.reach(nodes)
    out = []
    for sample in known:
        balls = dict(sample.balls)
        try:
            with precision(64):
                evaluate(tape, order, ball_point(sample.point, sample.solved), sample.functions, balls)
        except (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError, KeyError):
            return []
        out.append(replace(sample, balls=balls))
    return out


def deeply_zero(tape: Tape, node: Node, points: Sequence[Sample]) -> bool:
    """Whether balls of 1024 bits lie within 1e-200 of 0 at each of the points: evidence, no proof."""
    try:
        for point in points:
            if node in point.balls:
                ball = evaluate_again(tape, [node], point, 1024)[node]
                if not float(ball.abs_upper()) < 1e-200:
                    return False
    except (Unsupported, OutOfDomain, ZeroDivisionError, OverflowError):
        return False
    return True
