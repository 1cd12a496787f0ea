"""Certified integrals along an orbit of one degree of freedom: ∮ p dq and its derivative by the energy.

What the little intervals that hold the turning points contribute (`canon.decide.libration`) is bounded, and in between,
where the square under the root is certified positive, the quadrature's errors are enclosed (Johansson, Numerical
integration in arbitrary-precision ball arithmetic, 2018).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction

from flint import acb, arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.derivative import derivative
from canon.decide.enclosure import Ball, certainly_positive, evaluate, precision
from canon.decide.libration import BITS, FAILURES, Integrand, Orbit, covered, over
from canon.decide.tape import Node

EVALUATIONS = 40000


def action(integrand: Integrand, orbit: Orbit) -> Ball | None:
    """∮ p dq of a libration: twice the integral of √square."""
    with precision(BITS):
        inner = integral_between(integrand, lambda values: values[integrand.square].sqrt(), [integrand.square], orbit)
        if inner is None:
            return None
        total = inner
        for near, far in ((orbit.left, orbit.outer[0]), (orbit.right, orbit.outer[1])):
            bound = over(integrand, integrand.square, near, far)
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
    steep, above = over(integrand, slope, *edge), over(integrand, rate, *edge)
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
    if not covered(start, beyond, budget, lambda where: _forward(integrand, where)):
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
            return above(middle) and covered(start, end, budget, above)
        except FAILURES:
            return False


def _forward(integrand: Integrand, where: Ball) -> bool:
    square = integrand.at(integrand.square, where)
    return certainly_positive(square) and certainly_positive(integrand.at(integrand.mean, where) + square.sqrt())


def _upto(most: Ball) -> Ball:
    """Anything from 0 to the greatest number in a ball."""
    half = arb(most.abs_upper()) / 2
    return half + half * arb(0, 1)


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
