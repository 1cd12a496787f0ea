"""Is a formula of one name positive between two numbers? Piece by piece, in intervals.

On a piece with the middle c a formula g lies in g(c) + g'(piece) (piece − c), by the mean value; a piece on which this
isn't positive is halved.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from canon.checker.formulas import Formulas
from canon.checker.intervals import Intervals, Open
from canon.checker.statement import Statement

DIGITS, PIECES, LOOKED = 30, 2000, 16
NARROWEST = 2**22
"""A piece isn't made narrower than the whole by so much: where the formula comes near 0, nothing is said."""


def _bounds(s: Statement, x: str) -> tuple[Fraction | None, Fraction | None]:
    """Numbers between which the domain says that a name lies."""
    f, low, high = s.f, list[Fraction](), list[Fraction]()
    if {*s.words.get(x, ())} & {"positive", "nonnegative"}:
        low.append(Fraction(0))
    for a, kind in s.conditions:
        names = {f.ops[b][1] for b in f.reach(a) if f.ops[b][0] == "s"}
        slope = f.value(f.slope(a, x)) if kind == "positive" and names == {x} else None
        rest = f.value(f.substitute(a, {x: f.number(0)})) if slope else None  # a slope that is a number has no pole
        if slope and rest is not None:
            (low if slope > 0 else high).append(-rest / slope)
    return max(low, default=None), min(high, default=None)


def is_positive_between(s: Statement, a: int) -> bool:
    """Whether a formula of one name, which the domain bounds by numbers, is positive between these and at them."""
    f = s.f
    names = {f.ops[b][1] for b in f.reach(a) if f.ops[b][0] == "s"} - {"pi"}
    if len(names) != 1 or names & {"1j"} or any(f.ops[b][1] in f.functions for b in f.reach(a) if f.ops[b][0] == "f"):
        return False
    (x,) = names
    low, high = _bounds(s, x)
    if low is None or high is None or not low < high:
        return False
    own, slope, left, least = Intervals(DIGITS, closed=True), f.slope(a, x), [(low, high)], (high - low) / NARROWEST
    try:
        for k in range(LOOKED + 1):  # where it isn't, this is seen soon
            at = own.number(low + (high - low) * k / LOOKED)
            if not own.values(f, [a], {x: at})[a].a > 0:
                return False
    except Open:
        return False
    for _ in range(PIECES):
        if not left:
            return True
        start, end = left.pop()
        middle = (start + end) / 2
        piece = own.iv.mpf([own.number(start).a, own.number(end).b])
        if not _is_positive_on(own, f, a, slope, x, piece, own.number(middle)):
            if end - start < least:
                return False
            left += [(start, middle), (middle, end)]
    return not left


def _is_positive_on(own: Intervals, f: Formulas, a: int, slope: int, x: str, piece: Any, middle: Any) -> bool:
    try:
        own.values(f, [a], {x: piece})  # no jump is in it, which a slope wouldn't tell
        value = own.values(f, [a], {x: middle})[a] + own.values(f, [slope], {x: piece})[slope] * (piece - middle)
    except Open:
        return False
    return bool(value.a > 0)
