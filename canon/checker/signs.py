"""Is a formula nowhere negative on its domain? Sums of terms of one sign, squares completed, roots and conditions used.

A function is a name of its own here: √R a positive w with w² = R (zeros of radicands are no part of a domain), an
exponential a positive one, sine and cosine two with s² + c² = 1, any other one of which nothing is known. What holds
for all real values of such names holds for the functions. A polynomial P in them is nowhere negative

- if its terms are, by the signs of names and even powers, and with it P times a monomial of one sign, or times what a
  condition or a root says to be positive;
- with P = A + B w, if A and B are; or if A is and B nowhere positive, and A² − B² R nowhere negative (or the reverse);
- with P = a x² + b x + c, if a is positive, or a and c are nowhere negative, and 4 a c − b² isn't either;
- with P = A + B c for a sine or cosine c, or one with a condition 1 − c² > 0, if A + B and A − B are;
- if P is without some term that isn't negative anywhere;
- with A² − B² R or its opposite, if a condition says A + B w > 0, and the sign of A − B w is seen;
- with a name u, or a square, replaced by what a condition u − v > 0 says: u = v + d with a positive d.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction

from canon.checker import core
from canon.checker.core import Polynomial, combined
from canon.checker.functions import Unreadable
from canon.checker.polynomials import (
    MOST,
    Undetermined,
    coefficients,
    divided,
    is_below_one,
    is_multiple,
    minus,
    name_of,
    parted,
    plus,
    reduced,
    shifts_of,
    times,
)
from canon.checker.statement import Statement
from canon.checker.terms import implied, sign_of

DEPTH, LONGEST = 5, 400_000
"""Steps one inside the other, and products of terms for one formula."""
FEW = 5
"""Sums of fewer terms may be left without one."""
REAL = ("sin", "cos", "exp", "sinh", "cosh", "tanh", "atan", "asinh", "abs")
"""Functions that are real for all real arguments, in a file with complex numbers, too."""
Pair = tuple[Polynomial, Polynomial]
ONE = core.ONE


class Signs:
    """The signs of a claim's formulas on its domain, where those `beside` them have a value, too."""

    def __init__(self, s: Statement, beside: Sequence[int] = ()) -> None:
        self.s, self.f = s, s.f
        self.words: dict[str, Sequence[str]] = {**s.words, "pi": ["positive"]}
        self._roots: dict[str, tuple[int, Polynomial]] = {}
        self._circles: dict[str, str] = {}  # the name of a sine, and of its cosine
        self._known: dict[int, Pair] = {}
        conditions = self._positive = list[Polynomial]()
        self._shifts: list[tuple[str, int, Polynomial]] = []
        self._spent = 0
        for a in (a for a, kind in s.conditions if kind == "positive"):
            op = self.f.ops[a]
            if op[0] == "s":
                self.words[op[1]] = [*self.words.get(op[1], ()), "positive"]
            try:
                over, under = self.fraction(a)
            except (Undetermined, Unreadable):
                continue
            if op[0] != "s" and (under == ONE or self._is_sure(under, strict=False)):
                conditions.append(over)
                self.words |= implied(self.words, over)
        for a in beside:
            with suppress(Undetermined, Unreadable):
                self.fraction(a)
        self._conjugates(conditions)
        self.words |= {f"#above{k}": ["positive"] for k in range(len(conditions))}
        self._shifts = [shift for k, p in enumerate(conditions) for shift in shifts_of(p, f"#above{k}")]

    def is_positive(self, a: int, *, strict: bool) -> bool:
        """Whether a formula is positive, or nowhere negative, wherever it has a value. False says nothing."""
        return any(
            self._is_sure(sign(q), strict=False) and self._is_sure(sign(p), strict=strict)
            for p, q in self._forms(a)
            for sign in (plus, minus)
        )

    def is_nowhere_zero(self, a: int) -> bool:
        """Whether a formula is 0 nowhere that it has a value: so its numerator has a sign."""
        return any(self._is_sure(sign(p), strict=True) for p, _ in self._forms(a) for sign in (plus, minus))

    def _conjugates(self, conditions: list[Polynomial]) -> None:
        """With A + B w > 0 the product with its conjugate has the sign of that, if it is seen to have one."""
        for p, name in [(c, n) for c in conditions for n in sorted(core.names(c) & {*self._roots})]:
            n, radicand = self._roots[name]
            A, *B = coefficients(p, name)
            with suppress(Undetermined, Unreadable):
                for sign in (plus, minus) if n == 2 and len(B) == 1 else ():
                    other = sign(combined(A, times(B[0], name_of(name)), {(): Fraction(-1)}))
                    if self._is_sure(other, strict=True, depth=3):
                        squares = combined(times(A, A), times(B[0], B[0], radicand), {(): Fraction(-1)})
                        conditions.append(self._reduced(sign(squares), cosines=False))

    def _forms(self, a: int) -> Iterator[Pair]:
        """Numerator and denominator as they stand, and without powers of roots and of sines, or of cosines."""
        try:
            over, under = self.fraction(a)
            yield over, under
            for choice in (False, True):
                yield self._reduced(over, cosines=choice), self._reduced(under, cosines=choice)
        except (Undetermined, Unreadable, RecursionError):
            return

    # -- formulas as fractions ----------------------------------------------------------------------

    def fraction(self, target: int) -> Pair:
        """Numerator and denominator in the names of this file. Raises Undetermined."""
        f, out = self.f, self._known
        for a in f.reach(target):
            if a in out:
                continue
            op, x = f.ops[a], [out[b] for b in f.parts(a)]
            if op[0] == "n":
                out[a] = ({(): op[1]} if op[1] else {}), ONE
            elif op[0] == "s":
                if op[1] == "1j" or "complex" in self.words.get(op[1], ()):
                    raise Undetermined
                out[a] = name_of(op[1]), ONE
            elif op[0] == "+":
                (p, q), (r, t) = x
                out[a] = (combined(p, r, ONE), q) if q == t else (combined(times(p, t), r, q), times(q, t))
            elif op[0] == "*":
                out[a] = times(x[0][0], x[1][0]), times(x[0][1], x[1][1])
            elif op[0] == "^":
                over, under = x[0] if op[2] > 0 else x[0][::-1]
                if abs(op[2]) > 40:
                    raise Undetermined
                out[a] = times(*[over] * abs(op[2])), times(*[under] * abs(op[2]))
            else:
                out[a] = self._function(a, x)
        return out[target]

    def _function(self, a: int, x: Sequence[Pair]) -> Pair:
        f, op, mark = self.f, self.f.ops[a], f"#{a}"
        if f.is_complex and op[1] not in (*REAL, *f.functions):
            raise Undetermined  # a root may be imaginary there
        if op[1] == "power" and (r := f.value(op[3][1])) is not None and abs(r.numerator) < 20:
            over, under = x[0]
            mark, n, below = f"#root {op[3][0]} {r.denominator}", r.denominator, ONE
            self.words[mark] = ["positive"]
            if under == ONE or (n == 2 and self._holds(under, strict=False)):  # √(P/Q) = √(P Q)/Q, with a positive Q
                self._roots[mark] = n, times(over, under)
                outer, rest = parted(self._roots[mark][1])
                self._positive += [self._roots[mark][1], *([rest] if self._terms(outer)[0] > 0 else [])]
                below = under
            pair = name_of(mark, abs(r.numerator)), times(*[below] * abs(r.numerator))
            return pair if r > 0 else (pair[1], pair[0])
        if op[1] in ("sin", "cos"):
            angle, under = x[0]
            if under == ONE and {*angle} <= {(("pi", 1),)} and (right := 2 * sum(angle.values())).denominator == 1:
                value = (0, 1, 0, -1)[int(right + (op[1] == "cos")) % 4]  # after whole right angles
                return ({(): Fraction(value)} if value else {}), ONE
            sine, cosine = (f"#{word} {op[3][0]}" for word in ("sin", "cos"))
            if sine not in self._circles:
                self._circles[sine] = cosine
                self._turned(sine, cosine, x[0])
            return name_of(sine if op[1] == "sin" else cosine), ONE
        sure = op[1] in ("exp", "cosh", "abs")
        sure = sure or (op[1] == "power" and all(self._is_sure(p, strict=True) for p in x[0]))
        declared = op[1] in f.functions and not any(op[2])  # a name may be called as a function of the language is
        self.words[mark] = ["positive"] if sure else [*self.s.words.get(op[1], ())] if declared else []
        return name_of(mark), ONE

    def _turned(self, sine: str, cosine: str, angle: Pair) -> None:
        """The signs of sine and cosine, where the angle is seen to lie in a half of the circle."""
        if not any("pi" in core.names(p) for p in self._positive):
            return
        right, (over, under) = {(("pi", 1),): Fraction(1, 2)}, angle
        for name, first in ((sine, 0), (sine, -2), (cosine, -1), (cosine, 1)):
            low, high = (times({(): Fraction(k)}, right, under) if k else {} for k in (first, first + 2))
            above = combined(over, low, {(): Fraction(-1)}) if low else over
            below = combined(high, over, {(): Fraction(-1)}) if high else minus(over)
            if all(self._is_sure(p, strict=True, depth=2) for p in (under, above, below)):
                self.words[name] = ["positive" if first in (0, -1) else "negative"]

    def _reduced(self, p: Polynomial, *, cosines: bool) -> Polynomial:
        """Without powers of roots that are polynomials, or squares of sines (or of cosines)."""
        rules = {name: (n, radicand) for name, (n, radicand) in self._roots.items()}
        for sine, cosine in self._circles.items():
            first, other = (cosine, sine) if cosines else (sine, cosine)
            rules[first] = 2, combined(ONE, name_of(other, 2), {(): Fraction(-1)})
        return reduced(p, rules)

    # -- signs of polynomials -----------------------------------------------------------------------

    def _is_sure(self, p: Polynomial, *, strict: bool, depth: int = DEPTH) -> bool:
        try:
            return self._holds(p, strict=strict, depth=depth)
        except (Undetermined, Unreadable, RecursionError):
            return False

    def _holds(self, p: Polynomial, *, strict: bool, depth: int = DEPTH) -> bool:
        self._spent += 20 + len(p) ** 2  # nearly: what comes of a polynomial are its products with itself
        if self._spent > LONGEST:
            raise Undetermined
        if not p:
            return not strict
        if p.get((), 0) < 0 and len(p) == 1:
            return False
        sign, never = self._terms(p)
        if sign:
            return sign > 0 and (never or not strict)
        if any(is_multiple(p, other) for other in self._positive):
            return True
        if depth == 0 or len(p) > MOST:
            return False
        common, rest = parted(p)
        if common != ONE:
            outer, never = self._terms(common)
            if outer and (never or not strict):
                return self._holds(rest if outer > 0 else minus(rest), strict=strict, depth=depth)
        for other in self._positive:
            quotient = divided(p, other) if 1 < len(other) <= len(p) else None
            if quotient is not None:
                return self._holds(quotient, strict=strict, depth=depth - 1)
        rules = self._by_roots, self._by_squares, self._by_conditions, self._by_bounds, self._by_terms
        return any(rule(p, strict, depth - 1) for rule in rules)

    def _terms(self, p: Polynomial) -> tuple[int, bool]:
        return sign_of(self.words, p)

    def _by_roots(self, p: Polynomial, strict: bool, depth: int) -> bool:
        for name in sorted(core.names(p) & {*self._roots}):
            n, radicand = self._roots[name]
            parts = coefficients(p, name)
            if n != 2 or len(parts) != 2:
                continue
            A, B = parts
            squares = combined(times(A, A), times(B, B, radicand), {(): Fraction(-1)})
            squares = self._reduced(squares, cosines=False)
            for first, second, difference in ((A, B, squares), (B, A, minus(squares))):
                if self._holds(first, strict=strict, depth=depth) and self._holds(second, strict=False, depth=depth):
                    return True
                if self._holds(first, strict=False, depth=depth) and self._holds(
                    difference, strict=strict, depth=depth
                ):
                    return True
        return False

    def _by_squares(self, p: Polynomial, strict: bool, depth: int) -> bool:
        for name in sorted(core.names(p)):
            parts = coefficients(p, name)
            if len(parts) != 3:
                continue
            c, b, a = parts
            sure = self._holds(a, strict=True, depth=depth)  # where a = 0 it is c that has to be
            if sure or (not strict and all(self._holds(x, strict=False, depth=depth) for x in (a, c))):
                left = combined(times({(): Fraction(4)}, a, c), times(b, b), {(): Fraction(-1)})
                if self._holds(left, strict=strict, depth=depth):
                    return True
        return False

    def _by_conditions(self, p: Polynomial, strict: bool, depth: int) -> bool:
        for name, exponent, value in self._shifts:
            powers = {dict(m).get(name, 0) for m in p}
            if powers == {0} or any(e % exponent for e in powers):
                continue
            moved: Polynomial = {}
            for m, c in p.items():
                rest = tuple((n, e) for n, e in m if n != name)
                moved = combined(moved, {rest: c}, times(*[value] * (dict(m).get(name, 0) // exponent)))
            if self._holds(moved, strict=strict, depth=depth):
                return True
        return False

    def _by_bounds(self, p: Polynomial, strict: bool, depth: int) -> bool:
        """A + B c at a sine or cosine c lies between A + B and A - B; also where c² < 1, and not at the ends."""
        inside = {*(name for q in self._positive if (name := is_below_one(q)))}
        for name in sorted(core.names(p) & {*self._circles, *self._circles.values(), *inside}):
            parts = coefficients(p, name)
            if len(parts) != 2:
                continue
            ends = [combined(parts[0], parts[1], {(): Fraction(k)}) for k in (1, -1)]
            if all(self._holds(end, strict=strict and name not in inside, depth=depth) for end in ends):
                if not strict or name not in inside or any(self._holds(end, strict=True, depth=depth) for end in ends):
                    return True
        return False

    def _by_terms(self, p: Polynomial, strict: bool, depth: int) -> bool:
        """A sum of few, without a term that is nowhere negative."""
        for m, c in p.items() if len(p) < FEW and depth >= DEPTH - 3 else ():
            rest = {n: d for n, d in p.items() if n != m}
            sign, never = self._terms({m: c})
            if sign > 0 and self._holds(rest, strict=strict and not never, depth=depth):
                return True
        return False
