"""Is a function positive, or at least not negative, throughout a region?

Two arguments prove it: the signs of the factors of its normal form, from assumptions, conditions and squares; or a
cover of the region, where it is bounded, by boxes on each of which a ball is positive. A certified point with a
negative ball refutes; it is sought downhill.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from flint import arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.intervals import Edge, Interval, declared, exact_affine, intervals_of, may_be_zero
from canon.decide.proposal import Coordinate
from canon.decide.region import Region
from canon.decide.ring import TooCostly
from canon.decide.sample import Sample
from canon.decide.search import Finder, samples
from canon.decide.signs import classify, sign_of, sign_of_rest
from canon.decide.special_values import at_special_values
from canon.decide.tape import Node, Tape, Unsupported
from canon.decide.tower import Tower, combine
from canon.errors import InputError

MOST_BOXES = 4000
STARTS, STEPS = 4, 160
Box = dict[Node, tuple[Fraction, Fraction]]


def positive_by_signs(
    tape: Tape, node: Node, region: Region, budget: Budget, *, strict: bool, thorough: bool = False
) -> bool:
    """Whether the factors of the normal form make the node positive (not negative) on the whole region.

    `thorough`: conditions are used that contain functions which the node doesn't, too. The box of the symbols is taken
    for open; where a symbol may be 0 besides, a strict sign is shown there too, and one that isn't strict follows by
    continuity.
    """
    value = tape.value(node)
    if value is not None:
        return value > 0 or (value == 0 and not strict)
    positive = [r.nodes[0] for r in region.requirements if r.kind == "positive" and not tape.is_complex(r.nodes[0])]
    sign = _sign(tape, node, intervals_of(tape, region), positive, budget, thorough)
    if sign != "pos" and (strict or sign != "nonneg"):
        return False
    if not strict:
        return True
    weak = [x for x in sorted(tape.support(node)) if may_be_zero(tape, x)]
    try:
        return all(
            positive_by_signs(
                tape, substitute(tape, node, {x: tape.zero}), _without(tape, region, x), budget, strict=True
            )
            for x in weak
        )
    except InputError:  # the node isn't defined there
        return False


def _without(tape: Tape, region: Region, x: Node) -> Region:
    """The conditions that don't speak of a symbol."""
    kept = tuple(r for r in region.requirements if not any(x in tape.support(node) for node in r.nodes))
    return Region(kept, (), region.symbols)


def _sign(
    tape: Tape,
    node: Node,
    box: Mapping[Node, Interval],
    positive: Sequence[Node],
    budget: Budget,
    thorough: bool = False,
) -> str | None:
    try:
        targets = [node, *positive] if thorough else [node]
        tower = Tower(tape, targets, positive=positive, intervals=box, budget=budget)
        values = dict(tower.values)
        for i in tape.reach([node]):
            if i not in values:
                values[i] = combine(tower.field, tape.ops[i], values)
        above = tower.field.normal(values[node][0])
        if not above:
            return "nonneg"
        value = (above, values[node][1])
        if tower.is_complex(value):
            return None
        sign, _, known, unknown = classify(tower, value)
        rest = sign_of_rest(tower, unknown)
        if rest is None or (sign > 0) != (rest in ("pos", "nonneg")):
            return None
        strict = rest in ("pos", "neg") and all(e < 0 or sign_of(tower, f) in ("pos", "neg") for f, e in known)
        return "pos" if strict else "nonneg"
    except (Unsupported, TooCostly, ZeroDivisionError):
        return None


def positive_by_boxes(tape: Tape, node: Node, region: Region, budget: Budget, *, strict: bool) -> int | None:
    """The number of boxes that cover the region, on each of which the node's ball is positive; None where none do.

    Boxes on which a condition of the region certainly fails are left out. Each symbol of the node, and of conditions
    that share one with it, must have a bounded interval.
    """
    if region.surface or tape.functions_of([node, *region.nodes()]):
        return None
    first = [r.nodes[0] for r in region.requirements if r.kind == "positive" and not tape.is_complex(r.nodes[0])]
    conditions = [c for c in first if exact_affine(tape, c) is None and tape.support(c) & tape.support(node)]
    known = intervals_of(tape, region)
    box: Box = {}
    for x in sorted(set().union(*(tape.support(n) for n in (node, *conditions)))):
        interval = known.get(x, declared(tape, x))
        if interval.low is None or interval.high is None or tape.symbol_at(x).is_integer:
            return None
        box[x] = _outward(interval.low, -1), _outward(interval.high, 1)
    order = tape.reach([node])
    orders = [(c, tape.reach([c])) for c in conditions]
    try:
        slopes = {x: derivative(tape, node, x) for x in box if x in tape.support(node)}
    except Unsupported:
        slopes = {}
    stack, done = [box], 0
    while stack:
        budget.check()
        done += 1
        if done + len(stack) > MOST_BOXES:
            return None
        box = stack.pop()
        with precision(64):
            place = {x: arb(rational(low)).union(arb(rational(high))) for x, (low, high) in box.items()}
            if any((ball := _ball(tape, o, c, place)) is not None and ball < 0 for c, o in orders):
                continue
            if any(
                ball is not None and (ball > 0 or (not strict and ball >= 0))
                for ball in (_ball(tape, order, node, place), _mean_value(tape, order, node, slopes, box, place))
            ):
                continue
        if not box:  # a constant that its ball doesn't tell from 0
            return None
        x = max(box, key=lambda x: box[x][1] - box[x][0])
        low, high = box[x]
        middle = (low + high) / 2
        stack += [{**box, x: (low, middle)}, {**box, x: (middle, high)}]
    return done


def _mean_value(
    tape: Tape, order: Sequence[Node], node: Node, slopes: Mapping[Node, Node], box: Box, place: Mapping[Node, Ball]
) -> arb | None:
    """f(c) + Σ ∂f/∂x(box)·(x − c), an enclosure of f on the box that is narrow where the slopes are.

    It takes f for smooth on the box: None where a part of it has a pole, a cut or a jump there, as |x|/x at 0.
    """
    if not slopes or tape.is_complex(node) or not _is_smooth(tape, order, place):
        return None
    centre = {x: arb(rational((low + high) / 2)) for x, (low, high) in box.items()}
    total = _ball(tape, order, node, centre)
    for x, slope in slopes.items():
        ball = None if total is None else _ball(tape, tape.reach([slope]), slope, place)
        total = None if ball is None or total is None else total + ball * (place[x] - centre[x])
    return total


def _is_smooth(tape: Tape, order: Sequence[Node], place: Mapping[Node, Ball]) -> bool:
    """Whether every part of a real node is finite on the box: then no denominator is 0 there, nor is a cut met."""
    try:
        balls = evaluate(tape, order, place, {})
    except (OutOfDomain, ZeroDivisionError, OverflowError, Unsupported):
        return False
    return all(isinstance(balls[i], arb) and balls[i].is_finite() for i in order)


def _ball(tape: Tape, order: Sequence[Node], node: Node, place: Mapping[Node, Ball]) -> arb | None:
    try:
        ball = evaluate(tape, order, place, {})[node]
    except (OutOfDomain, ZeroDivisionError, OverflowError, Unsupported):
        return None
    return ball if isinstance(ball, arb) and ball.is_finite() else None


def _outward(edge: Edge, side: int) -> Fraction:
    """A rational at the edge, or just outside of it where π is in it."""
    if not edge.pi:
        return edge.rational
    with precision(64):
        ball = arb(rational(edge.rational)) + arb.pi() * arb(rational(edge.pi))
        mantissa, exponent = (ball.upper() if side > 0 else ball.lower()).man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def first_points(tape: Tape, node: Node, region: Region, rng: random.Random, budget: Budget) -> list[Sample]:
    """Certified points of the region with the node's balls there, at special values of its names among them."""
    usual = list(samples(tape, [node], region, rng, count=12, tries=8, budget=budget, nice=True))
    names = sorted(tape.support(node))
    return usual + list(at_special_values(tape, names, [node], region, rng, budget)) if usual else []


def point_below(
    tape: Tape,
    node: Node,
    region: Region,
    starts: Sequence[Sample],
    rng: random.Random,
    budget: Budget,
    *,
    strict: bool,
) -> Sample | None:
    """A certified point downhill of the lowest of these at which the node is negative (`strict`: or exactly 0)."""
    if region.surface:
        return None
    finder = Finder(tape, [node], region, rng, budget)
    for sample in _near_ends(finder, node, starts, intervals_of(tape, region)):
        if is_below(tape, node, sample, strict=strict):
            return sample
    for sample in sorted(starts, key=lambda s: float(s.balls[node].mid()))[:STARTS]:
        for lower in _downhill(finder, node, sample, rng, budget):
            if is_below(tape, node, lower, strict=strict):
                return lower
    return None


def _near_ends(finder: Finder, node: Node, starts: Sequence[Sample], box: Mapping[Node, Interval]) -> Iterator[Sample]:
    """Points of the region near the ends of its intervals."""
    tape = finder.tape
    for start in starts[:STARTS]:
        for x in sorted(tape.support(node)):
            interval, value = box.get(x, Interval()), start.point.get(x)
            if not isinstance(value, Fraction) or tape.symbol_at(x).is_integer:
                continue
            for edge, side in ((interval.low, 1), (interval.high, -1)):
                if edge is None:
                    continue
                end = _outward(edge, -side)
                for near in (Fraction(1, 2**k) for k in (5, 10, 20, 40)):
                    point: dict[Node, Coordinate] = {**start.point, x: end + (value - end) * near}
                    found = finder.certify(point, {}, start.functions, 64)
                    if found is not None:
                        yield found


def is_below(tape: Tape, node: Node, sample: Sample, *, strict: bool) -> bool:
    """Whether the node is certainly negative at the point (`strict`: or exactly 0)."""
    if sample.balls[node] < 0:
        return True
    if not strict or sample.solved or not sample.balls[node].contains(0):
        return False
    exact = {n: tape.number(v) for n, v in sample.point.items() if not isinstance(v, tuple)}
    return tape.value(substitute(tape, node, exact)) == 0


def _downhill(finder: Finder, node: Node, start: Sample, rng: random.Random, budget: Budget) -> Iterator[Sample]:
    """Points of the region with smaller and smaller values, one coordinate changed at a time."""
    tape, best = finder.tape, start
    names = [x for x in sorted(tape.support(node)) if isinstance(start.point.get(x), Fraction)]
    if not names:
        return
    reach = Fraction(1)
    for step in range(STEPS):
        budget.check()
        x = names[step % len(names)]
        value = best.point[x]
        assert isinstance(value, Fraction)
        others = [v for y in names if y != x and isinstance(v := best.point[y], Fraction)]
        size = max(abs(value), Fraction(1, 8)) * reach
        moves = [value + size, value - size, -value, Fraction(0), *others, *(-v for v in others)]
        if tape.symbol_at(x).is_integer:
            moves = [value + 1, value - 1]
        points: list[dict[Node, Coordinate]] = [{**best.point, x: move.limit_denominator(10**6)} for move in moves]
        found = [s for point in points if (s := finder.certify(point, {}, best.functions, 64)) is not None]
        lowest = min(found, key=lambda s: float(s.balls[node].mid()), default=best)
        if lowest.balls[node].mid() < best.balls[node].mid():
            best = lowest
            yield best
        elif x == names[-1]:
            reach = reach * Fraction(3, 5) if reach > Fraction(1, 10**5) else Fraction(rng.randrange(1, 4))
