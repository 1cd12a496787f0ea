"""Zeros and poles of R = D/(dx/dq)², or of what a period has in its place, for a momentum's square D."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from canon.checker.charts import Chart
from canon.checker.formulas import ONE
from canon.checker.momentum import Square
from canon.checker.rational import Factor, NoForm, Rational
from canon.checker.statement import Statement


class Zero(NamedTuple):
    """A zero or a pole of R with its exponent; `turns` tells whether D vanishes there and so an orbit may end."""

    at: int
    k: int
    turns: bool


def branch_points(
    s: Statement, r: Rational, chart: Chart, q: str, square: Square, is_outside: Callable[[int], bool], *, rate: bool
) -> tuple[int, list[Zero], Factor | None]:
    """R as a product: its coefficient, its zeros and poles, and a quadratic factor of D whose zeros aren't known.

    An orbit ends at a simple zero of D inside of the range of x. Raises NoForm.
    """
    f, D = s.f, chart.moved(s, square.D, q)
    slope = chart.moved(s, f.mul(f.number("1/2"), square.slope), q)
    lead, zeros, quadratic = ONE, list[Zero](), list[Factor]()
    ends = r.factors(chart.moved(s, square.turning, q))[1]
    turning = [x for p, e in ends.items() if e > 0 for x in r.zeros(p)[1]]
    for a, times in [*([(slope, 2), (D, -1)] if rate else [(D, 1)]), (chart.pace, -1)]:
        c, factors = r.factors(a)
        lead = f.mul(lead, f.power(c, f.number(times)))
        for p, e in factors.items():
            first, found, rest = r.zeros(p)
            lead = f.mul(lead, f.power(first, f.number(e * times)))
            zeros += [Zero(x, e * times, a == D and e > 0) for x in found]
            if rest != (ONE,):
                if len(rest) != 3 or abs(e) != 1 or a != D or quadratic:
                    raise NoForm
                quadratic.append(rest)
    walls = [end for end in (chart.low, chart.high) if end is not None]
    if any(z.turns and r.is_zero(f.sub(z.at, end)) for z in zeros for end in walls):
        raise NoForm
    kept = [z._replace(turns=z.turns and not is_outside(z.at)) for z in zeros]
    return lead, _merged(r, kept, turning), quadratic[0] if quadratic else None


def _merged(r: Rational, zeros: Sequence[Zero], turning: Sequence[int]) -> list[Zero]:
    """Equal ones once; a double zero of D ends no orbit that has a period."""
    found = list[Zero]()
    for z in zeros:
        same = next((i for i, y in enumerate(found) if r.is_zero(r.f.sub(y.at, z.at))), None)
        if same is None:
            found.append(z)
            continue
        if found[same].turns or z.turns:
            raise NoForm
        found[same] = Zero(z.at, z.k + found[same].k, False)
    if any(z.turns and abs(z.k) != 1 for z in found):
        raise NoForm
    real = [z.turns and any(r.is_zero(r.f.sub(z.at, x)) for x in turning) for z in found]
    return [z._replace(turns=turns) for z, turns in zip(found, real, strict=True) if z.k]
