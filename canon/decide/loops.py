"""A closed one-form that isn't exact: a loop in the region round which its integral is certainly not 0.

The loops are ellipses in the planes of two coordinates, round the places where a condition of the region fails: round
a zero of x² + y², say. Such a loop is covered by balls, in each of which every condition is certified, and the form is
integrated round it with an enclosure of the error (Johansson, Numerical integration in arbitrary-precision ball
arithmetic, 2018); nothing is assumed of the form.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, islice

from flint import acb, arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, excludes_zero, precision
from canon.decide.region import Region, admits, holds
from canon.decide.sample import Sample, ball_point
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported

BITS = 64
POINTS = 3
PIECES = 1024
EVALUATIONS = 4000
SIZES = (1.0, 1 / 3, 1 / 12, 1 / 60, 2.0, 6.0)
FAILURES = (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError)

Plane = tuple[Node, Node]
Vector = tuple[Fraction, Fraction]
Floats = tuple[float, ...]


@dataclass(frozen=True)
class Ellipse:
    """centre + cos(s)·first + sin(s)·second in the `plane` of two coordinates, all others as at the sample `place`."""

    place: Sample
    plane: Plane
    centre: Vector
    first: Vector
    second: Vector

    def point(self, cosine: Ball, sine: Ball) -> dict[Node, Ball]:
        """The point with this cosine and sine of the loop's parameter."""
        out = ball_point(self.place.point, self.place.solved)
        for node, c, a, b in zip(self.plane, self.centre, self.first, self.second, strict=True):
            out[node] = rational(c) + cosine * rational(a) + sine * rational(b)
        return out

    def describe(self, tape: Tape) -> dict[str, str]:
        """The loop as a table name = value, with s for its parameter."""
        table = {
            str(tape.symbol_at(node)): str(value)
            for node, value in self.place.point.items()
            if node not in self.plane and isinstance(value, Fraction)
        }
        for node, c, a, b in zip(self.plane, self.centre, self.first, self.second, strict=True):
            terms = [str(c)] if c else []
            terms += [f"{factor}*{wave}(s)" for factor, wave in ((a, "cos"), (b, "sin")) if factor]
            table[str(tape.symbol_at(node))] = " + ".join(terms)
        return table | {name: chosen.formula() for name, chosen in self.place.functions.items()}


@dataclass(frozen=True)
class Circulation:
    """The integral of a form round a loop of the region, as a ball that excludes 0."""

    loop: Ellipse
    value: Ball


def circulation(
    tape: Tape, slopes: Mapping[Node, Node], region: Region, rng: random.Random, budget: Budget, most: int = 60
) -> Circulation | None:
    """A loop in the region round which the form Σ slope · d(coordinate) has an integral other than 0, among `most`."""
    if region.surface or any(tape.is_complex(node) for node in slopes.values()):
        return None
    for loop in islice(_loops(tape, list(slopes), list(slopes.values()), region, rng, budget), most):
        budget.check()
        if not _inside(tape, loop, region, budget):
            continue
        value = integral(tape, slopes, loop)
        if value is not None and excludes_zero(value):
            return Circulation(loop, value)
    return None


def integral(tape: Tape, slopes: Mapping[Node, Node], loop: Ellipse) -> Ball | None:
    """The form's integral round the loop, as a ball; None where it can't be enclosed."""
    wanted = [_continued(tape, slopes[node]) for node in loop.plane]
    order = tape.reach(wanted)
    if any(tape.ops[i][:2] == ("f", "abs") for i in order):
        return None

    def integrand(s: acb, _analytic: bool) -> acb:
        cosine, sine = s.cos(), s.sin()
        try:
            balls = evaluate(tape, order, loop.point(cosine, sine), loop.place.functions)
        except (OutOfDomain, ZeroDivisionError, OverflowError):
            return acb("nan")
        total = acb(0)
        for node, a, b in zip(wanted, loop.first, loop.second, strict=True):
            total = total + balls[node] * (cosine * rational(b) - sine * rational(a))
        return total

    with precision(BITS):
        try:
            value = acb.integral(integrand, 0, 2 * arb.pi(), eval_limit=EVALUATIONS)
        except FAILURES:
            return None
        return value.real if value.is_finite() else None


def _continued(tape: Tape, node: Node) -> Node:
    """The node with √(u²) for |u| of real u: the quadrature's errors are bounded on complex discs, by analyticity."""
    sizes = [i for i in tape.reach([node]) if tape.ops[i][:2] == ("f", "abs")]
    inner = {i: tape.ops[i][2][0] for i in sizes}
    return substitute(tape, node, {i: tape.sqrt(tape.power(u, 2)) for i, u in inner.items() if not tape.is_complex(u)})


def _inside(tape: Tape, loop: Ellipse, region: Region, budget: Budget) -> bool:
    """Whether every condition is certified all along the loop."""
    order = tape.reach(region.nodes())
    pieces = [(Fraction(k, 8), Fraction(1, 8)) for k in range(8)]
    with precision(BITS):
        for _ in range(PIECES):
            if not pieces:
                return True
            budget.check()
            start, length = pieces.pop()
            turn = 2 * arb.pi() * arb(rational(start + length / 2), rational(length / 2))
            if not _certified(tape, loop.point(turn.cos(), turn.sin()), loop, region, order):
                if length < Fraction(1, 500):
                    return False
                pieces += [(start, length / 2), (start + length / 2, length / 2)]
    return False


def _certified(tape: Tape, point: dict[Node, Ball], loop: Ellipse, region: Region, order: Sequence[Node]) -> bool:
    if not all(admits(tape.symbol_at(node), point[node]) for node in loop.plane):
        return False
    try:
        balls = evaluate(tape, order, point, loop.place.functions)
    except FAILURES:
        return False
    return all(holds(requirement, balls) for requirement in region.requirements)


# -- candidates ---------------------------------------------------------------------------------------


def _loops(
    tape: Tape, variables: Sequence[Node], targets: Sequence[Node], region: Region, rng: random.Random, budget: Budget
) -> Iterator[Ellipse]:
    """Ellipses round the critical points of the conditions, through certified points of the region and nearer."""
    movable = [v for v in variables if tape.symbol_at(v).is_real and not tape.symbol_at(v).is_integer]
    walls = [
        node
        for requirement in region.requirements
        if requirement.kind in ("positive", "nonzero")
        for node in _factors(tape, requirement.nodes[0])
    ]
    for place in samples(tape, targets, region, rng, count=POINTS, tries=20, budget=budget):
        for wall in dict.fromkeys(walls):
            for plane in combinations([v for v in movable if v in tape.support(wall)], 2):
                centre, curvature = _critical_point(tape, wall, plane, place)
                yield from _round(place, plane, centre, curvature)


def _factors(tape: Tape, node: Node) -> list[Node]:
    op = tape.ops[node]
    return [inner for inner, _ in op[1]] if op[0] == "*" else [node]


def _critical_point(tape: Tape, wall: Node, plane: Plane, place: Sample) -> tuple[Floats, Floats | None]:
    """Where the condition's expression is extremal in the plane (Newton), and its second derivatives xx, xy, yy there.

    Any point will do as the centre of a loop: where the search fails it is the origin, and no second derivatives.
    """
    slopes = [derivative(tape, wall, x) for x in plane]
    nodes = [*slopes, *(derivative(tape, slopes[i], plane[j]) for i, j in ((0, 0), (0, 1), (1, 1)))]
    order = tape.reach(nodes)
    x, y = _start(plane, place)
    for _ in range(40):
        found = _numbers(tape, order, nodes, {plane[0]: x, plane[1]: y}, place)
        if found is None:
            break
        u, v, a, b, c = found
        area = a * c - b * b
        if not area > 0:
            break
        dx, dy = (c * u - b * v) / area, (a * v - b * u) / area
        x, y = x - dx, y - dy
        if abs(dx) + abs(dy) < 1e-9 * (1 + abs(x) + abs(y)):
            return (x, y), (abs(a), b if a > 0 else -b, abs(c))
    return (0.0, 0.0), None


def _round(place: Sample, plane: Plane, centre: Floats, curvature: Floats | None) -> Iterator[Ellipse]:
    """Level curves of the second-order expansion and circles, through the sample and inside of it and outside."""
    start = _start(plane, place)
    x, y = start[0] - centre[0], start[1] - centre[1]
    if not (x or y):
        return
    for size in SIZES:
        if curvature is not None:
            a, b, c = curvature
            level = math.sqrt(a * x * x + 2 * b * x * y + c * y * y) * size
            height = math.sqrt(c - b * b / a)
            first, second = (level / math.sqrt(a), 0.0), (-b / a * level / height, level / height)
            yield Ellipse(place, plane, _near(centre, 1000), _near(first, 64), _near(second, 64))
        if curvature is None or size == 1:
            radius = math.hypot(x, y) * size
            yield Ellipse(place, plane, _near(centre, 1000), _near((radius, 0.0), 64), _near((0.0, radius), 64))


def _start(plane: Plane, place: Sample) -> Floats:
    values = [place.point[node] for node in plane]
    return tuple(float(value) if isinstance(value, Fraction) else 0.0 for value in values)


def _numbers(
    tape: Tape, order: Sequence[Node], nodes: Sequence[Node], moved: Mapping[Node, float], place: Sample
) -> list[float] | None:
    with precision(BITS):
        try:
            at = ball_point(place.point, place.solved) | {node: arb(value) for node, value in moved.items()}
            balls = evaluate(tape, order, at, place.functions)
            return [float(balls[node].mid()) for node in nodes]
        except (*FAILURES, AttributeError, ValueError):
            return None


def _near(vector: Floats, denominator: int) -> Vector:
    """A simple vector close by; small ones keep their relative precision."""
    largest = max(abs(value) for value in vector) or 1.0
    finer = max(denominator, math.ceil(denominator / largest))
    first, second = (Fraction(value).limit_denominator(finer) for value in vector)
    return first, second
