"""A number with a bound of its error."""

from __future__ import annotations

import math
from dataclasses import dataclass

from flint import arb

from canon.display import text_in_html
from canon.numeric.actions.balls import Ball


@dataclass(frozen=True, slots=True)
class Bounded:
    """A `value` in double precision, and a `bound` of how far it is from what it stands for, rounding included."""

    value: float
    bound: float

    def __float__(self) -> float:
        return self.value

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        if self.bound == 0:
            return f"{self.value!r} exactly"
        return f"{self.value!r} ± {self.bound:.1e}"


def bounded(ball: Ball) -> Bounded:
    """The double next to the middle of a ball, with a bound of its distance from anything in it."""
    value = float(ball.mid())
    if not math.isfinite(value):  # that of a ball beyond the range of doubles is infinite, and infinitely far from it
        return Bounded(value, math.inf if ball.is_finite() else 0.0)
    far = (ball - arb(value)).abs_upper()
    bound = float(far)
    return Bounded(value, math.nextafter(bound, math.inf) if bound or not far.is_zero() else 0.0)
