"""Taylor's method to any precision, for references: Hamilton's equations by series whose coefficients are balls.

Each step's series is summed as far as its precision asks for; then midpoints are taken, so that the result is a number
and no enclosure. What it is worth is told by a second run with fewer bits. Jorba and Zou, Experimental Mathematics 14
(2005) 99.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Final

import flint
import numpy as np
import sympy as sp
from flint import arb, arb_series

from canon.errors import BudgetExceeded, InputError
from canon.numeric.actions.balls import exact_number, precision, product, program_of
from canon.turns import in_turn

Series = Any  # flint.arb_series; the package has no type stubs
Rule = Callable[[list[Series]], Series]
Program = Callable[[Sequence[Series]], list[Series]]

FINE: Final = (34, 26)
"""Digits of the two runs: what they differ by is the error of the second, and the first is far better."""
GUARD: Final = 10
_DIRECT: Final[dict[Any, str]] = {
    sp.exp: "exp", sp.log: "log", sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.atan: "atan", sp.asin: "asin",
    sp.acos: "acos",
}  # fmt: skip


class NoSeries(InputError):
    """A formula has a function whose Taylor series this module does not know."""


def flow(
    rates: Sequence[Any], symbols: Sequence[Any], clock: Any, start: Sequence[float], span: tuple[float, float],
    *, digits: int, deadline: float = math.inf,
) -> list[Any]:  # fmt: skip
    """The state (N,) at the end of ẋ = f(x, t), as balls that are nearly points.

    **Arguments:** `rates` (N,), formulas in `symbols` (N,) and the time `clock`; `start` (N,), taken exactly; `span`,
    the times of the beginning and the end; `digits` that each step keeps; `deadline`, on `time.monotonic`.

    **Raises:** `NoSeries` for a formula that has none here; `BudgetExceeded` after the deadline, or where steps become
    too short.
    """
    rule = program_of(rates, (*symbols, clock), _rule)
    order = math.ceil(1.15 * digits) + 4
    begin, end = span
    with precision(math.ceil((digits + GUARD) * math.log2(10))), _cap(order):
        x, t, sign = [arb(float(value)) for value in start], arb(begin), 1 if end >= begin else -1
        while sign * (arb(end) - t) > 0:
            if time.monotonic() > deadline:
                raise BudgetExceeded("the reference took longer than it was given")
            series = _series(rule, x, t, order)
            h = _step(series, order, digits)
            if not h > 1e-12 * max(abs(end - begin), 1e-300):
                raise BudgetExceeded("steps of the reference become too short: is there a singularity?")
            left = arb(end) - t
            h = arb(h * sign) if h < abs(float(left)) else left
            x, t = [_sum(coefficients, h) for coefficients in series], (t + h).mid()
        return x


def reference(
    rates: Sequence[Any], symbols: Sequence[Any], clock: Any, start: Sequence[float], span: tuple[float, float],
    *, seconds: float,
) -> tuple[np.ndarray, float]:  # fmt: skip
    """The end state (N,) in double precision, and how far it is off, relative to the largest component.

    **Raises:** as `flow`; `BudgetExceeded` where the two runs do not agree to double precision.
    """
    deadline = time.monotonic() + seconds
    coarse, fine = (
        flow(rates, symbols, clock, start, span, digits=digits, deadline=deadline) for digits in reversed(FINE)
    )
    size = max(abs(float(value)) for value in fine) or 1.0
    off = max(abs(float(a - b)) for a, b in zip(coarse, fine, strict=True)) / size
    if not off < 1e-13:
        raise BudgetExceeded(f"the orbit is so sensitive that references with {FINE[1]} and {FINE[0]} digits differ")
    return np.array([float(value) for value in fine]), off


@contextmanager
def _cap(order: int) -> Iterator[None]:
    """The length of series, which is global to the process, set in turn and put back."""
    with in_turn():
        before = flint.ctx.cap
        flint.ctx.cap = order + 1
        try:
            yield
        finally:
            flint.ctx.cap = before


def _series(rule: Program, x: list[Any], t: Any, order: int) -> list[list[Any]]:
    """Coefficients 0 … order of the solution through x at t, each from those before it."""
    coefficients = [[value] for value in x]
    for k in range(order):
        flint.ctx.cap = k + 1
        now = [arb_series(row, k + 1) for row in coefficients]
        rates = rule([*now, arb_series([t, 1], k + 1)])
        for row, rate in zip(coefficients, rates, strict=True):
            found = rate.coeffs() if isinstance(rate, arb_series) else [arb(rate)]
            row.append((found[k] if k < len(found) else arb(0)) / (k + 1))
    flint.ctx.cap = order + 1
    return coefficients


def _step(series: list[list[Any]], order: int, digits: int) -> float:
    """The step for which the last terms are below the wanted part of the largest component."""
    size = max(max(abs(float(row[0])) for row in series), 1e-300)
    best = math.inf
    for k in (order - 1, order):
        term = max(abs(float(row[k])) for row in series)
        if term > 0:
            best = min(best, math.exp((math.log(size) - digits * math.log(10) - math.log(term)) / k))
    return best


def _sum(coefficients: list[Any], h: Any) -> Any:
    total = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        total = total * h + coefficient
    return total.mid()


def _rule(part: Any, at: list[int]) -> Rule:
    if isinstance(part, (sp.Rational, sp.Float)):
        exact = exact_number(part)
        return lambda row: arb_series([exact])
    if part is sp.pi:
        return lambda row: arb_series([arb.pi()])
    if part is sp.E:
        return lambda row: arb_series([arb.const_e()])
    if isinstance(part, sp.Add):
        return lambda row: sum((row[k] for k in at[1:]), start=row[at[0]])
    if isinstance(part, sp.Mul):
        return lambda row: product([row[k] for k in at])
    if isinstance(part, sp.Pow):
        return _power(part, at)
    if part.func in _DIRECT:
        name = _DIRECT[part.func]
        return lambda row: getattr(row[at[0]], name)()
    if isinstance(part, (sp.sinh, sp.cosh, sp.tanh)):
        return _hyperbolic(part.func, at[0])
    raise NoSeries(f"{part.func} has no Taylor series here")


def _power(part: Any, at: list[int]) -> Rule:
    base, exponent = at
    power = part.exp
    if power.is_Integer and abs(power) < 1000:
        n = int(power)
        return (lambda row: row[base] ** n) if n > 0 else (lambda row: (row[base] ** -n).inv())
    if power.is_Rational and power.q == 2 and abs(power.p) < 1000:
        odd = int(power.p)
        return (lambda row: row[base].sqrt() ** odd) if odd > 0 else (lambda row: row[base].rsqrt() ** -odd)
    return lambda row: (row[base].log() * row[exponent]).exp()


def _hyperbolic(function: Any, at: int) -> Rule:
    def rule(row: list[Series]) -> Series:
        up, down = row[at].exp(), (-row[at]).exp()
        if function is sp.sinh:
            return (up - down) / 2
        return (up + down) / 2 if function is sp.cosh else (up - down) / (up + down)

    return rule
