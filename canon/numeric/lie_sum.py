"""Lie series in numbers: brackets nested to any order at a point, and exp(s {·, G}) f with the series' radius.

Along the flow of G every function obeys df/ds = {f, G}, so that the nested brackets at a point are k! times Taylor's
coefficients of f along the flow through it. These are found by Picard's iteration on power series in balls, order by
order, without a formula of any bracket. Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, III.5;
Jorba and Zou (2005), Experiment. Math. 14, 99, for the step and the radius.

Conditioning: that of the flow itself, as digits that cancel are computed in more bits. The series of a point converges
within the distance to the flow's nearest singularity in complex time, `radius`; beyond a quarter of it the sum is taken
in pieces, each about a point further on, so that s near that radius, or beyond it, costs no digits as long as the flow
itself goes there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any, Final

import flint
import sympy as sp
from flint import arb, arb_series

from canon.errors import InputError
from canon.expected import finite_number, formula_of, instance_of, listed, shown, table, whole_number
from canon.numeric.actions.balls import Ball, ball_function, ball_of, precision
from canon.numeric.actions.bounded import Bounded
from canon.numeric.values import in_doubles, in_enough_bits

ORDER: Final = 40
DEEPEST: Final = 500
"""The most brackets in each other: the time grows as the fourth power of their number, some seconds here."""
PART: Final = 0.25
"""The part of the radius within which a series is summed."""

MOST_PIECES: Final = 2000
BITS: Final = (192, 512, 2048)
ENOUGH: Final = 56
SMALLEST: Final = 1e-18
"""The part of the first radius below which a piece shows that the flow runs into a singularity."""

SAFETY: Final = 8.0


@dataclass(frozen=True)
class LieSum:
    """exp(s {·, G}) f at a point: its `value`, and the `radius` of convergence of the series there.

    The radius is an estimate from the coefficients, infinite for a series that ends or converges everywhere; `pieces`
    is the number of points about which the series was summed. The value's bound holds all rounding, and an estimate of
    what was left off; it is infinite where the flow ends before s.
    """

    value: Bounded
    radius: float
    pieces: int

    def within(self, s: float) -> bool:
        """Whether the plain series converges at s, by the estimated radius."""
        finite_number(s, "s")
        return abs(s) < self.radius

    def __str__(self) -> str:
        how = "once" if self.pieces == 1 else f"in {self.pieces} pieces"
        return f"{self.value}, summed {how}; the series converges for |s| below about {self.radius:.3g}"


def nested_bracket(
    f: Any, G: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], at: Mapping[Any, Any], k: int
) -> Bounded:
    """{…{{f, G}, G}, …, G}, nested k deep, at a phase point, to all digits of a double.

    **Arguments:** formulas `f` and `G` of `q` and `p`; `at`, exact numbers for these.

    **Raises:** `InputError` where f or a derivative of G has no value there.
    """
    k = whole_number(k, "k", 0, DEEPEST)
    flow = _Flow(f, G, q, p)
    start = flow.point(at)

    def compute() -> Ball:
        coefficients = flow.coefficients([ball_of(x) for x in start], k)[0]
        return coefficients[k] * arb(k).gamma() * k if k else coefficients[0]

    return in_enough_bits(compute, f"the bracket of order {k}")


def lie_sum(f: Any, G: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], at: Mapping[Any, Any], s: Any) -> LieSum:
    """exp(s {·, G}) f at a phase point: f along the flow of G, a time s later. Arguments as for `nested_bracket`.

    **Raises:** `InputError` where f or a derivative of G has no value at the point.
    """
    flow = _Flow(f, G, q, p)
    start, s = flow.point(at), formula_of(s, "s")
    if not s.is_real or not s.is_finite:
        raise InputError(f"a finite number is needed, not {shown(s)}", "s")
    found: LieSum | None = None
    for bits in BITS:
        with precision(bits):
            ball, radius, pieces = flow.summed([ball_of(x) for x in start], ball_of(s))
            value = in_doubles(ball, "the sum") if ball.is_finite() else Bounded(float(ball.mid()), inf)
            found = LieSum(value, radius, pieces)
            if not ball.is_finite() or ball.rel_accuracy_bits() >= ENOUGH:
                break
    assert found is not None
    return found


class _Flow:
    """f and Hamilton's equations of G as functions of balls and of power series in balls."""

    def __init__(self, f: Any, G: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> None:
        f, G = formula_of(f, "f"), formula_of(G, "G")
        self.variables = (*listed(q, "symbols", "q"), *listed(p, "symbols", "p"))
        for x in self.variables:
            instance_of(x, sp.Symbol, "q, p")
        rates = [G.diff(y) for y in p] + [-G.diff(x) for x in q]
        self.rates = [ball_function(rate, self.variables) for rate in rates]
        self.f = ball_function(f, self.variables)

    def point(self, at: Any) -> list[Any]:
        """The numbers of a phase point. **Raises** `InputError` where one is missing."""
        table(at, "numbers", "at")
        for x in self.variables:
            if x not in at:
                raise InputError(f"a number for {x} is missing", "at")
        for x in self.variables:
            ball_of(at[x], f"at, {x}")
        return [at[x] for x in self.variables]

    def coefficients(self, start: Sequence[Ball], order: int) -> list[list[Ball]]:
        """Taylor's coefficients, up to the order, of f and of each variable along the flow."""
        before = flint.ctx.cap
        try:
            z = [arb_series([x], 1) for x in start]
            for n in range(1, order + 1):
                flint.ctx.cap = n + 1
                moved = [arb_series(rate(*z)).integral() for rate in self.rates]
                z = [arb_series([x], n + 1) + path for x, path in zip(start, moved, strict=True)]
            flint.ctx.cap = order + 1
            return [_padded(series, order) for series in (arb_series(self.f(*z)), *z)]
        finally:
            flint.ctx.cap = before

    def summed(self, start: list[Ball], s: Ball) -> tuple[Ball, float, int]:
        """f after s, the radius at the start, and the number of pieces."""
        left, first = s, None
        for piece in range(1, MOST_PIECES + 1):
            f, *z = self.coefficients(start, ORDER)
            if not all(x.is_finite() for row in (f, *z) for x in row):
                if piece == 1:
                    raise InputError("the function, or a derivative of G, has no value at this point", "point")
                return arb("nan"), first or inf, piece
            radius = min(radius_of(row) for row in z)
            own = min(radius, radius_of(f))
            first = own if first is None else first
            reach = PART * own
            if abs(left) <= reach:
                return _sum(f, left, own), first, piece
            step = arb(reach) if left > 0 else -arb(reach)
            if not reach > SMALLEST * first:  # the flow ends here
                return arb("nan"), first, piece
            start = [_sum(row, step, own) for row in z]
            left = left - step
        return arb("nan"), first or inf, MOST_PIECES


def radius_of(coefficients: Sequence[Ball]) -> float:
    """The radius of convergence by the largest |a_k| near the end and near the middle; infinite where all vanish."""
    sizes = [float(abs(a).mid()) for a in coefficients]
    n = len(sizes) - 1
    late = [(sizes[k], k) for k in range(n - n // 4, n + 1) if sizes[k] > 0]
    early = [(sizes[k], k) for k in range(n // 2 - n // 4, n // 2 + 1) if sizes[k] > 0]
    if not late or not early:
        return inf
    (a, i), (b, j) = max(early), max(late)
    return float((a / b) ** (1 / (j - i)))


def _sum(coefficients: Sequence[Ball], s: Ball, radius: float) -> Ball:
    """Σ a_k s^k, with what is left off, as of a geometric series, in the ball's radius."""
    total = arb(0)
    for a in reversed(coefficients):
        total = total * s + a
    size = abs(s)
    last = max((float(abs(a).upper() * size**k) for k, a in list(enumerate(coefficients))[-4:]), default=0.0)
    part = min(float(size.upper()) / radius, 0.5) if isfinite(radius) else 0.5
    return total + arb(0, SAFETY * last * part / (1 - part))


def _padded(series: Any, order: int) -> list[Ball]:
    found = series.coeffs()
    return [*found, *([arb(0)] * (order + 1 - len(found)))]
