"""Formulas as rational functions of one name, taken apart into factors, zeros and poles, with formulas as coefficients.

A factor of degree 1 has its zero; of another one zeros are sought among the claim's own names and definitions, and by
the quadratic formula where the discriminant is seen to be a square.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

from canon.checker.core import Polynomial
from canon.checker.followed import at_random, is_identity
from canon.checker.formulas import ONE, ZERO
from canon.checker.functions import Unreadable
from canon.checker.polynomials import Undetermined
from canon.checker.signs import Signs
from canon.checker.statement import Statement

X = "#x"
HIGHEST = 8
"""The highest degree of a factor."""
Factor = Sequence[int]
"""The coefficients of a polynomial, from the 0th on."""
Factors = dict[tuple[int, ...], int]


class NoForm(ValueError):
    """A formula that isn't seen to be of the form that is asked for."""


class Rational:
    """A claim's formulas as rational functions of the name `X`."""

    def __init__(self, s: Statement) -> None:
        self.s, self.f, self.values = s, s.f, at_random(s)
        for a, _ in s.conditions:
            is_identity(self.values, a)  # half an angle before the whole one, where the domain is one of halves
        names = {*s.words, *s.q, *s.p} - {*s.f.functions}
        own = [*(s.f.node("s", n) for n in sorted(names)), *s.names.values()]
        self.candidates = [ZERO, ONE, s.f.number(-1), *own]

    def is_zero(self, a: int) -> bool:
        """Whether a formula is seen to be 0."""
        return a == ZERO or is_identity(self.values, a)

    def factors(self, target: int) -> tuple[int, Factors]:
        """A factor without X, and factors with their exponents. Raises NoForm."""
        f, out = self.f, dict[int, tuple[int, Factors]]()
        moving = set[int]()
        for a in f.reach(target):
            op, x = f.ops[a], [out[b] for b in f.parts(a)]
            if op != ("s", X) and not moving & {*f.parts(a)}:
                out[a] = a, {}
                continue
            moving.add(a)
            if op[0] == "s":
                out[a] = ONE, {(ZERO, ONE): 1}
            elif op[0] == "*":
                out[a] = f.mul(x[0][0], x[1][0]), _product(x[0][1], x[1][1])
            elif op[0] == "^":
                out[a] = f.power(x[0][0], f.number(op[2])), {p: e * op[2] for p, e in x[0][1].items()}
            elif op[0] == "+":
                out[a] = self._sum(*x)
            else:
                raise NoForm
        return out[target]

    def _sum(self, x: tuple[int, Factors], y: tuple[int, Factors]) -> tuple[int, Factors]:
        common = {p: min(x[1].get(p, 0), y[1].get(p, 0)) for p in {**x[1], **y[1]}}
        left, right = (self._expanded(c, _product(own, common, -1)) for c, own in (x, y))
        size = max(len(left), len(right))
        total = [self.f.add(*(p[k] for p in (left, right) if k < len(p))) for k in range(size)]
        while total and self.is_zero(total[-1]):
            total.pop()
        if not total:
            raise NoForm
        common = {p: e for p, e in common.items() if e}
        return (total[0], common) if len(total) == 1 else (ONE, _product(common, {tuple(total): 1}))

    def _expanded(self, c: int, factors: Factors) -> tuple[int, ...]:
        found: tuple[int, ...] = (c,)
        for p, e in factors.items():
            for _ in range(e):
                found = self.times(found, p)
        return found

    def times(self, p: Factor, q: Factor) -> tuple[int, ...]:
        f, size = self.f, len(p) + len(q) - 1
        if size > HIGHEST + 1:
            raise NoForm
        terms = [[f.mul(p[i], q[k - i]) for i in range(len(p)) if 0 <= k - i < len(q)] for k in range(size)]
        return tuple(f.add(*row) for row in terms)

    def at(self, p: Sequence[int], x: int) -> int:
        """The value of a polynomial."""
        total = ZERO
        for c in reversed(p):
            total = self.f.add(c, self.f.mul(total, x))
        return total

    def zeros(self, p: Factor) -> tuple[int, list[int], Factor]:
        """A coefficient, zeros, and what is left where not all are found: 1, or a polynomial with x^n + …"""
        f, found = self.f, list[int]()
        while len(p) > 1:
            x = next((x for x in self.candidates if self.is_zero(self.at(p, x))), None)
            if x is None and len(p) == 2:
                x = f.mul(f.number(-1), f.over(p[0], p[1]))
            if x is None and len(p) == 3:
                c, b, a = p
                root = self._root(f.sub(f.mul(b, b), f.mul(f.number(4), a, c)))
                x = None if root is None else f.over(f.sub(root, b), f.mul(f.number(2), a))
            if x is None:
                return p[-1], found, tuple(f.over(c, p[-1]) for c in p)
            found.append(x)
            carried = [p[-1]]
            for c in reversed(p[1:-1]):
                carried.append(f.add(c, f.mul(carried[-1], x)))
            p = tuple(reversed(carried))
        return p[len(p) - 1], found, (ONE,)

    def _root(self, a: int) -> int | None:
        """The root of a formula that is a square of positive names and numbers, or 0; None for any other."""
        return ZERO if self.is_zero(a) else plain_root(self.s, a)


def plain_root(s: Statement, a: int) -> int | None:
    """The root of a formula that is a product of even powers of positive names, and the square of a number."""
    f, signs, found = s.f, Signs(s), ONE
    try:
        pair = signs.fraction(a)
    except (Undetermined, Unreadable):
        return None
    for p, sign in zip(pair, (1, -1), strict=True):
        if len(p) != 1:
            return None
        ((m, c),) = p.items()
        root = Fraction(isqrt(abs(c.numerator)), isqrt(c.denominator))
        if root * root != c or any(e % 2 or name[0] == "#" or not _is_positive(signs, name) for name, e in m):
            return None
        found = f.mul(found, f.power(f.number(root), f.number(sign)))
        found = f.mul(found, *(f.power(f.node("s", name), f.number(sign * e // 2)) for name, e in m))
    return found


def _is_positive(signs: Signs, name: str) -> bool:
    return "positive" in signs.words.get(name, ())


def _product(x: Factors, y: Factors, sign: int = 1) -> Factors:
    found = dict(x)
    for p, e in y.items():
        found[p] = found.get(p, 0) + sign * e
    return {p: e for p, e in found.items() if e}


def formula(s: Statement, p: Polynomial) -> int:
    """The formula of a polynomial in names."""
    f = s.f
    terms = (f.mul(f.number(c), *(f.power(f.node("s", n), f.number(e)) for n, e in m)) for m, c in p.items())
    return f.add(*terms)
