"""Where whole numbers are compared by `>=`: what is positive exactly where a difference isn't negative.

Claims speak of the open part of a domain, so that `>=` says as much as `>` wherever the edge has no inner point. Among
whole numbers it has: n >= 1 is so at n = 1, and no other value is near. There the edge belongs to the domain.
"""

from __future__ import annotations

from math import lcm, prod
from typing import Any, Final

import sympy as sp

from canon.errors import InputError

__all__ = ["at_least_zero"]

MOST: Final = 100
"""The largest exponent of what has a denominator."""

PLACE: Final = sp.Rational(3, 7)
"""Of a coordinate along its axis."""


def at_least_zero(difference: sp.Expr, written: str) -> sp.Expr:
    """What is positive where a difference of the sides of `>=` isn't negative, up to what has no inner point.

    A polynomial e in whole numbers alone with values in ℤ/d is at least 0 if and only if 2 d e + 1 > 0. What also has
    other names is left as it is if its zeros have no inner point whatever the whole numbers are.

    **Raises:** `InputError` for `written`, the text, where neither is seen.
    """
    whole = {s for s in difference.free_symbols if s.is_integer}
    if not whole:
        return difference
    if whole == difference.free_symbols:
        d = _denominator(difference)
        if d is not None:
            return 2 * d * difference + 1
    elif _is_free_somewhere(difference, whole):
        return difference
    raise InputError(
        f"{written} has whole numbers in it, and its sides may be equal all over a part of the domain: write it with "
        "< or >, and what is claimed where they are equal in a file of its own"
    )


def _denominator(e: Any) -> int | None:
    """A number d for which d e is whole for all whole numbers; None for what isn't seen to be a polynomial in them."""
    if isinstance(e, sp.Rational):
        return int(e.q)
    if isinstance(e, sp.Symbol):
        return 1
    if isinstance(e, sp.Abs | sp.sign):
        return _denominator(e.args[0])
    if isinstance(e, sp.Pow):
        base, n = _denominator(e.base), e.exp
        if base is None or not isinstance(n, sp.Integer) or n < 0 or (base > 1 and n > MOST):
            return None
        return base ** int(n)
    if not isinstance(e, sp.Add | sp.Mul):
        return None
    parts = [_denominator(part) for part in e.args]
    known = [d for d in parts if d is not None]
    if len(known) < len(parts):
        return None
    return lcm(*known) if isinstance(e, sp.Add) else prod(known)


def _is_free_somewhere(e: sp.Expr, whole: set[Any]) -> bool:
    """Whether e is seen to be 0 throughout no open set of its other names, for no values of the whole numbers.

    By a derivative that is a number; or, of a polynomial in the other names, by its values along one of their axes, or
    at the origin, without a whole number in them and not 0.
    """
    others = sorted(e.free_symbols - whole, key=str)
    slopes = [e.diff(x) for x in others]
    if any(_is_not_zero(slope) for slope in slopes):
        return True
    if not e.is_polynomial(*others):
        return False
    along = [e.subs({y: PLACE if y is x else 0 for y in others}) for x in [None, *others]]
    return any(_is_not_zero(value) for value in along)


def _is_not_zero(value: Any) -> bool:
    return not value.free_symbols and value.is_zero is False
