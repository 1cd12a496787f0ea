"""Positive since the slope is: f(c) ≥ 0 and f grows on both sides of c, along one symbol, all others held fixed.

So sin x < x for x > 0, log x ≤ x − 1 and 1 + x ≤ exp x: the slope's sign is shown by its factors, or in this way again.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction

from flint import arb

from canon.budget import Budget
from canon.decide.cells import state_on
from canon.decide.constants import number_is_zero
from canon.decide.continuous_at import at_edge, is_continuous_at
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, excludes_zero, precision
from canon.decide.intervals import (
    Edge,
    Interval,
    declared,
    exact_affine,
    intervals_of,
    leaves_out_zero,
    may_be_zero,
)
from canon.decide.positivity import positive_by_signs
from canon.decide.region import Region, Requirement
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import InputError

DEEPEST = 3
SIMPLE = (Fraction(0), Fraction(1), Fraction(-1))


def positive_by_slopes(
    tape: Tape, node: Node, region: Region, budget: Budget, *, strict: bool, depth: int = DEEPEST
) -> Node | None:
    """The symbol along which a real node is shown to be positive (not negative) throughout the region; None without."""
    if region.surface or tape.functions_of([node, *region.nodes()]):
        return None
    for x in sorted(tape.support(node)):
        symbol = tape.symbol_at(x)
        if not symbol.is_real or symbol.is_integer or (strict and may_be_zero(tape, x)):
            continue
        if _along(tape, node, x, region, budget, strict, depth):
            return x
    return None


def _along(tape: Tape, node: Node, x: Node, region: Region, budget: Budget, strict: bool, depth: int) -> bool:
    budget.check()
    try:
        slope = derivative(tape, node, x)
    except Unsupported:
        return False
    box = {n: declared(tape, n) for n in set().union(*(tape.support(n) for n in [node, *region.nodes()]))}
    box.update(intervals_of(tape, region))
    if leaves_out_zero(tape, x, box[x]):
        return False
    moving = [r for r in region.requirements if any(x in tape.support(n) for n in r.nodes)]
    coupled = tuple(r for r in moving if r.kind != "positive" or exact_affine(tape, r.nodes[0]) is None)
    if coupled and state_on(tape, Region(coupled, (), ()), box, budget)[0] != "inside":
        return False
    others = Region(tuple(r for r in region.requirements if r not in moving), (), ())
    for c in _centres(box[x]):
        inside = box[x].contains(c.rational) if not c.pi else False
        place = at_edge(tape, c)
        try:
            value = substitute(tape, node, {x: place})
        except (InputError, ZeroDivisionError):
            continue
        if not inside and not is_continuous_at(tape, node, x, place, box, budget):
            continue
        if not _is_positive(tape, value, others, budget, strict=strict and inside):
            continue
        sides = [side for side in (1, -1) if not box[x].meet(_half(c, side)).is_empty()]
        if all(_rises(tape, slope, x, place, side, region, budget, strict, depth) for side in sides):
            return True
    return _is_concave_between(tape, node, slope, x, box, region, others, budget, strict)


def _is_concave_between(
    tape: Tape,
    node: Node,
    slope: Node,
    x: Node,
    box: dict[Node, Interval],
    region: Region,
    others: Region,
    budget: Budget,
    strict: bool,
) -> bool:
    """Whether the node isn't negative at both ends of the symbol's interval, and (strictly) concave between them."""
    for edge in (box[x].low, box[x].high):
        if edge is None:
            return False
        place = at_edge(tape, edge)
        try:
            value = substitute(tape, node, {x: place})
        except (InputError, ZeroDivisionError):
            return False
        if not is_continuous_at(tape, node, x, place, box, budget):
            return False
        if not _is_positive(tape, value, others, budget, strict=False):
            return False
    try:
        bend = tape.negative(derivative(tape, slope, x))
    except Unsupported:
        return False
    return _is_positive(tape, bend, region, budget, strict=strict)


def _centres(interval: Interval) -> Iterator[Edge]:
    yield from (Edge(v) for v in SIMPLE if interval.contains(v))
    yield from (edge for edge in (interval.low, interval.high) if edge is not None)


def _half(c: Edge, side: int) -> Interval:
    return Interval(low=c) if side > 0 else Interval(high=c)


def _rises(
    tape: Tape, slope: Node, x: Node, place: Node, side: int, region: Region, budget: Budget, strict: bool, depth: int
) -> bool:
    """Whether the function with this slope isn't smaller (`strict`: is greater) beyond a place, on one side of it."""
    wall = Requirement("positive", (tape.scaled(tape.minus(x, place), side),), f"{tape.symbol_at(x)} on one side")
    there, outward = region.also(wall), tape.scaled(slope, side)
    for strictly in (True, False):
        shown = _is_positive(tape, outward, there, budget, strict=strictly) or (
            depth > 0 and _along(tape, outward, x, there, budget, strictly, depth - 1)
        )
        if shown:
            return strictly or not strict or _not_flat(tape, outward, x, there, budget)
    return False


def _not_flat(tape: Tape, slope: Node, x: Node, region: Region, budget: Budget) -> bool:
    """An analytic slope of one symbol that isn't 0 at one point of an interval has isolated zeros there."""
    if tape.support(slope) != {x}:
        return False
    points = samples(tape, [slope], region, random.Random(1), count=3, tries=8, budget=budget, nice=True)
    return any(excludes_zero(point.balls[slope]) for point in points)


def _is_positive(tape: Tape, node: Node, region: Region, budget: Budget, *, strict: bool) -> bool:
    if tape.support(node):
        return positive_by_signs(tape, node, region, budget.share(0.3), strict=strict)
    ball = _ball(tape, node, {})
    if ball is None:
        return False
    return bool(ball > 0) or (not strict and number_is_zero(tape, node, budget) is True)


def _ball(tape: Tape, node: Node, at: dict[Node, Ball]) -> arb | None:
    with precision(128):
        try:
            ball = evaluate(tape, tape.reach([node]), at)[node]
        except (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError):
            return None
    return ball if isinstance(ball, arb) and ball.is_finite() else None
