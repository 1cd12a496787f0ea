"""Series in powers of a small positive number y, whose coefficients are formulas: what a formula tends to.

A name is put at `to` ± y^k, at ±1/y^k, or where it stands in exponents a x alone, at ∓log(y)/a. Sums, products,
powers, exponentials, logarithms, sine and cosine have recurrences (Knuth, The Art of Computer Programming, vol. 2,
§ 4.7); another function is expanded by its derivatives where it is smooth. What is divided by has a first coefficient
that vanishes nowhere; under a root it is positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import factorial
from typing import Any, NamedTuple

from canon.checker.followed import FAILURES, at_random, is_identity
from canon.checker.formulas import ONE, ZERO
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.ratios import multiple
from canon.checker.shapes import SMOOTH
from canon.checker.statement import Statement

EXPONENTIAL = ("exp", "sinh", "cosh", "tanh", "coth")
EDGED = ("asin", "acos", "atanh")
"""Functions that are smooth between -1 and 1, the first two continuous at these."""
HIGHEST = 12
"""A whole power up to this one is multiplied out."""


class NoSeries(ValueError):
    """A formula that isn't seen to have an expansion."""


class Series(NamedTuple):
    """Coefficients of y^low, y^(low + 1), …; of higher powers than are here nothing is known."""

    low: int
    terms: tuple[int, ...]

    @property
    def end(self) -> int:
        """The first power whose coefficient isn't known."""
        return self.low + len(self.terms)


class Expansion:
    """Expansions of a claim's formulas where one name x tends to something, with so many coefficients.

    **Arguments:** what x is `at`; or a `pace` a, where y = exp(-a x) and x stands in exponents alone.
    """

    def __init__(self, s: Statement, name: str, at: Series | None, order: int, pace: int = ZERO) -> None:
        self.s, self.f, self.name, self.at, self.order, self.pace = s, s.f, name, at, order, pace
        self._values = at_random(s)
        self._known: dict[int, Series] = {}

    def of(self, target: int) -> Series:
        """The series of a formula. Raises NoSeries."""
        f = self.f
        moving = set[int]()
        for a in f.reach(target):
            if f.ops[a] == ("s", self.name) or moving & {*f.parts(a)}:
                moving.add(a)
        needed = {target}
        for a in reversed(f.reach(target)):
            steep = self.at is None and f.ops[a][0] == "f" and f.ops[a][1] in EXPONENTIAL
            needed.update(f.parts(a) if a in needed & moving and not steep else ())
        for a in sorted(needed - self._known.keys()):
            self._known[a] = self._of(a) if a in moving else self.constant(a)
        return self._known[target]

    def constant(self, a: int) -> Series:
        """A formula without the name."""
        return Series(0, (a, *[ZERO] * (self.order - 1)))

    def _of(self, a: int) -> Series:
        f, op = self.f, self.f.ops[a]
        if self.at is None and op[0] in "sf" and (op[0] == "s" or op[1] in EXPONENTIAL):
            return self._steep(op)
        x = [self._known[b] for b in f.parts(a)]
        if op[0] == "s" and self.at is not None:
            return Series(self.at.low, (*self.at.terms, *[ZERO] * (self.order - len(self.at.terms))))
        if op[0] in "+*":
            return self.sum(*x) if op[0] == "+" else self.product(*x)
        if op[0] == "^":
            return self.power(x[0], Fraction(op[2]))
        if op[1] == "power":
            exponent = f.value(op[3][1])
            return self.power(x[0], exponent) if exponent is not None else self.exp(self.product(x[1], self.log(x[0])))
        if op[1] in f.functions or len(x) != 1:
            raise NoSeries
        return self._function(op[1], x[0])

    def _steep(self, op: tuple[Any, ...]) -> Series:
        """exp(n a x + b), or a hyperbolic function of n a x + b, in powers of exp(-a x)."""
        f = self.f
        if op[0] == "s":
            raise NoSeries
        slope, start = f.slope(op[3][0], self.name), f.substitute(op[3][0], {self.name: ZERO})
        if any(f.ops[b] == ("s", self.name) for b in f.reach(slope)):
            raise NoSeries
        ratio = multiple(self._values.value(slope), self._values.value(self.pace), self._values.t.prime)
        if ratio is None or ratio.denominator != 1:
            raise NoSeries
        first = self.constant(f.node("f", "exp", (), (start,)) if start != ZERO else ONE)
        up = Series(-int(ratio), first.terms)
        if op[1] == "exp":
            return up
        down = self.power(up, Fraction(-1))
        sinh, cosh = (self.product(self.constant(f.number(Fraction(1, 2))), self.sum(up, x))
                      for x in (self.product(self.constant(f.number(-1)), down), down))  # fmt: skip
        if op[1] in ("sinh", "cosh"):
            return sinh if op[1] == "sinh" else cosh
        over, under = (sinh, cosh) if op[1] == "tanh" else (cosh, sinh)
        return self.product(over, self.power(under, Fraction(-1)))

    def _plain(self, c: int) -> int:
        """A coefficient, or the rational number that it is."""
        try:
            number = multiple(self._values.value(c), self._values.one, self._values.t.prime)
        except FAILURES:
            return c
        return c if number is None else self.f.number(number)

    def _function(self, name: str, x: Series) -> Series:
        if name in ("exp", "log"):
            return self.exp(x) if name == "exp" else self.log(x)
        if name in ("sin", "cos", "tan", "cot"):
            sine, cosine = self._circle(x)
            if name in ("sin", "cos"):
                return sine if name == "sin" else cosine
            over, under = (sine, cosine) if name == "tan" else (cosine, sine)
            return self.product(over, self.power(under, Fraction(-1)))
        if name == "atan" and x.low < 0:
            return self._far(self.stripped(x))
        c, rest = self._parted(x)
        c = self._plain(c)
        if name in ("elliptic_k", "elliptic_e") and self.is_zero(c):
            return self._composed(rest, [self._complete(name, k) for k in range(self.order)])
        inside = name in EDGED and is_positive(self.s, self._below_one(c), strict=True, real=True)
        if name in EDGED[:2] and not inside and self.is_zero(self._below_one(c)):
            end, first = self.f.value(c), self.stripped(rest).terms[0]
            if end is None or not is_positive(self.s, self.f.mul(self.f.number(-end), first), strict=True, real=True):
                raise NoSeries  # it isn't seen to come from inside
            turns = end if name == "asin" else 1 - end
            turn = self.f.mul(self.f.number(turns / 2), self.f.node("s", "pi"))
            return Series(0, (turn,))  # continuous there, and no more
        if not inside and name not in SMOOTH:
            raise NoSeries
        slopes, node = [], self.f.node("f", name, (), (self.f.node("s", "#y"),))
        for k in range(self.order):
            value = self.f.substitute(node, {"#y": c})
            slopes.append(self.f.mul(self.f.number(Fraction(1, factorial(k))), value))
            node = self.f.slope(node, "#y")
        return self._composed(rest, slopes)

    def _below_one(self, c: int) -> int:
        return self.f.sub(ONE, self.f.mul(c, c))

    def _complete(self, name: str, k: int) -> int:
        """The coefficient of mᵏ in K(m), or in E(m)."""
        choose = Fraction(factorial(2 * k), 4**k * factorial(k) ** 2)
        c = choose**2 * (Fraction(1, 1 - 2 * k) if name == "elliptic_e" else 1) / 2
        return self.f.mul(self.f.number(c), self.f.node("s", "pi"))

    def is_zero(self, c: int) -> bool:
        """Whether a coefficient is seen to be 0."""
        return c == ZERO or is_identity(self._values, c)

    def stripped(self, x: Series) -> Series:
        """Without the first coefficients that are 0. Raises NoSeries where none is left."""
        for k, c in enumerate(x.terms):
            if not self.is_zero(c):
                return Series(x.low + k, (self._plain(c), *x.terms[k + 1 :]))
        raise NoSeries

    def sum(self, x: Series, y: Series) -> Series:
        """x + y."""
        low, end = min(x.low, y.low), min(x.end, y.end)
        return Series(low, tuple(self.f.add(_at(x, k), _at(y, k)) for k in range(low, end)))

    def product(self, x: Series, y: Series) -> Series:
        """x y."""
        n = min(len(x.terms), len(y.terms))
        return Series(x.low + y.low, tuple(self._dot(x.terms, y.terms, k) for k in range(n)))

    def _dot(self, x: Sequence[int], y: Sequence[int], k: int) -> int:
        return self.f.add(*(self.f.mul(x[j], y[k - j]) for j in range(k + 1)))

    def power(self, x: Series, r: Fraction) -> Series:
        """xʳ. Raises NoSeries where its first coefficient isn't seen to be as it must be."""
        f = self.f
        if r.denominator == 1 and 0 < r <= HIGHEST:
            return x if r == 1 else self.product(x, self.power(x, r - 1))
        x = self.stripped(x)
        a, low = x.terms[0], x.low * r
        if low.denominator != 1:
            raise NoSeries
        if not (is_nowhere_zero(self.s, a) if r.denominator == 1 else is_positive(self.s, a, strict=True, real=True)):
            raise NoSeries
        terms = [f.power(a, f.number(r))]
        for n in range(1, len(x.terms)):
            parts = (
                f.mul(f.number((k * r - (n - k)) / n), x.terms[k], terms[n - k])
                for k in range(1, n + 1)
                if x.terms[k] != ZERO
            )
            terms.append(f.over(f.add(*parts), a))
        return Series(int(low), tuple(terms))

    def _parted(self, x: Series) -> tuple[int, Series]:
        """The constant, and the rest, which tends to 0."""
        x = self.stripped(x) if x.low < 0 else x
        if x.low < 0 or x.end < 1:
            raise NoSeries
        return _at(x, 0), Series(1, tuple(_at(x, k) for k in range(1, x.end)))

    def _weighted(self, x: Series) -> list[int]:
        """k times the coefficient of yᵏ."""
        return [self.f.mul(self.f.number(k), c) for k, c in enumerate(x.terms, 1)]

    def exp(self, x: Series) -> Series:
        """exp(x), for an x without a pole."""
        f, (c, rest) = self.f, self._parted(x)
        terms, weighted = [f.node("f", "exp", (), (c,)) if c != ZERO else ONE], self._weighted(rest)
        for n in range(1, len(weighted) + 1):
            parts = (f.mul(weighted[k - 1], terms[n - k]) for k in range(1, n + 1))
            terms.append(f.mul(f.number(Fraction(1, n)), f.add(*parts)))
        return Series(0, tuple(terms))

    def log(self, x: Series) -> Series:
        """log(x), for an x that tends to a positive number."""
        f, x = self.f, self.stripped(x)
        a = x.terms[0]
        if x.low != 0 or not is_positive(self.s, a, strict=True, real=True):
            raise NoSeries
        terms = [ZERO if self.is_zero(f.sub(a, ONE)) else f.node("f", "log", (), (a,))]
        for n in range(1, len(x.terms)):
            parts = [f.mul(f.number(Fraction(-k, n)), terms[k], x.terms[n - k]) for k in range(1, n)]
            terms.append(f.over(f.add(x.terms[n], *parts), a))
        return Series(0, tuple(terms))

    def _circle(self, x: Series) -> tuple[Series, Series]:
        f, (c, rest) = self.f, self._parted(x)
        sine, cosine = ([self._plain(f.node("f", name, (), (c,)))] for name in ("sin", "cos"))
        weighted = self._weighted(rest)
        for n in range(1, len(weighted) + 1):
            turned = [
                f.mul(f.number(Fraction(sign, n)), f.add(*(f.mul(weighted[k - 1], y[n - k]) for k in range(1, n + 1))))
                for sign, y in ((1, cosine), (-1, sine))
            ]
            sine, cosine = [*sine, turned[0]], [*cosine, turned[1]]
        return Series(0, tuple(sine)), Series(0, tuple(cosine))

    def _far(self, x: Series) -> Series:
        """atan(x) where x has a pole: ±π/2 - atan(1/x)."""
        f, a = self.f, x.terms[0]
        signs = [k for k in (1, -1) if is_positive(self.s, f.mul(f.number(k), a), strict=True, real=True)]
        if x.low >= 0 or not signs:
            raise NoSeries
        turn = self.constant(f.mul(f.number(Fraction(signs[0], 2)), f.node("s", "pi")))
        rest = self._function("atan", self.power(x, Fraction(-1)))
        return self.sum(turn, self.product(self.constant(f.number(-1)), rest))

    def _composed(self, rest: Series, slopes: Sequence[int]) -> Series:
        """Σ slopes[k] restᵏ."""
        total = self.constant(ZERO)
        for c in reversed(slopes[: len(rest.terms) + 1]):
            total = self.sum(self.constant(c), self.product(rest, total))
        return total


def _at(x: Series, k: int) -> int:
    """The coefficient of yᵏ."""
    return x.terms[k - x.low] if k >= x.low else ZERO
