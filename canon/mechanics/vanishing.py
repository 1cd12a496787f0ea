"""Whether an expression is exactly 0: by normal form for "yes", by balls at a point for "no".

What a claim says is decided above, in `canon.decide`; this serves the values of this floor, which are verified when
they are made.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Final

import sympy as sp
from flint import arb
from sympy.core.function import AppliedUndef

from canon.ball_precision import precision
from canon.mechanics.multiplied import counted
from canon.mechanics.numerator import Numerator
from canon.mechanics.principal_values import ball_of
from canon.sign import declared

BITS: Final = (128, 1024, 8192)
FEW: Final = 2_000
"""So many terms are multiplied out in a fraction of a second."""


def vanishes(expression: Any) -> bool | None:
    """Whether an exact expression is 0 wherever it is defined: True and False are proofs, None says it isn't known.

    False says that it isn't 0 at some values of its names that their assumptions allow.
    """
    if expression.is_Rational:
        return expression == 0
    if expression.has(sp.Float, AppliedUndef, sp.Derivative, sp.Integral, sp.Piecewise):
        return None
    values = list(_places(expression))
    if any(_excludes_zero(expression, there, BITS[0]) for there in values):
        return False
    numerator = Numerator.of(expression)
    if numerator is not None and any(_is_defined(expression, there) for there in values):
        if numerator.value == 0:
            return True
        bound = None if expression.free_symbols else numerator.bound()
        if bound is not None:
            return _by_bound(numerator, bound)
    if any(_excludes_zero(expression, there, BITS[1]) for there in values[:1]):
        return False
    return None


def vanishes_multiplied_out(expression: Any) -> bool | None:
    """The same, where the answer may show only when all is multiplied out, arguments of functions too; which is done
    where that has few terms."""
    found = vanishes(expression)
    if found is not None or any(terms > FEW for _, terms in counted(expression)):
        return found
    return vanishes(sp.expand(expression))


def sign_at_a_point(expression: Any) -> int | None:
    """1 or −1, the certified sign of a real expression at values of its names that are allowed; None: it isn't known.

    Of a number that is its sign.
    """
    for there in _places(expression):
        for bits in BITS[:2]:
            ball = ball_of(expression, there, bits)
            if ball is not None and ball.imag.contains(0) and not ball.real.contains(0):
                return 1 if ball.real > 0 else -1
    return None


def _excludes_zero(expression: Any, values: Mapping[Any, Any], bits: int) -> bool:
    found = ball_of(expression, values, bits)
    return found is not None and not found.contains(0)


def _is_defined(expression: Any, values: Mapping[Any, Any]) -> bool:
    return ball_of(expression, values, BITS[0]) is not None


def _places(expression: Any) -> Iterator[dict[Any, Any]]:
    """A few values of the names, such as their assumptions allow; the last ones are small."""
    names = sorted(expression.free_symbols, key=str)
    for shift in range(5 if names else 1):
        found: dict[Any, Any] = {}
        for k, name in enumerate(names):
            sign = -1 if (k + shift) % 2 else 1
            size = 1 if shift < 3 else 40 * (1 + k)
            fraction = sp.Rational(sign * (7 + 4 * k + shift), (5 + 2 * shift) * size)
            whole = sp.Integer(sign * (2 + k + shift))
            number = next((n for n in (fraction, -fraction, whole, -whole, sp.S.Zero) if _allows(name, n)), None)
            if number is None:
                return
            found[name] = number
        yield found


def _allows(name: Any, number: Any) -> bool:
    return all(getattr(number, f"is_{word}", None) is value for word, value in declared(name).items())


def _by_bound(numerator: Numerator, bound: arb) -> bool | None:
    for bits in BITS:
        ball = numerator.ball(bits)
        if ball is None:
            return None
        if not ball.contains(0):
            return False
        with precision(bits):
            if ball.abs_upper() < bound:
                return True
    return None
