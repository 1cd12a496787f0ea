"""Certified integrals along an orbit of one degree of freedom: ∮ p dq and its derivative by the energy.

Between turning points p = mean ± √square. Near each of them an interval as small as wished, with the square certified
negative at one end and positive at the other, holds the turning point; what it contributes is bounded, and in between,
where the square is certified positive, the quadrature's errors are enclosed (Johansson, Numerical integration in
arbitrary-precision ball arithmetic, 2018). Nothing is assumed of the square but that its formula is analytic.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction

from flint import acb, arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.derivative import derivative
from canon.decide.enclosure import Ball, OutOfDomain, certainly_positive, evaluate, precision
from canon.decide.tape import Node, Tape, Unsupported

BITS = 160
NARROW = Fraction(1, 2**100)
STEPS, PIECES, EVALUATIONS = 400, 4000, 40000
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
        return orbit if positive_between(integrand, left, right, budget) else None


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
    ball = _over(integrand, integrand.square, near, far)
    return ball is not None and certainly_positive(ball)


def positive_between(integrand: Integrand, left: Fraction, right: Fraction, budget: Budget) -> bool:
    """Whether the square is certified positive all along."""
    return _covered(left, right, budget, lambda where: certainly_positive(integrand.at(integrand.square, where)))


def stays(
    integrand: Integrand, left: Fraction, right: Fraction, budget: Budget, holds: Callable[[Ball, Ball], bool]
) -> bool:
    """Whether `holds` is certified of the coordinate and the momentum all along; of the latter a ball round both
    branches is taken."""

    def inside(where: Ball) -> bool:
        square = integrand.at(integrand.square, where)
        both = arb(square.abs_upper()).sqrt() * arb(0, 1)
        return holds(where, integrand.at(integrand.mean, where) + both)

    return _covered(left, right, budget, inside, (right - left) / 2**12)


def _covered(
    left: Fraction, right: Fraction, budget: Budget, certified: Callable[[Ball], bool], least: Fraction = Fraction(0)
) -> bool:
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


def action(integrand: Integrand, orbit: Orbit) -> Ball | None:
    """∮ p dq of a libration: twice the integral of √square."""
    with precision(BITS):
        inner = integral_between(integrand, lambda values: values[integrand.square].sqrt(), [integrand.square], orbit)
        if inner is None:
            return None
        total = inner
        for near, far in ((orbit.left, orbit.outer[0]), (orbit.right, orbit.outer[1])):
            bound = _over(integrand, integrand.square, near, far)
            size = abs(arb(rational(near - far)))
            if bound is None:
                return None
            total += _upto(arb(bound.abs_upper()).sqrt() * size)
        return 2 * total


def period(integrand: Integrand, orbit: Orbit, energy: Node) -> Ball | None:
    """d/dE ∮ p dq: the integral of ∂square/∂E over √square."""
    tape = integrand.tape
    rate = derivative(tape, integrand.square, energy)
    slope = derivative(tape, integrand.square, integrand.coordinate)
    with precision(BITS):
        total = integral_between(
            integrand,
            lambda values: values[rate] / values[integrand.square].sqrt(),
            [integrand.square, rate],
            orbit,
        )
        if total is None:
            return None
        for edge in ((orbit.left, orbit.outer[0]), (orbit.right, orbit.outer[1])):
            part = at_the_edge(integrand, edge, slope, rate)
            if part is None:
                return None
            total += part
        return total


def at_the_edge(integrand: Integrand, edge: tuple[Fraction, Fraction], slope: Node, rate: Node) -> Ball | None:
    """The time spent between a turning point and the inner edge."""
    steep, above = _over(integrand, slope, *edge), _over(integrand, rate, *edge)
    if steep is None or above is None or steep.contains(0):
        return None
    size = abs(arb(rational(edge[0] - edge[1])))
    part = arb(above.abs_upper()) * 2 * (size / arb(steep.abs_lower())).sqrt()
    return _upto(part) if certainly_positive(above) else part * arb(0, 1)


def turn(
    integrand: Integrand, start: Fraction, end: tuple[Fraction, Ball], budget: Budget, energy: Node | None
) -> Ball | None:
    """∫ p dq of a rotation with p > 0, or with `energy` its derivative; None where it isn't shown to be one.

    **Arguments:** the range's `start`, and a number just below its `end` with the little that is left to it.
    """
    last, rest = end
    beyond = last + 2 * Fraction(float(rest.upper()))
    if not _covered(start, beyond, budget, lambda where: _forward(integrand, where)):
        return None
    tape, square, mean = integrand.tape, integrand.square, integrand.mean
    orbit = Orbit(start, last, (start, last))
    with precision(BITS):
        if energy is None:

            def momentum(v: Mapping[Node, Ball]) -> Ball:
                return v[mean] + v[square].sqrt()

            nodes, value = [mean, square], momentum
        else:
            rates = [derivative(tape, node, energy) for node in (mean, square)]

            def slowness(v: Mapping[Node, Ball]) -> Ball:
                return v[rates[0]] + v[rates[1]] / v[square].sqrt() / 2

            nodes, value = [square, *rates], slowness
        whole = integral_between(integrand, value, nodes, orbit)
        values = {name: arb(rational(number)) for name, number in integrand.point.items()}
        where = arb(rational((last + beyond) / 2), rational((beyond - last) / 2))
        try:
            left = value(evaluate(tape, tape.reach(nodes), {**values, integrand.coordinate: where}))
        except FAILURES:
            return None
        return None if whole is None else whole + left * rest


def backward_too(integrand: Integrand, start: Fraction, end: Fraction, budget: Budget) -> bool:
    """Whether the branch of the lower momentum is certified to have p > 0 all along too."""

    def above(where: Ball) -> bool:
        square = integrand.at(integrand.square, where)
        lower = integrand.at(integrand.mean, where) - square.sqrt()
        return certainly_positive(square) and certainly_positive(lower)

    with precision(BITS):
        middle = arb(rational((start + end) / 2))
        try:
            return above(middle) and _covered(start, end, budget, above)
        except FAILURES:
            return False


def _forward(integrand: Integrand, where: Ball) -> bool:
    square = integrand.at(integrand.square, where)
    return certainly_positive(square) and certainly_positive(integrand.at(integrand.mean, where) + square.sqrt())


def _upto(most: Ball) -> Ball:
    """Anything from 0 to the greatest number in a ball."""
    half = arb(most.abs_upper()) / 2
    return half + half * arb(0, 1)


def _over(integrand: Integrand, node: Node, near: Fraction, far: Fraction) -> Ball | None:
    where = arb(rational((near + far) / 2), rational(abs(near - far) / 2))
    try:
        return integrand.at(node, where)
    except FAILURES:
        return None


def integral_between(
    integrand: Integrand, value: Callable[[Mapping[Node, Ball]], Ball], nodes: list[Node], orbit: Orbit
) -> Ball | None:
    """The integral of a function of these nodes from left to right."""
    order = integrand.tape.reach(nodes)
    constants = {name: arb(rational(number)) for name, number in integrand.point.items()}

    def function(z: acb, _analytic: bool) -> acb:
        try:
            values = evaluate(integrand.tape, order, {**constants, integrand.coordinate: z})
            square = values[integrand.square]
            if not (square.real > 0 if isinstance(square, acb) else square > 0):
                return acb("nan")
            return acb(value(values))
        except FAILURES:
            return acb("nan")

    left, right = (acb(rational(end)) for end in (orbit.left, orbit.right))
    try:
        found = acb.integral(function, left, right, rel_tol=arb(2) ** -60, eval_limit=EVALUATIONS)
    except FAILURES:
        return None
    return found.real if found.is_finite() else None
