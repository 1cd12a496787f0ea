"""Certified values of definite integrals over bounded ranges, in ball arithmetic.

The errors are enclosed where the integrand is analytic (Johansson, Numerical integration in arbitrary-precision ball
arithmetic, 2018); nothing is assumed of it.
"""

from __future__ import annotations

from collections.abc import Mapping

from flint import acb, arb

from canon.decide.arbitrary import ChosenFunction
from canon.decide.derivative import substitute
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.tape import Node, Tape, Unsupported

BITS = 96
EVALUATIONS = 20000
RELATIVE, ABSOLUTE = arb(2) ** -48, arb(2) ** -64
FAILURES = (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError)


def enclosed(
    tape: Tape,
    node: Node,
    x: Node,
    ends: tuple[Ball, Ball],
    point: Mapping[Node, Ball],
    functions: Mapping[str, ChosenFunction] | None = None,
) -> Ball | None:
    """The integral of a node over x between two numbers, all else at a point; None where it can't be enclosed.

    It is complex where the node is: the imaginary part of a real node's is rounding alone.
    """
    wanted = without_modulus(tape, node)
    order = tape.reach([wanted])
    if any(tape.ops[i][:2] == ("f", "abs") for i in order):
        return None

    def integrand(z: acb, _analytic: bool) -> acb:
        try:
            return acb(evaluate(tape, order, {**point, x: z}, functions)[wanted])
        except FAILURES:
            return acb("nan")

    with precision(BITS):
        try:
            value = acb.integral(
                integrand,
                acb(ends[0]),
                acb(ends[1]),
                rel_tol=RELATIVE,
                abs_tol=ABSOLUTE,
                eval_limit=EVALUATIONS,
            )
        except FAILURES:
            return None
        if not value.is_finite():
            return None
        return value if tape.is_complex(node) else value.real


def without_modulus(tape: Tape, node: Node) -> Node:
    """The node with √(u²) for |u| of real u, which is analytic wherever u isn't 0 nor imaginary."""
    sizes = [i for i in tape.reach([node]) if tape.ops[i][:2] == ("f", "abs")]
    inner = {i: tape.ops[i][2][0] for i in sizes}
    return substitute(tape, node, {i: tape.sqrt(tape.power(u, 2)) for i, u in inner.items() if not tape.is_complex(u)})
