"""Certified integrals over time along an orbit of one degree of freedom: ∮ f dt, for averages."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from flint import arb

from canon.decide.arbitrary import rational
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import Ball, evaluate, precision
from canon.decide.libration import BITS, FAILURES, Integrand, Orbit
from canon.decide.orbit_quadrature import at_the_edge, integral_between, period
from canon.decide.tape import Node


def mean(integrand: Integrand, orbit: Orbit, energy: Node, f: Node, momentum: Node) -> tuple[Ball, Ball] | None:
    """∮ f dt and ∮ dt of a libration, dt = ∂square/∂E dq/(2 √square) on each branch of the momentum.

    **Arguments:** `f`, a node of the coordinate and of `momentum`.
    """
    tape, square = integrand.tape, integrand.square
    rate, slope = derivative(tape, square, energy), derivative(tape, square, integrand.coordinate)
    if tape.value(derivative(tape, integrand.mean, energy)) != 0:
        return None  # the branches take different times
    root = tape.sqrt(square)
    above, below = (substitute(tape, f, {momentum: tape.add([(integrand.mean, 1), (root, sign)])}) for sign in (1, -1))
    with precision(BITS):

        def weighted(v: Mapping[Node, Ball]) -> Ball:
            return (v[above] + v[below]) * v[rate] / v[square].sqrt() / 2

        whole = integral_between(integrand, weighted, [square, rate, above, below], orbit)
        time = period(integrand, orbit, energy)
        if whole is None or time is None:
            return None
        for near, far in ((orbit.left, orbit.outer[0]), (orbit.right, orbit.outer[1])):
            part = at_the_edge(integrand, (near, far), slope, rate)
            values = _with_momentum(integrand, f, momentum, near, far)
            if part is None or values is None:
                return None
            whole += part * values
        return whole, time


def _with_momentum(integrand: Integrand, f: Node, momentum: Node, near: Fraction, far: Fraction) -> Ball | None:
    """f over an edge, where the momentum is in a ball round both branches."""
    where = arb(rational((near + far) / 2), rational(abs(near - far) / 2))
    values = {name: arb(rational(value)) for name, value in integrand.point.items()}
    try:
        both = arb(integrand.at(integrand.square, where).abs_upper()).sqrt() * arb(0, 1)
        here = {**values, integrand.coordinate: where, momentum: integrand.at(integrand.mean, where) + both}
        return evaluate(integrand.tape, integrand.tape.reach([f]), here)[f]
    except FAILURES:
        return None
