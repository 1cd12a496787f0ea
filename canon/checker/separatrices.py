"""Actions at a separatrix in closed form: from an end e of the motion to an equilibrium d that it never reaches.

In a chart x of the coordinate R = D/(dx/dq)² is λ (x − e)^±1 (x − d)², maybe with another end o beyond d, or with d at
an end of the chart, where dx/dq is 0 as well. With P > 0 the product of the odd factors √R is √|λ| Y/√P, Y being a
polynomial; so a polynomial N and a constant c with N' P + N P'/2 + c = Y give

    ∫ √R dx = √|λ| (N(d) √P(d) + c ∫ dx/√P),    ∫ dx/√P = π/2 − asin(1 − 2 (d − e)/(o − e)).

They follow from the top coefficient down, as formulas; so the action is one, too, and the claim a residual.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations

from canon.checker.charts import Chart, charts, is_inside
from canon.checker.followed import FAILURES
from canon.checker.formulas import ONE, ZERO
from canon.checker.functions import Unreadable
from canon.checker.momentum import Square
from canon.checker.positive import is_positive
from canon.checker.rational import Factor, NoForm, Rational
from canon.checker.statement import Statement


def separatrix(s: Statement, x: str, square: Square, period: int | None, well: int | None) -> int | None:
    """The action of the one motion with an equilibrium at its end, or over a `period`; None where it isn't seen."""
    found = Rational(s)
    for chart in charts(s, found, x, [square.D]):
        try:
            for value in _Motions(s, found, chart, x, square).actions(period, well):
                return value
        except (NoForm, Unreadable, *FAILURES):
            continue
    return None


class _Motions:
    """Those between zeros of D in one chart."""

    def __init__(self, s: Statement, r: Rational, chart: Chart, q: str, square: Square) -> None:
        if square.turning != square.D or s.surface:
            raise NoForm
        self.s, self.f, self.r, self.chart, self.q = s, s.f, r, chart, q
        D = chart.moved(s, square.D, q)
        self.lead, self.zeros = ONE, list[tuple[int, int]]()
        for a, sign in ((D, 1), (chart.pace, -1)):
            c, factors = r.factors(a)
            self.lead = self.f.mul(self.lead, self.f.power(c, self.f.number(sign)))
            for p, e in factors.items():
                first, zeros = self._zeros(p)
                self.lead = self.f.mul(self.lead, self.f.power(first, self.f.number(e * sign)))
                for z in zeros:
                    self._add(z, e * sign)
        walls = [end for end in chart.mirrors if r.is_zero(self.f.substitute(D, {"#x": end}))]
        self.rest = [*(z for z, k in self.zeros if k == 2), *walls]  # where the motion comes to rest
        self.odd = [(z, k) for z, k in self.zeros if k % 2]
        if len(self.rest) != 1 or len(self.odd) not in (1, 2) or any(k not in (-1, 0, 1, 2) for _, k in self.zeros):
            raise NoForm

    def _add(self, z: int, k: int) -> None:
        for i, (other, before) in enumerate(self.zeros):
            if self.r.is_zero(self.f.sub(other, z)):
                self.zeros[i] = other, before + k
                return
        self.zeros.append((z, k))

    def _zeros(self, p: Factor) -> tuple[int, list[int]]:
        """All zeros, those of a cubic by the one that it has twice. Raises NoForm."""
        f, r = self.f, self.r
        if len(p) == 4:
            d, c, b, a = p
            size = f.sub(f.mul(b, b), f.mul(f.number(3), a, c))
            if not r.is_zero(size):
                twice = f.over(f.sub(f.mul(f.number(9), a, d), f.mul(b, c)), f.mul(f.number(2), size))
                slope = (c, f.mul(f.number(2), b), f.mul(f.number(3), a))
                if r.is_zero(r.at(p, twice)) and r.is_zero(r.at(slope, twice)):
                    once = f.sub(f.mul(f.number(-1), f.over(b, a)), f.mul(f.number(2), twice))
                    return a, [twice, twice, once]
        lead, zeros, rest = r.zeros(p)
        if rest != (ONE,):
            raise NoForm
        return lead, zeros

    def _is_above(self, a: int, b: int) -> bool:
        return is_positive(self.s, self.f.sub(a, b), strict=True, real=True)

    def _is_wall(self, z: int) -> bool:
        return any(self.r.is_zero(self.f.sub(z, end)) for end in self.chart.mirrors)

    # -- which motion ------------------------------------------------------------------------------------

    def actions(self, period: int | None, well: int | None) -> Iterator[int]:
        """The action of a motion that is the only one, or the one about the well. Raises NoForm."""
        (d,) = self.rest
        for (e, k), *other in permutations(self.odd):
            times = self._times(e, k, d, period, [z for z, _ in other], well)
            if times and all(k == 1 for _, k in other):
                yield self._action(e, k, d, [z for z, _ in other], times)

    def _times(self, e: int, k: int, d: int, period: int | None, other: list[int], well: int | None) -> int:
        """How often the motion runs from e to d; 0 where it isn't seen to be the one that is meant."""
        f, chart = self.f, self.chart
        up = self._is_above(d, e)
        low, high = (e, d) if up else (d, e)
        if not (up or self._is_above(e, d)):
            return 0
        for o in other:  # the other end of another motion, on the other side of d
            if not self._is_above(*((o, d) if up else (d, o))):
                return 0
        if chart.pace == ONE:
            about = well is not None and all(self._is_above(*pair) for pair in ((well, low), (high, well)))
            only = well is None and not other and (chart.high if up else chart.low) is None
            return 2 if k == 1 and period is None and (about or only) and self._is_there(low, high) else 0
        beyond = chart.high if up else chart.low
        if well is not None or other or not (self._is_wall(d) or beyond is None):
            return 0
        if k == 1:
            inside = all(self._is_above(*p) for p in (*_pairs(chart.high, e), *_pairs(e, chart.low)))
            return 2 if period is None and inside and self._is_wall(d) and self._is_there(*chart.half) else 0
        if not self._is_wall(e):
            return 0
        if period is None:
            return 4 if self._is_there(*chart.whole) else 0
        same = chart.period is not None and self.r.is_zero(f.sub(period, chart.period))
        return 2 if same and self._is_wall(d) and self._is_there(None, None) else 0

    def _is_there(self, low: int | None, high: int | None) -> bool:
        return is_inside(self.s, self.r, self.q, low, high)

    # -- its integral ------------------------------------------------------------------------------------

    def _action(self, e: int, k: int, d: int, other: list[int], times: int) -> int:
        f, r = self.f, self.r
        up, number = self._is_above(d, e), f.number
        epsilon = number(-1 if other or not up else 1)
        size = f.mul(self.lead, epsilon)  # P is positive between, and R = size · (Y²/P) has to be
        if not is_positive(self.s, size, strict=True, real=True):
            raise NoForm
        negative: list[tuple[int, int]] = [(z, n) for z, n in self.zeros if n == 2]
        P, Y = (epsilon,), (ONE,)
        for z in (e, *other):
            P = r.times(P, (f.mul(number(-1), z), ONE))
        for z in (*(z for z, _ in negative), *([e] if k == 1 else []), *other):
            Y = r.times(Y, (f.mul(number(-1), z), ONE))
        at = [*Y, ZERO], [*P, ZERO, ZERO]
        N, constant = self._reduced(at[0], at[1], len(Y) - 1, quadratic=bool(other))
        value = f.mul(r.at(N, d), f.power(r.at(P, d), number("1/2")))
        if other and constant != ZERO:
            part = f.sub(ONE, f.mul(number(2), f.over(f.sub(d, e), f.sub(other[0], e))))
            angle = f.sub(f.mul(f.node("s", "pi"), number("1/2")), f.call("asin", [], [part]))
            value = f.add(value, f.mul(constant, angle if up else f.mul(number(-1), angle)))
        # Y between e and d: its factors x − e and x − o, x − d have these signs
        below = (len(negative) if up else 0) + (k == 1 and not up) + (len(other) if up else 0)
        sign = (-1) ** below * (1 if up else -1)
        return f.mul(number(sign * times), f.power(size, number("1/2")), value)

    def _reduced(self, Y: list[int], P: list[int], degree: int, *, quadratic: bool) -> tuple[list[int], int]:
        """N and c with N' P + N P'/2 + c = Y, from the top coefficient down."""
        f, number = self.f, self.f.number
        N = [ZERO] * (degree + 3)

        def rest(j: int) -> int:
            first = f.mul(number(j + 1), P[0], N[j + 1])
            second = f.mul(f.over(number(2 * j + 1), number(2)), P[1], N[j]) if quadratic else ZERO
            return f.sub(Y[j], f.add(first, second))

        if not quadratic:
            for j in range(degree, -1, -1):
                N[j] = f.over(rest(j), f.mul(f.over(number(2 * j + 1), number(2)), P[1]))
            return N, ZERO
        for j in range(degree, 0, -1):
            N[j - 1] = f.over(rest(j), f.mul(number(j), P[2]))
        return N, rest(0)


def _pairs(a: int | None, b: int | None) -> list[tuple[int, int]]:
    return [(a, b)] if a is not None and b is not None else []
