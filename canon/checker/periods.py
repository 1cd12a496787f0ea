"""Actions and periods in closed form, where the momentum's square is rational in a function x of the coordinate.

Half of the action is ∫ √R dx between two zeros of D = p², or between one and a mirror, R = D/(dx/dq)²; half of the
period has (∂D/∂E)²/4 D in place of D. R = λ P Π (x − c)^k with even k and simple zeros or poles of P; so the integrand
is a rational function over the root of a quadratic, a cubic or a quartic. By linear algebra, at random values of the
parameters modulo a prime, it is a derivative and a sum of

- 1/√P and 1/(x − c)√P for P = (x − e)(o − x), whose integrals are π and ±π/√−P(c);
- 1/√P, (1 − m t)/√P and 1/(1 − n t)√P for P = t (1 − t)(1 − m t), with t the Möbius transformation that takes the
  ends to 0 and 1: with t = sin²φ these are 2K(m), 2E(m) and 2Π(n, m) (Byrd & Friedman, Handbook of Elliptic Integrals).

That there is such a libration is what the claim takes for granted: where D has one zero only that may be an end, this
lies in the range of x. Every other zero and pole is seen to be outside of the orbit, by signs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import permutations

from canon.checker.branch_points import Zero, branch_points
from canon.checker.charts import Chart, charts, is_inside
from canon.checker.followed import FAILURES
from canon.checker.formulas import ONE
from canon.checker.functions import Unreadable
from canon.checker.momentum import Square
from canon.checker.positive import is_positive
from canon.checker.radicals import Radicals
from canon.checker.rational import NoForm, Rational, X
from canon.checker.ratios import multiple
from canon.checker.reduction import Reduction, reduced
from canon.checker.statement import Statement


def is_so(
    s: Statement, x: str, square: Square, equals: int, period: int | None, *, rate: bool, exists: bool = True
) -> bool:
    """Whether the action is what is claimed, or with `rate` the frequency: of a libration, or over a `period`; that
    there is such an orbit is taken for granted, or not where it isn't known that it `exists`."""
    for chart in charts(s, found := Rational(s), x, [square.D, square.slope]):
        try:
            if _Integral(s, found, chart, x, square, rate=rate, exists=exists).is_so(equals, period):
                return True
        except (NoForm, Unreadable, *FAILURES):
            continue
    return False


class _Integral:
    """∫ √R dx in one chart."""

    def __init__(
        self, s: Statement, r: Rational, chart: Chart, q: str, square: Square, *, rate: bool, exists: bool
    ) -> None:
        self.s, self.f, self.r, self.chart, self.q, self.rate = s, s.f, r, chart, q, rate
        self.exists = exists
        self._known = dict[tuple[int, int, bool], bool]()
        self.D = chart.moved(s, square.D, q)
        self.lead, self.zeros, self.quadratic = branch_points(s, r, chart, q, square, self._is_outside, rate=rate)

    # -- signs ----------------------------------------------------------------------------------------

    def _is_above(self, a: int, b: int, *, strict: bool = True) -> bool:
        key = a, b, strict
        if key not in self._known:
            self._known[key] = is_positive(self.s, self.f.sub(a, b), strict=strict, real=True)
        return self._known[key]

    def _side(self, a: int, low: int | None, high: int | None) -> int:
        """-1 for a place that isn't above the lower end, 1 for one that isn't below the upper one. Raises NoForm."""
        if low is not None and (self.r.is_zero(self.f.sub(low, a)) or self._is_above(low, a, strict=False)):
            return -1
        if high is not None and (self.r.is_zero(self.f.sub(a, high)) or self._is_above(a, high, strict=False)):
            return 1
        raise NoForm

    def _is_outside(self, a: int) -> bool:
        try:
            return bool(self._side(a, self.chart.low, self.chart.high))
        except NoForm:
            return False

    @contextmanager
    def _granted(self, *positive: int, sure: bool = False) -> Iterator[None]:
        """What follows for an orbit that exists, as conditions; where none is granted, what isn't `sure` is seen."""
        if not (sure or self.exists) and not all(self._is_seen(a) for a in positive):
            raise NoForm
        kept, known, self._known = self.s.conditions, self._known, {}
        self.s.conditions = [*kept, *((a, "positive") for a in (*positive, *Radicals(self.s, positive).known()))]
        try:
            yield
        finally:
            self.s.conditions, self._known = kept, known

    def _is_seen(self, a: int) -> bool:
        """Whether a formula is positive, or a positive multiple of what the domain says to be so."""
        if is_positive(self.s, a, strict=True, real=True):
            return True
        values = self.r.values
        value = values.value(a)
        ratios = (
            multiple(value, values.value(b), values.t.prime) for b, kind in self.s.conditions if kind == "positive"
        )
        return any(ratio is not None and ratio > 0 for ratio in ratios)

    # -- what is claimed -------------------------------------------------------------------------------

    def is_so(self, equals: int, period: int | None) -> bool:
        """Whether the claim's formula is the integral. Raises NoForm where that isn't seen."""
        f, chart = self.f, self.chart
        if period is not None:
            if chart.low is None or chart.high is None or chart.period is None or self.quadratic is not None:
                raise NoForm
            if not self.r.is_zero(f.sub(period, chart.period)) or not is_inside(self.s, self.r, self.q, None, None):
                raise NoForm
            turning = [z.at for z in self.zeros if z.turns]
            known = [f.substitute(self.D, {X: end}) for end in (chart.low, chart.high)]
            if not self.exists:  # the zero lies on one side
                walls = [f.sub(chart.low, z) for z in turning] + [f.sub(z, chart.high) for z in turning]
                known = [wall for wall in walls if self._is_seen(wall)] if len(turning) == 1 else []
            with self._granted(*known):
                ends = [z for z in self.zeros if any(self.r.is_zero(f.sub(z.at, end)) for end in chart.mirrors)]
                return [z.k for z in ends] == [-1, -1] and any(
                    self._is_elliptic(equals, 2, pair) for pair in (ends, ends[::-1])
                )
        turning = [z for z in self.zeros if z.turns]
        bounds = list[int]()
        if len(turning) == 1 and self.quadratic is None:
            bounds += [f.sub(turning[0].at, chart.low)] if chart.low is not None else []
            bounds += [f.sub(chart.high, turning[0].at)] if chart.high is not None else []
        odd = [z for z in self.zeros if z.k % 2]
        if len(odd) == 2 and self.quadratic is None:
            bounds.append(f.mul(f.number(-1), self.lead))  # R is positive between
        with self._granted(*bounds):
            if self.quadratic is not None or len(odd) == 2:
                return self._is_elementary(equals, odd)
            if len(odd) not in (3, 4):
                raise NoForm
            for pair in permutations(odd, 2):
                try:
                    if self._is_elliptic(equals, self._times(pair), pair):
                        return True
                except NoForm:
                    continue
        return False

    def _times(self, ends: Sequence[Zero]) -> int:
        """How often the orbit runs from end to end: four times where one is a mirror. Raises NoForm."""
        chart, mirrors = self.chart, 0
        for z in ends:
            if z.turns:
                low, high = chart.low, chart.high
                inside = low is None or self._is_above(z.at, low, strict=False)
                inside = inside and (high is None or self._is_above(high, z.at, strict=False))
                if z.k != (-1 if self.rate else 1) or not inside:
                    raise NoForm
                continue
            if z.k != -1 or not any(self.r.is_zero(self.f.sub(z.at, end)) for end in chart.mirrors):
                raise NoForm
            mirrors += 1
            free = all(self.f.ops[b] != ("s", self.q) for a, _ in self.s.conditions for b in self.f.reach(a))
            if z.at != chart.mirrors[-1] and not free:
                raise NoForm
        if mirrors == 2 or not is_inside(self.s, self.r, self.q, *(chart.whole if mirrors else chart.half)):
            raise NoForm
        return 4 if mirrors else 2

    def _compared(self, equals: int, total: Sequence[tuple[int, int]], positive: Sequence[int], root: int) -> bool:
        """Whether √root · Σ number · formula is the claimed action, or its inverse the frequency."""
        f, values, radicals = self.f, self.r.values, Radicals(self.s, positive)
        value, t = {}, values.t
        for c, a in total:
            value = t.add(value, t.mul({(): c} if c else {}, values.value(radicals.split(a))))
        value = t.mul(value, values.value(radicals.split(f.power(root, f.number("1/2")))))
        claimed = values.value(radicals.split(equals))
        return not t.add(t.mul(claimed, value), values.one, -1) if self.rate else not t.add(claimed, value, -1)

    # -- a quadratic under the root ----------------------------------------------------------------------

    def _is_elementary(self, equals: int, odd: Sequence[Zero]) -> bool:
        f, chart, number = self.f, self.chart, self.f.number
        others = [z for z in self.zeros if z.k % 2 == 0]
        if self.quadratic is not None:
            if odd or any(z.turns for z in self.zeros):
                raise NoForm
            if not is_inside(self.s, self.r, self.q, *chart.half):
                raise NoForm
            c, b, _ = self.quadratic
            roots = [op[3][0] for op in (f.ops[a] for a in f.reach(equals)) if op[:2] == ("f", "power")]
            with self._granted(*roots, sure=True):  # the claim's formula is real
                if not all(self._is_forbidden(end) for end in (chart.low, chart.high) if end is not None):
                    raise NoForm
            times, k, sides = 2, -1 if self.rate else 1, [(z, self._side(z.at, chart.low, chart.high)) for z in others]
            ends = list[tuple[Zero, int]]()
        else:
            times = self._times(odd)
            low, high = odd if self._is_above(odd[1].at, odd[0].at) else odd[::-1]
            if not self._is_above(high.at, low.at):
                raise NoForm
            c, b = f.mul(low.at, high.at), f.mul(number(-1), f.add(low.at, high.at))
            sides = [(z, self._side(z.at, low.at, high.at)) for z in others]
            k, ends = 1, [(Zero(z.at, z.k - 1, False), side) for z, side in ((low, -1), (high, 1))]
        if not self.exists and not self._is_seen(f.mul(number(-1), self.lead)):
            raise NoForm
        size = f.mul(number(-1), self.lead)  # of −(x² + b x + c), which is positive along the orbit
        found = reduced(self.r.values, Reduction(
            P=(f.mul(number(-1), c), f.mul(number(-1), b), number(-1)),
            above=(k + 1) // 2,
            factors=[(z.at, z.k // 2, -side) for z, side in (*sides, *ends)],
        ))  # fmt: skip
        pi = f.node("s", "pi")
        total = [(found.plain * times, pi)]
        for (z, side), d in zip((*sides, *ends), found.poles, strict=True):
            if d:
                under = f.add(f.mul(z.at, z.at), f.mul(b, z.at), c)
                total.append((-side * times * d, f.over(pi, f.power(under, number("1/2")))))
        return self._compared(equals, total, [], size)

    def _is_forbidden(self, x: int) -> bool:
        """Whether the quadratic isn't positive at an end of the range: then its zeros lie on one side of it."""
        size = self.f.mul(self.f.number(-1), self.lead, self.r.at(self.quadratic or (), x))
        return self.r.is_zero(size) or is_positive(self.s, size, strict=False, real=True)

    # -- a cubic or a quartic -----------------------------------------------------------------------------

    def _is_elliptic(self, equals: int, times: int, ends: Sequence[Zero]) -> bool:
        """With t = 0 at the first end and 1 at the second one; one of the other zeros of P goes to infinity."""
        f, odd = self.f, [z for z in self.zeros if z.k % 2]
        e, o = ends
        up = self._is_above(o.at, e.at)
        if not up and not self._is_above(e.at, o.at):
            raise NoForm
        low, high = (e, o) if up else (o, e)
        sides = {z: self._side(z.at, low.at, high.at) for z in self.zeros if z not in ends}
        left = [z for z in odd if z not in ends]
        sign = 1 if is_positive(self.s, self.lead, strict=True, real=True) else -1
        if sign < 0 and not is_positive(self.s, f.mul(f.number(-1), self.lead), strict=True, real=True):
            raise NoForm
        if sign * (-1) ** (high.k + sum(z.k for z, side in sides.items() if side > 0)) < 0:
            raise NoForm  # R isn't positive between
        if any(not self._is_above(*((z.at, high.at) if side > 0 else (low.at, z.at))) for z, side in sides.items()):
            raise NoForm
        if len(left) not in (1, 2) or (len(left) == 2 and not self._is_alone(left, sides)):
            raise NoForm
        if not self.exists and not all(self._is_outside(z.at) for z in left):
            raise NoForm  # there may be other motions
        for g in left if len(left) == 2 else [None]:
            third = next(z for z in left if z != g)
            if self._is_legendre(equals, times, (e, o, third, g), [*sides]):
                return True
        return False

    def _is_alone(self, left: Sequence[Zero], sides: dict[Zero, int]) -> bool:
        """Whether no other orbit lies between the other zeros of a quartic: on both sides of this one, or outside."""
        return {sides[z] for z in left} == {1, -1} or all(self._is_outside(z.at) for z in left)

    def _is_legendre(
        self, equals: int, times: int, odd: tuple[Zero, Zero, Zero, Zero | None], others: Sequence[Zero]
    ) -> bool:
        f, (e, o, third, g) = self.f, odd
        sub, mul, over, number = f.sub, f.mul, f.over, f.number
        everything, beyond = [e, o, *others], sum(z.k for z in (e, o, *others))
        kappa = None if g is None else over(sub(o.at, g.at), sub(o.at, e.at))  # where t has x = ∞
        place: Callable[[Zero], int] = lambda z: over(sub(z.at, e.at), sub(o.at, e.at))
        if g is not None and kappa is not None:
            place = lambda z: mul(kappa, over(sub(z.at, e.at), sub(z.at, g.at)))
        root = [(self.lead, 1), (number(4), 1)]  # √ of what R dx² has besides factors of t, by its size
        spread = sub(o.at, e.at)
        if g is None or kappa is None:
            root.append((spread, 2 + beyond))
        else:
            root += [(kappa, 2 - beyond - 4), (sub(e.at, g.at), 2), (sub(g.at, e.at), g.k), (kappa, g.k)]
            root += [(sub(g.at, z.at), z.k) for z in everything if z not in (g, e)] + [(sub(g.at, e.at), e.k)]
        poles = list[tuple[int, int]]()
        for z in others:
            if z != g:
                root.append((place(z), z.k))
                poles.append((over(ONE, place(z)), z.k))
        if kappa is not None:
            poles.append((over(ONE, kappa), -beyond - 4))
        m = over(ONE, place(third))
        halves = [(n, k // 2) for n, k in poles if not self.r.is_zero(sub(n, m))]
        found = reduced(self.r.values, Reduction(
            P=(), m=m, above=(e.k + 1) // 2, below=(o.k + 1) // 2, third=(third.k + 1) // 2,
            factors=[(n, k, 1) for n, k in halves],
        ))  # fmt: skip
        total = [(times * c, f.node("f", name, (), (m,)))
                 for name, c in (("elliptic_k", found.plain), ("elliptic_e", found.other)) if c]  # fmt: skip
        total += [(times * d, f.node("f", "elliptic_pi", (), (n, m)))
                  for (n, _), d in zip(halves, found.poles, strict=True) if d]  # fmt: skip
        square, positive = ONE, list[int]()
        for a, k in root:
            a = a if is_positive(self.s, a, strict=True, real=True) else mul(number(-1), a)
            if not is_positive(self.s, a, strict=True, real=True):
                raise NoForm
            positive.append(a)
            square = mul(square, f.power(a, number(k)) if k else ONE)
        return self._compared(equals, total, positive, square)
