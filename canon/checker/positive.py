"""Is a formula positive for all values that its names may have? A number that is, or what has a sign by rules."""

from __future__ import annotations

from canon.checker.bounded import is_positive_between
from canon.checker.intervals import Intervals, Open
from canon.checker.shapes import is_product_of_nonzeros
from canon.checker.signs import Signs
from canon.checker.statement import Statement

PRECISIONS = (40, 120, 400)


def is_positive(s: Statement, a: int, *, strict: bool, real: bool) -> bool:
    """True where it is shown: a number that is, or a formula with a sign. Not `strict`: it may be 0 somewhere.

    It speaks of points at which the formula, with its roots and denominators, has a real value.
    """
    f = s.f
    if not real:
        return False
    names = {f.ops[b][1] for b in f.reach(a) if f.ops[b][0] == "s"} - {"pi"}
    if not names and not any(f.ops[b][1] in f.functions for b in f.reach(a) if f.ops[b][0] == "f"):
        return _number(s, a, strict=strict)
    return Signs(s).is_positive(a, strict=strict) or is_positive_between(s, a)


def _number(s: Statement, a: int, *, strict: bool) -> bool:
    """A number's interval."""
    for digits in PRECISIONS:
        try:
            if Intervals(digits).values(s.f, [a], {})[a].a > 0:
                return True
        except Open:
            continue
    return not strict and s.f.value(a) == 0


def is_nowhere_zero(s: Statement, a: int) -> bool:
    """Whether a formula is seen to be 0 nowhere: to have one sign, or to be a product of what isn't 0."""
    return is_product_of_nonzeros(s, a) or Signs(s).is_nowhere_zero(a)
