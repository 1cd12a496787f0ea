"""Values of the functions of `alone_special.py` at a random point; what is positive there: `alone_squares.py`.

K(m) is (1 − m)^(−1/2) K(m/(m − 1)), and E(m) (1 − m)^(1/2) E(m/(m − 1)). sn, cn and dn of one argument are a random
point with sn² + cn² = 1, dn² + m sn² = 1, dn being positive where m < 1 is seen. The sine of an arcsine is its
argument, the exponential of a logarithm too; an arc is the same where its tangent is and its cosine is positive; half
of it has a positive cosine. x^n with a name in n is a positive number where x is one.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone, alone_special, alone_squares
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_special  # type: ignore
    import alone_squares  # type: ignore

Stop, RANDOM, MORE, JACOBI = alone.Stop, alone.RANDOM, alone_special.MORE, alone_special.JACOBI
HALF, random_prime = alone_squares.HALF, alone_squares.random_prime
ARCS, AREAS = ("asin", "acos", "atan"), ("asinh", "acosh", "atanh")


class Values(alone_squares.Squares):
    """A random point, with values of these functions."""

    def __init__(self, claim: Any, prime: int, fixed: Any = None, free: Any = None) -> None:
        super().__init__(claim, prime, fixed, free)
        self.turns = dict[int, tuple[int, int]]()  # an arc: its cosine and sine
        self.powers = dict[int, int]()  # a logarithm: what it is the logarithm of

    def value(self, f: Any) -> int:
        if f in self.asked.branches:
            return self.at(self.asked.branches[f])
        if f.kind == "^":
            return self.raised(f, f.of[1].of[0]) if f.of[1].kind == "#" else self.powered(f)
        if f.kind in ("sin", "cos"):
            c, s = self.circle(self.terms(f.of[0]))
            for k in self.asked.halves(f.of[0]):
                self.square((s, -c, -s, c)[k % 4])
            return s if f.kind == "sin" else c
        if f.kind == "exp":
            return self.product(lambda v: self.powers[v] if v in self.powers else self.positive("exp", v), f.of[0])
        if "germ" in self.asked.form and f.kind in MORE:
            raise Stop("not shown", f"{f.kind[:40]} near 0")
        if "germ" not in self.asked.form and f.kind in {*MORE, *ARCS, *AREAS, "log", "atan2"}:
            return self.function(f, *(self.at(x) for x in f.of))
        found = super().value(f)
        if f.kind == "#" and self.asked.is_positive(f):
            self.sure.add(found)
        if f.kind == "*":
            self.keep(found, *map(self.at, f.of))
        return found

    def terms(self, f: Any) -> dict[int, Fraction]:
        """Besides: a name that is given, or a branch, is a sum of the terms of what it is."""
        if f.kind == "^" and f.of[1].kind != "#":
            return {self.at(f): Fraction(1)}
        if f in self.asked.branches:
            return self.terms(self.asked.branches[f])
        if f.kind == "." and f.of[0] in self.asked.given and f.of[0] not in self.fixed:
            return self.terms(self.asked.given[f.of[0]])
        return {v: r for v, r in super().terms(f).items() if v}

    # -- powers

    def keep(self, found: int, *of: int) -> None:
        """A product of squares is one, and its root that of these."""
        if {*of} <= self.sure:
            self.sure.add(found)
        elif {*of} <= self.seen | self.sure:
            self.seen.add(found)

    def raised(self, f: Any, r: Fraction) -> int:
        """A power."""
        base, a, claim = f.of[0], self.at(f.of[0]), self.asked
        positive = claim.is_positive(base)
        if claim.bases and r < 0 and base.kind in "+." and not positive and claim.is_above(base, False):
            self.above(base)
        if positive:
            self.sure.add(a)
        elif r.denominator > 1 and base.kind != "#":
            self.above(base)
        found = self.root(a, r)
        if a in self.sure or r.denominator % 2:  # else what the root has for its own root isn't known
            self.keep(found, a)
        return found

    def powered(self, f: Any) -> int:
        """A power of what is positive; the exponent is a sum with names in it."""
        base, x, claim = f.of[0], self.at(f.of[0]), self.asked
        root = base.kind == "^" and base.of[1].kind == "#" and base.of[1].of[0].denominator % 2 == 0
        if not root:
            if x not in self.seen | self.sure and not claim.is_above(base):
                raise Stop("not shown", "a power of what may be negative")
            self.above(base)
        found = self.product(lambda v: x if v == 1 else self.positive("power", x, v), f.of[1])
        if x in self.sure or 1 not in self.terms(f.of[1]):
            self.sure.add(found)
        return found

    def product(self, base: Any, exponent: Any) -> int:
        """The product of what an exponent's terms are the exponents of."""
        found = 1
        for v, r in self.terms(exponent).items():
            found = found * self.root(base(v), r) % self.p
        return found

    # -- functions

    def function(self, f: Any, a: int, b: int = 0) -> int:
        """The value of another function; what is known of it beside its value is kept."""
        p, kind = self.p, f.kind
        if kind in JACOBI:
            return self.jacobi(f, a, b)[JACOBI.index(kind)]
        if kind in ("elliptic_k", "elliptic_e"):  # by the smaller one of m and m/(m − 1)
            below = self.positive_at("1 - a", *f.of)
            other, turned = a * pow(a - 1, -1, p) % p, Fraction(-1 if kind == "elliptic_k" else 1, 2)
            return self.any(kind, a) if a <= other else self.root(below, turned) * self.any(kind, other) % p
        if kind in MORE:
            return self.any(kind, a, b)
        if kind in ("log", *AREAS):
            v = self.any(kind, a)
            if kind == "log":
                base = self.positive_at("a", *f.of)
            elif kind == "atanh":
                base = (1 + a) * self.root(self.positive_at("1 - a**2", *f.of), -HALF)
            elif kind == "asinh":
                base = a + self.root(self.positive_at("a**2 + 1", *f.of), HALF)
            else:
                base = a + self.root(self.positive_at("a - 1", *f.of) * self.positive_at("a + 1", *f.of), HALF)
            self.powers[v] = self.square(base)
            return v
        if kind == "atan2" and not self.asked.is_above(f.of[1]):
            v, r = self.any("atan2", a, b), self.root(self.positive_at("a**2 + b**2", *f.of), -HALF)
            self.turns[v] = b * r % p, a * r % p
            return v
        if kind in ("atan", "atan2"):
            if kind == "atan2":
                a = a * pow(self.positive_at("b", *f.of), -1, p) % p
            r = self.root(self.positive_at("a**2 + b**2" if kind == "atan2" else "1 + a**2", *f.of), -HALF)
            c, s = (b * r, a * b * r) if kind == "atan2" else (r, a * r)
            return self.arc(c % p, s % p)
        other = self.root(self.positive_at("1 - a**2", *f.of), HALF)
        if kind == "asin":
            return self.arc(other, a)
        v = (self.text("pi/2") - self.arc(other, a)) % p
        self.turns[v] = a, other
        return v

    def arc(self, c: int, s: int) -> int:
        """The angle between −π/2 and π/2 with this sine, and this cosine, which is positive."""
        tangent = s * pow(c, -1, self.p) % self.p
        v = self.any("arc", tangent) if tangent <= self.half else -self.any("arc", self.p - tangent) % self.p
        self.turns[v] = c, s
        return v

    def jacobi(self, f: Any, a: int, b: int) -> tuple[int, int, int]:
        """sn, cn and dn. For m = 0 and m = 1 the curve has two parts: more points are needed."""
        claim, p = self.asked, self.p
        below = f.of[1] in claim.moduli or claim.is_above(claim.formula("1 - a", f.of[1]))
        if b in (0, 1) and not below and ("jacobi", a, b, 2) not in self.free:
            self.step(1)
        while ("jacobi", a, b, 2) not in self.free:
            v = RANDOM.randrange(2, p)
            s, c = 2 * v * pow(1 + v * v, -1, p), (1 - v * v) * pow(1 + v * v, -1, p)
            square = (1 - b * s * s) % p
            if pow(square, self.half, p) == 1:
                d = pow(square, self.fraction(HALF, self.half), p) * RANDOM.choice((1, -1))
                self.free |= {("jacobi", a, b, k): x % p for k, x in enumerate((s, c, d))}
        s, c, d = (self.free["jacobi", a, b, k] for k in range(3))
        if below:
            self.square(d)
        return s, c, d

    # -- angles

    def circle(self, terms: Any) -> tuple[int, int]:
        """(cos, sin): quarters of a turn are known, and arcs and halves of them are."""
        p, pi, quarters, rest, c, s = self.p, self.text("pi"), 0, dict[int, Fraction](), 1, 0
        for v, r in terms.items():
            if v not in (pi, *self.turns) or (2 * r).denominator > 1:
                rest[v] = r
            elif v == pi:
                quarters = int(2 * r)
            else:
                x, y = self.turns[v]
                if r.denominator > 1:  # less than a right angle
                    x, y = (h := self.root((1 + x) * pow(2, -1, p) % p, HALF)), y * pow(2 * h, -1, p)
                y *= 1 if r > 0 else -1
                for bit in f"{abs(r.numerator):b}"[::-1]:
                    c, s = ((c * x - s * y) % p, (c * y + s * x) % p) if bit == "1" else (c, s)
                    x, y = (x * x - y * y) % p, 2 * x * y % p
        x, y = super().circle(rest)
        c, s = (c * x - s * y) % p, (c * y + s * x) % p
        return ((c, s), (-s % p, c), (-c % p, -s % p), (s, -c % p))[quarters % 4]


def shown(claim: Any, of_kind: Any = Values) -> tuple[str, str]:
    """The answer about a claim."""
    return alone_squares.shown(claim, of_kind)
