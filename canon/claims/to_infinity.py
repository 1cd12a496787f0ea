"""Integrals over infinite ranges, enclosed at a point of the other names: a quadrature and the bound of a tail."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb

from canon.claims.along_a_range import Range
from canon.claims.approach import signs_on
from canon.decide.asymptotic import Ramified
from canon.decide.ball_quadrature import BITS, enclosed
from canon.decide.derivative import substitute
from canon.decide.enclosure import Ball, evaluate
from canon.decide.power_series import Unexpanded
from canon.decide.region import Region
from canon.decide.tails import tail_of
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question

FURTHEST, FURTHEST_WAVE = 36, 11
"""Powers of 2 at which a tail may begin, without and with sines."""
FINE = 2.0**-52


def over_infinity(
    question: Question, span: Range, f: Node, at: Mapping[Node, Ball], point: Mapping[Node, Any]
) -> Ball | None:
    """The integral of a node over an infinite range, all else at a point of rational numbers; None where no bound is
    found."""
    tape, x = question.tape, question.tape.symbol(span.x)
    fixed = {n: tape.number(v) for n, v in point.items() if isinstance(v, Fraction) and n != x}
    node = substitute(tape, f, fixed)
    if tape.support(node) - {x}:
        return None
    mirrored = substitute(tape, node, {x: tape.negative(x)})
    if isinstance(span.low, str) and isinstance(span.high, str):
        parts = [(node, arb(0)), (mirrored, arb(0))]
    elif isinstance(span.high, str):
        parts = [(node, _end(question, span.low, at))]
    else:
        parts = [(mirrored, -_end(question, span.high, at))]
    total = arb(0)
    for integrand, low in parts:
        value = _from(question, integrand, x, low)
        if value is None:
            return None
        total += value
    return total


def _end(question: Question, end: Any, at: Mapping[Node, Ball]) -> Ball:
    node = question.load(end)
    return evaluate(question.tape, question.tape.reach([node]), at)[node]


def _from(question: Question, node: Node, x: Node, low: Ball) -> Ball | None:
    """The integral of a formula of x from a number to infinity."""
    tape = question.tape
    s = tape.symbol(sp.Dummy("s", positive=True))
    try:
        tail = tail_of(tape, node, x, s, signs_on(question, Region((), (), ())))
    except (Unexpanded, Ramified, Unsupported, InputError):
        return None
    best: tuple[float, int, Ball] | None = None
    for k in range(3, (FURTHEST_WAVE if _waves(tape, node) else FURTHEST) + 1):
        X = 2**k
        if not arb(X) > low + 1:
            continue
        beyond = tail.beyond(X, BITS)
        if beyond is None or not beyond.is_finite():
            continue
        size = float(beyond.rad())
        if best is None or size < best[0]:
            best = (size, X, beyond)
        if size < FINE:
            break
    if best is None:
        return None
    near = enclosed(tape, node, x, (low, arb(best[1])), {})
    return None if near is None else near + best[2]


def _waves(tape: Tape, node: Node) -> bool:
    return any(tape.ops[i][:2] in (("f", "sin"), ("f", "cos")) for i in tape.reach([node]))
