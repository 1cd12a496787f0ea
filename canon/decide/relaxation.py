"""Towards a region given by inequalities: step along the gradient of what is missed (Agmon–Motzkin relaxation).

For convex regions the steps converge; for others it is one more way to propose a point. Every point is
certified elsewhere.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import isfinite
from typing import TYPE_CHECKING

from flint import arb

from canon.decide.arbitrary import ChosenFunction
from canon.decide.derivative import derivative
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.sample import ball_point
from canon.decide.tape import Node, Unsupported

if TYPE_CHECKING:
    from canon.decide.proposal import Coordinate
    from canon.decide.search import Finder

STEPS = 80
OVERSHOOT = (1.6, 1.2, 1.05)


def relax(
    finder: Finder, point: Mapping[Node, Coordinate], functions: Mapping[str, ChosenFunction]
) -> dict[Node, Coordinate] | None:
    """A point near the given one that misses no requirement, or None."""
    moving = [n for n, v in point.items() if isinstance(v, Fraction) and _moves(finder, n)]
    for overshoot in OVERSHOOT:
        place = dict(point)
        for _ in range(STEPS):
            _, missed = finder.violation(place, functions)
            if not missed:
                return place
            step = _step(finder, missed[0].nodes[0], place, moving, functions, overshoot)
            if step is None:
                break
            place.update(step)
    return None


def _moves(finder: Finder, node: Node) -> bool:
    symbol = finder.tape.symbol_at(node)
    return bool(symbol.is_real) and not symbol.is_integer


def _step(
    finder: Finder,
    target: Node,
    place: Mapping[Node, Coordinate],
    moving: Sequence[Node],
    functions: Mapping[str, ChosenFunction],
    overshoot: float,
) -> dict[Node, Coordinate] | None:
    """The move along the gradient that brings the target from e ≤ 0 a little beyond 0."""
    tape = finder.tape
    try:
        slopes = {n: derivative(tape, target, n) for n in moving if n in tape.support(target)}
        with precision(128):
            balls = evaluate(tape, tape.reach([target, *slopes.values()]), ball_point(place, {}), functions)
            value = float(balls[target].mid()) if isinstance(balls[target], arb) else 0.0
            gradient = {n: float(balls[s].mid()) for n, s in slopes.items() if isinstance(balls[s], arb)}
    except (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError):
        return None
    norm = sum(g * g for g in gradient.values())
    if value > 0 or not norm or not isfinite(norm):
        return None
    factor = (overshoot * -value + 1e-9 * (1.0 + abs(value))) / norm
    if not all(isfinite(slope * factor) for slope in gradient.values()):  # beyond floating-point numbers
        return None
    out: dict[Node, Coordinate] = {}
    for node, slope in gradient.items():
        before = place[node]
        assert isinstance(before, Fraction)
        moved = before + Fraction(slope * factor)
        out[node] = moved.limit_denominator(10**9) if abs(moved) > Fraction(1, 10**4) else moved
    return out
