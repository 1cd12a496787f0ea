"""Numbers of formulas at exact points, as many bits as they need: sums that cancel, factors that overflow."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, Final

import sympy as sp

from canon.errors import InputError
from canon.expected import formula_of, table
from canon.numeric.actions.balls import Ball, ball_function, ball_of, precision
from canon.numeric.actions.bounded import Bounded, bounded

PRECISIONS: Final = (128, 256, 1024, 4096, 16384)
ENOUGH: Final = 58
"""Bits that a value is wanted to: more than a double holds."""


def value_at(expression: Any, point: Mapping[sp.Symbol, Any]) -> Bounded:
    """The value of a formula where its symbols are these numbers, each exactly as it is given.

    It is computed in balls, whose precision is doubled until the value is known to all digits of a double. So neither
    sums that cancel nor factors beyond the range of doubles cost any: what conditioning takes is in the numbers of the
    point, which are taken as exact. The bound contains the truth whatever was lost.

    **Raises:** `InputError` for a symbol without a number, and where the formula has no finite value.
    """
    expression = formula_of(expression, "expression")
    table(point, "numbers", "point")
    symbols = tuple(point)
    function = ball_function(expression, symbols)
    numbers = [ball_of(number, "point") for number in point.values()]
    return in_enough_bits(lambda: function(*numbers), "the formula")


def in_enough_bits(compute: Callable[[], Ball], text: str) -> Bounded:
    """What `compute` gives, with more bits until it is known to those of a double.

    **Raises:** `InputError` where it isn't finite.
    """
    ball: Any = None
    for bits in PRECISIONS:
        with precision(bits):
            ball = compute()
            if ball.is_finite() and (ball.rel_accuracy_bits() >= ENOUGH or ball.is_zero()):
                return in_doubles(ball, text)
    if not ball.is_finite():
        raise InputError(f"{text} has no finite value at this point", "point")
    with precision(PRECISIONS[-1]):
        return in_doubles(ball, text)


def in_doubles(ball: Ball, text: str) -> Bounded:
    """A finite ball as a double with its bound. **Raises:** `InputError` where it is beyond the range of doubles."""
    found = bounded(ball)
    if not math.isfinite(found.value):
        raise InputError(f"{text} is about {ball.str(3, radius=False)}, beyond the range of doubles", "point")
    return found
