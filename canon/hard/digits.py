"""Digits kept, and digits that conditioning allows, both measured against fifty digits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

import mpmath as mp

from canon.hard.case import Answer, HardCase, Point, Quantities, quantities
from canon.numeric.precision import UNIT

FULL: Final = -math.log10(UNIT)
"""The digits of a double: 15.95."""

STEP: Final = mp.mpf(10) ** -20
"""The part by which an input is changed to see what the quantity makes of it."""

GUARD: Final = 30
"""Digits beyond those of the case, in which the changes are taken."""


def exactly(case: HardCase, point: Point, digits: int | None = None) -> Quantities:
    """The quantities at a point, in the digits of the case."""
    with mp.workdps(digits or case.digits):
        return quantities(case.reference(mp.mp, *(mp.mpf(x) for x in point)))


def condition(case: HardCase, point: Point) -> tuple[float, ...]:
    """Σ_i |x_i ∂f/∂x_i|/|f| of each quantity f, and 1 at least: by how much relative errors of the inputs grow."""
    with mp.workdps(case.digits + GUARD):
        inputs = [mp.mpf(x) for x in point]
        here = quantities(case.reference(mp.mp, *inputs))
        totals = [mp.mpf(0)] * len(here)
        for i, x in enumerate(inputs):
            if i in case.held or x == 0:
                continue
            moved = quantities(case.reference(mp.mp, *inputs[:i], x * (1 + STEP), *inputs[i + 1 :]))
            for k, (before, after) in enumerate(zip(here, moved, strict=True)):
                totals[k] += length([a - b for a, b in zip(after, before, strict=True)]) / STEP
        return tuple(
            max(1.0, float(total / size)) if (size := length(f)) else 1.0 for total, f in zip(totals, here, strict=True)
        )


def allowed(condition: float) -> float:
    """The digits that an input, rounded once, leaves of a quantity."""
    return max(0.0, FULL - math.log10(condition)) if math.isfinite(condition) else 0.0


def kept(found: Sequence[Any], exact: Sequence[Any]) -> float:
    """The digits of a vector: −log₁₀ |found − exact|/|exact|, from 0 to those of a double."""
    if len(found) != len(exact) or not all(_is_finite(x) for x in found):
        return 0.0
    off = length([mp.mpf(a) - b for a, b in zip(found, exact, strict=True)])
    size = length(exact)
    if off == 0:
        return FULL
    return min(FULL, max(0.0, float(-mp.log10(off / size)))) if size else 0.0


def holds(answer: Answer, exact: Quantities) -> bool | None:
    """Whether the bounds of an answer contain the truth; None where it states none."""
    if answer.bounds is None:
        return None
    pairs = zip(answer.values, answer.bounds, exact, strict=True)
    return all(
        length([mp.mpf(a) - b for a, b in zip(value, true, strict=True)]) <= bound for value, bound, true in pairs
    )


def length(vector: Sequence[Any]) -> Any:
    """√Σ|x|²."""
    return mp.sqrt(mp.fsum([abs(x) ** 2 for x in vector]))


def _is_finite(x: Any) -> bool:
    try:
        return not isinstance(x, complex) and math.isfinite(float(x))
    except (TypeError, ValueError, OverflowError):
        return False
