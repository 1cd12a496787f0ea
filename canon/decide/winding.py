"""How often a closed curve in a plane goes round a point, certified by balls.

The curve is covered by pieces, each of which lies in an open half-plane that doesn't contain the point on its edge;
the argument's change along a piece is then the principal argument of the ratio of its ends. A curve that is gone round
k times has a winding number divisible by k round every point.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from flint import acb, arb

from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.tape import Node, Tape, Unsupported

BITS = 64
PIECES = 32
MOST_PIECES = 1024
FAILURES = (OutOfDomain, Unsupported, ZeroDivisionError, OverflowError)


def winding_number(
    tape: Tape, plane: Sequence[Node], moving: Node, period: Node, point: Mapping[Node, Fraction]
) -> int | None:
    """The winding number of the curve traced by two nodes while `moving` grows by a period, round the middle of it.

    **Arguments:** `point`, exact values of every symbol; the curve starts at its value of `moving`.

    **Returns:** None where the curve can't be covered, or isn't closed as far as balls show.
    """
    order = tape.reach([*plane, period])
    with precision(BITS):
        start = {node: arb(rational(value)) for node, value in point.items()}
        try:
            length = evaluate(tape, tape.reach([period]), start)[period]

            def at(low: Fraction, high: Fraction) -> acb:
                share = arb(rational((low + high) / 2), rational((high - low) / 2))
                values = evaluate(tape, order, {**start, moving: start[moving] + share * length})
                return acb(values[plane[0]], values[plane[1]])

            centre = _centre([at(Fraction(k, PIECES), Fraction(k, PIECES)) for k in range(PIECES)])
            total = _turned(at, centre)
        except FAILURES:
            return None
        if total is None:
            return None
        turns = (total / (2 * arb.pi())).unique_fmpz()
        return None if turns is None else int(turns)


def _centre(points: Sequence[Ball]) -> acb:
    count = len(points)
    return acb(
        arb(sum(float(z.real.mid()) for z in points) / count), arb(sum(float(z.imag.mid()) for z in points) / count)
    )


def _turned(at, centre: acb) -> Ball | None:
    """The whole change of the argument, or None where the pieces become too many."""
    pieces = [(Fraction(k, PIECES), Fraction(k + 1, PIECES)) for k in reversed(range(PIECES))]
    total, used = arb(0), 0
    while pieces:
        low, high = pieces.pop()
        used += 1
        if used > MOST_PIECES:
            return None
        first, last = at(low, low) - centre, at(high, high) - centre
        whole = (at(low, high) - centre) / first
        if whole.is_finite() and whole.real > 0:
            total += (last / first).arg()
            continue
        middle = (low + high) / 2
        pieces += [(middle, high), (low, middle)]
    return total
