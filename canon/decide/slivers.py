"""Points in the thin parts of the region: on either side of the zeros of its conditions.

Where a formula changes its branch, an argument of abs, a radicand, a denominator or an argument of atan2 vanishes, and
these are conditions of the region. A part of width 1e-6 between such a zero and the edge of the domain is missed by
points at random. Here the zeros are looked for along lines through known points, one coordinate moving at a time: balls
over shrinking intervals show where there are none. Between each two of them lies a point to try; it is certified as
every other one, so that nothing rests on the search.
"""

from __future__ import annotations

import math
import random
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

from flint import arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.derivative import derivative
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, excludes_zero, precision
from canon.decide.region import Region
from canon.decide.sample import Sample, ball_point
from canon.decide.search import Finder, samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.sign import declared

BITS = 64
FINER = 256
PIECES = 16
MOST_LOOKS = 400
MOST_WORK = 12_000
MOST_LINES = 24
MOST_GAPS = 20
MOST_POINTS = 80
SLOW = 60
QUICK = ("exp", "log", "sin", "cos", "atan", "asin", "acos", "atan2", "abs")
MOST_SWITCHES = 12
MORE_POINTS = 6
MOST_SIDES = 4
REACH = 12
FINEST = Fraction(1, 2**36)
THIN = Fraction(1, 2**30)
NEAR = Fraction(1, 2**30)
FAILURES = (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError, ValueError)

Look = Callable[[Fraction, Fraction], Ball | None]
Span = tuple[Fraction, Fraction]


def points_between_zeros(
    tape: Tape, targets: Sequence[Node], region: Region, known: Sequence[Sample], rng: random.Random, budget: Budget
) -> Iterator[Sample]:
    """Certified points between the zeros of the region's conditions on lines through the known points."""
    switches = _switches(tape, region)
    if region.surface or not switches:
        return
    finder = Finder(tape, [*targets, *switches], region, rng, budget)
    moving = [x for x in finder.symbols if _is_a_line(tape, x) and any(x in tape.support(s) for s in switches)]
    usable = [place for place in known if place.point.keys() >= set(finder.symbols)]
    drawn = list(samples(tape, [*targets, *switches], region, rng, count=MORE_POINTS, tries=4, budget=budget))
    yield from drawn
    sides = {_signs(place, switches): place for place in (*drawn, *usable)}
    waiting = deque(list(sides.values())[-MOST_SIDES:])
    for place in _near_the_edges(tape, finder, moving, list(waiting)):
        yield place
        waiting.append(place)
    seen = {_signs(place, switches) for place in waiting}
    made = 0
    work = iter(range(MOST_LINES))
    while waiting:
        place = waiting.popleft()
        for x in moving:
            if next(work, None) is None:
                return
            for value in _between(tape, finder, switches, place, x, budget):
                budget.check()
                made += 1
                if made > MOST_POINTS:
                    return
                found = _certified(finder, place, x, value)
                if found is None:
                    continue
                yield found
                signs = _signs(found, switches)
                if signs not in seen:
                    seen.add(signs)
                    waiting.append(found)


def _near_the_edges(tape: Tape, finder: Finder, moving: Sequence[Node], places: Sequence[Sample]) -> Iterator[Sample]:
    """The points moved to each edge of a bounded coordinate, since thin parts lie in corners too."""
    for place in places:
        for x in moving:
            low, high = finder.bounds.get(x, (-math.inf, math.inf))
            width = Fraction(high) - Fraction(low) if high - low < math.inf else Fraction(1)
            ends = [Fraction(low) + width * NEAR] if low > -math.inf else []
            ends += [Fraction(high) - width * NEAR] if high < math.inf else []
            for value in ends:
                found = _certified(finder, place, x, value.limit_denominator(10**14))
                if found is not None:
                    yield found


def _switches(tape: Tape, region: Region) -> list[Node]:
    """What must not vanish, factor by factor; simple ones first."""
    found: dict[Node, None] = {}
    for requirement in region.requirements:
        nodes = requirement.nodes
        for node in _edges_of_function(tape, nodes[0]) if requirement.kind == "regular" else nodes:
            op = tape.ops[node]
            for factor in (inner for inner, _ in op[1]) if op[0] == "*" else (node,):
                if not tape.is_complex(factor) and tape.support(factor):
                    found.setdefault(factor)
    return sorted(found, key=lambda node: (len(tape.reach([node])), node))[:MOST_SWITCHES]


def _edges_of_function(tape: Tape, node: Node) -> list[Node]:
    """What vanishes where the special function of a condition has a pole or a branch point."""
    op = tape.ops[node]
    if op[0] != "f":
        return []
    if op[1] == "lambertw":
        return [tape.add(((tape.times(op[2][0], tape.call("exp", tape.one)), 1),), 1)]
    if op[1] in ("elliptic_pi", "elliptic_pii"):
        return [tape.add(((a, -1),), 1) for a in (op[2][0], op[2][-1])]
    return list(op[2])


def _is_a_line(tape: Tape, x: Node) -> bool:
    symbol = tape.symbol_at(x)
    return bool(symbol.is_real) and not symbol.is_integer and not symbol.is_rational


def _signs(place: Sample, switches: Sequence[Node]) -> tuple[bool | None, ...]:
    """The side of each zero that the point lies on."""
    balls = [place.balls.get(s) for s in switches]
    return tuple(None if ball is None or ball.contains(0) else bool(ball > 0) for ball in balls)


def _certified(finder: Finder, place: Sample, x: Node, value: Fraction) -> Sample | None:
    for bits in (BITS, FINER):
        try:
            found = finder.certify({**place.point, x: value}, {}, place.functions, bits)
        except (Unsupported, ValueError):
            return None
        if found is not None:
            return found
    return None


def _between(
    tape: Tape, finder: Finder, switches: Sequence[Node], place: Sample, x: Node, budget: Budget
) -> list[Fraction]:
    """A coordinate between each two neighbouring zeros of the switches on the line, nearest first."""
    start = place.point[x]
    assert isinstance(start, Fraction)
    low, high = _ends(tape, finder, x, start)
    spans: list[Span] = []
    for switch in switches:
        for factor in _with_slope(tape, switch, x):
            budget.check()
            look, size = _along(tape, factor, place, x)
            spans += _zeros(look, low, high, min(MOST_LOOKS, MOST_WORK // size))
    thin = [span for span in spans if span[1] - span[0] < THIN * (1 + abs(span[0]))]
    wide = [span for span in spans if span not in thin and not any(_inside(other, span) for other in thin)]
    out, edge = [], low
    for left, right in [*sorted(thin + wide), (high, high)]:
        if left > edge:
            out.append(simplest(edge, left))
        edge = max(edge, right)
    return sorted(out, key=lambda value: abs(value - start))[:MOST_GAPS]


def _with_slope(tape: Tape, switch: Node, x: Node) -> list[Node]:
    """The switch and the factors of its slope: a double zero, as of 1 − sin², is a simple zero of one of these."""
    if x not in tape.support(switch):
        return []
    slope = derivative(tape, switch, x)
    op = tape.ops[slope]
    if op[0] == "+" and not op[1] and len(op[2]) == 1:
        slope = op[2][0][0]
        op = tape.ops[slope]
    factors = [inner for inner, _ in op[1]] if op[0] == "*" else [slope]
    return [switch, *(f for f in factors if x in tape.support(f) and f != switch and tape.ops[f][0] != "s")]


def _inside(inner: Span, outer: Span) -> bool:
    return outer[0] <= inner[0] and inner[1] <= outer[1]


def _ends(tape: Tape, finder: Finder, x: Node, start: Fraction) -> Span:
    """The part of the line that is looked at."""
    reach = REACH + 2 * abs(start)
    low, high = finder.bounds.get(x, (-math.inf, math.inf))
    facts = declared(tape.symbol_at(x))
    low = max(low, 0.0) if facts.get("nonnegative") else low
    high = min(high, 0.0) if facts.get("nonpositive") else high
    left = start - reach if low == -math.inf else Fraction(low)
    right = start + reach if high == math.inf else Fraction(high)
    return min(left, start), max(right, start)


def _along(tape: Tape, switch: Node, place: Sample, x: Node) -> tuple[Look, int]:
    """The switch's ball over an interval of the line (None where it isn't known to be defined), and its cost."""
    order = tape.reach([switch])
    moving = {i for i in order if x in tape.support(i)}
    fixed = {i: place.balls[i] for i in order if i not in moving and i in place.balls}
    others = ball_point(place.point, place.solved)

    def look(left: Fraction, right: Fraction) -> Ball | None:
        with precision(BITS):
            ball = arb(rational((left + right) / 2), rational((right - left) / 2))
            try:
                return evaluate(tape, order, others | {x: ball}, place.functions, dict(fixed))[switch]
            except FAILURES:
                return None

    return look, 1 + sum(SLOW if tape.ops[i][0] == "f" and tape.ops[i][1] not in QUICK else 1 for i in moving)


def _zeros(look: Look, low: Fraction, high: Fraction, looks: int) -> list[Span]:
    """Short intervals that contain all zeros between two points, as far as so many looks show it."""
    step = (high - low) / PIECES
    pieces = deque((low + k * step, low + (k + 1) * step) for k in range(PIECES)) if step else deque()
    found: list[Span] = []
    for _ in range(looks):
        if not pieces:
            break
        left, right = pieces.popleft()
        ball = look(left, right)
        if ball is not None and excludes_zero(ball):
            continue
        if right - left < FINEST * (1 + abs(left)):
            found.append((left, right))
        else:
            middle = (left + right) / 2
            pieces += [(left, middle), (middle, right)]
    return _joined([*found, *pieces])


def _joined(spans: Sequence[Span]) -> list[Span]:
    out: list[Span] = []
    for left, right in sorted(spans):
        if out and left <= out[-1][1]:
            out[-1] = (out[-1][0], max(right, out[-1][1]))
        else:
            out.append((left, right))
    return out


def simplest(low: Fraction, high: Fraction) -> Fraction:
    """The rational number with the smallest denominator strictly between two numbers (Stern and Brocot's tree)."""
    if low < 0 < high:
        return Fraction(0)
    if high <= 0:
        return -simplest(-high, -low)
    whole = math.floor(low)
    if whole + 1 < high:
        return Fraction(whole + 1)
    rest = high - whole
    if low == whole:
        return whole + Fraction(1, math.floor(1 / rest) + 1)
    return whole + 1 / simplest(1 / rest, 1 / (low - whole))
