"""Where a motion of one degree of freedom goes: its turning points, and what is certified all along.

Between turning points p = mean ± √square. Near each of them an interval as small as wished, with the square certified
negative at one end and positive at the other, holds the turning point. Nothing is assumed of the square but that its
formula is analytic.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction

from flint import arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, OutOfDomain, certainly_positive, evaluate, precision
from canon.decide.tape import Node, Tape, Unsupported

BITS = 160
NARROW = Fraction(1, 2**100)
STEPS, PIECES = 400, 4000
FAILURES = (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError)

Values = Mapping[Node, Fraction]


@dataclass(frozen=True)
class Orbit:
    """A libration: the square is positive from `left` to `right`; the turning points lie between these and `outer`."""

    left: Fraction
    right: Fraction
    outer: tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Integrand:
    """The square and the mean of the momentum's branches as nodes over the coordinate and constants, at a place.

    **Arguments:** `point`, exact values of all constants; `low` and `high`, the open range of the coordinate (None:
    infinite).
    """

    tape: Tape
    coordinate: Node
    square: Node
    mean: Node
    point: Values
    low: Fraction | None = None
    high: Fraction | None = None

    def at(self, node: Node, where: Ball) -> Ball:
        """A node's ball where the coordinate is in a ball."""
        values = {name: arb(rational(value)) for name, value in self.point.items()}
        return evaluate(self.tape, self.tape.reach([node]), {**values, self.coordinate: where})[node]

    def sign(self, where: Fraction) -> int:
        """The certified sign of the square at a place; 0 where it isn't certain."""
        try:
            ball = self.at(self.square, arb(rational(where)))
        except FAILURES:
            return 0
        return 1 if certainly_positive(ball) else -1 if certainly_positive(-ball) else 0


def libration(integrand: Integrand, inside: Fraction, budget: Budget) -> Orbit | None:
    """The libration through a point inside; None where none is certified."""
    with precision(BITS):
        if integrand.sign(inside) <= 0:
            return None
        below, above = (_turning_point(integrand, inside, direction, budget) for direction in (-1, 1))
        if below is None or above is None:
            return None
        (left, far_left), (right, far_right) = below, above
        orbit = Orbit(left, right, (far_left, far_right))
        return orbit if _positive_between(integrand, left, right, budget) else None


def _turning_point(
    integrand: Integrand, inside: Fraction, direction: int, budget: Budget
) -> tuple[Fraction, Fraction] | None:
    """(inner, outer): the square is positive at the one and negative at the other, a hair's breadth away."""
    edge = integrand.high if direction > 0 else integrand.low
    inner, step, outer = inside, (1 + abs(inside)) / 1000, inside
    for _ in range(STEPS):
        budget.check()
        move = min(step, abs(edge - inner) / 2) if edge is not None else step
        if move < Fraction(1, 10**9):
            return None
        outer = (inner + direction * move).limit_denominator(10**12)
        sign = integrand.sign(outer)
        if sign < 0:
            break
        if sign > 0 and _positive_over(integrand, inner, outer):
            inner, step = outer, 2 * move
        else:
            step = move / 3
    else:
        return None
    width = NARROW * max(Fraction(1), abs(inside))
    while abs(outer - inner) > width:
        for share in (Fraction(1, 2), Fraction(3, 7)):  # the one may be the turning point itself
            middle = inner + (outer - inner) * share
            sign = integrand.sign(middle)
            if sign:
                break
        else:
            return None
        inner, outer = (middle, outer) if sign > 0 else (inner, middle)
    return inner, outer


def _positive_over(integrand: Integrand, near: Fraction, far: Fraction) -> bool:
    ball = over(integrand, integrand.square, near, far)
    return ball is not None and certainly_positive(ball)


def _positive_between(integrand: Integrand, left: Fraction, right: Fraction, budget: Budget) -> bool:
    """Whether the square is certified positive all along."""
    return covered(left, right, budget, lambda where: certainly_positive(integrand.at(integrand.square, where)))


def stays(
    integrand: Integrand, left: Fraction, right: Fraction, budget: Budget, holds: Callable[[Ball, Ball], bool]
) -> bool:
    """Whether `holds` is certified of the coordinate and the momentum all along; of the latter a ball round both
    branches is taken."""

    def inside(where: Ball) -> bool:
        square = integrand.at(integrand.square, where)
        both = arb(square.abs_upper()).sqrt() * arb(0, 1)
        return holds(where, integrand.at(integrand.mean, where) + both)

    return covered(left, right, budget, inside, (right - left) / 2**12)


def covered(
    left: Fraction, right: Fraction, budget: Budget, certified: Callable[[Ball], bool], least: Fraction = Fraction(0)
) -> bool:
    """Whether `certified` holds of pieces that cover all between two places, none of them shorter than `least`."""
    pieces = [(left, right)]
    with precision(BITS):
        for _ in range(PIECES):
            if not pieces:
                return True
            budget.check()
            low, high = pieces.pop()
            try:
                if certified(arb(rational((low + high) / 2), rational((high - low) / 2))):
                    continue
            except FAILURES:
                pass
            if high - low < least:
                return False
            middle = (low + high) / 2
            pieces += [(low, middle), (middle, high)]
    return False


def over(integrand: Integrand, node: Node, near: Fraction, far: Fraction) -> Ball | None:
    """A node's ball where the coordinate is between two places; None where it has none."""
    where = arb(rational((near + far) / 2), rational(abs(near - far) / 2))
    try:
        return integrand.at(node, where)
    except FAILURES:
        return None
