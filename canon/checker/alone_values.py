"""Values of the functions of `alone_special.py` at a random point, and what is positive there.

K(m) is (1 − m)^(−1/2) K(m/(m − 1)), and E(m) (1 − m)^(1/2) E(m/(m − 1)). sn, cn and dn of one argument are a random
point with sn² + cn² = 1, dn² + m sn² = 1, dn being positive where m < 1 is seen. The sine of an arcsine is its
argument, the exponential of a logarithm too; an arc is the same where its tangent is and its cosine is positive.

What is seen to be positive in the domain has to be a square: a sine of an angle between 0 and π, and a base of a power,
where `bases` says so. Names that the domain's conditions bound are chosen within their bounds, as far as may be.
"""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from functools import cache
from math import gcd, prod
from typing import Any

if __package__:
    from canon.checker import alone, alone_special, alone_wider
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_special  # type: ignore
    import alone_wider  # type: ignore

Stop, RANDOM, MORE = alone.Stop, alone.RANDOM, alone_special.MORE
JACOBI, ARCS, AREAS = (
    ("jacobi_sn/2", "jacobi_cn/2", "jacobi_dn/2"),
    ("asin", "acos", "atan"),
    ("asinh", "acosh", "atanh"),
)
PROBED, ENOUGH, MOST, FEW = 2, 4, 300, 8
FACTORS = prod(n for n in range(29, 2000) if all(n % k for k in range(2, 45) if k < n))


class Values(alone_wider.Placed):
    """A random point, with values of these functions; names in `fixed` have these values."""

    def __init__(self, claim: Any, prime: int) -> None:
        super().__init__(claim, prime)
        self.fixed, self.turns, self.powers = dict[str, int](), dict[int, tuple[int, int]](), dict[int, int]()
        self.given, self.seen, self.steps, self.kinds = cache(self.given), set[int](), list[bool](), set[Any]()

    def square(self, x: int) -> int:
        """What has to be positive; a square of what is so has no other root.

        What is refused at some points and not at others, modulo the same prime, is no square of a function, up to a
        number, so that its root leaves the cover of all points irreducible. Only others are counted, and what is after
        them.
        """
        x %= self.p
        seen = pow(x, self.half, self.p) == 1
        if seen and {x, pow(x, self.fraction(Fraction(1, 2), self.half), self.p)} & (self.seen | self.sure):
            self.seen.add(x)
            return x
        self.steps.append(seen)
        if not seen:
            raise alone.Elsewhere
        self.seen.add(x)
        return x

    def components(self) -> int:
        """The logarithm of the number of components that the roots may tell apart."""
        firm = (n for n in range(len(self.steps)) if n not in self.asked.loose)
        return len(self.steps) - next(firm, len(self.steps))

    def positive_at(self, text: str, *of: Any) -> int:
        """The value of a formula that has to be positive; one that differs by squares from another has its root."""
        f = self.asked.formula(text, *of)
        x, kind = self.at(f), self.asked.factor(f)
        if kind in self.kinds and kind:
            if pow(x, self.half, self.p) != 1:
                raise alone.Elsewhere
            self.seen.add(x)
        self.kinds.add(kind)
        return self.square(x)

    def check_domain(self) -> None:
        for words in (re.split(r"(<=|>=|<|>)", text) for text in self.claim.domain.get("where", [])):
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                text = f"({b}) - ({a})" if "<" in sign else f"({a}) - ({b})"
                if not self.asked.is_bound(text):
                    self.positive_at(text)
        for name in self.asked.put if self.asked.chosen_too else ():
            _ = "positive" in self.claim.words.get(name, ()) and self.square(self.named(name))
        for name in self.asked.names:  # what a map gives for a name is what is assumed of it
            said = {*self.claim.words.get(name, ())} if name in self.claim.texts else set[str]()
            if said & {"positive", "nonnegative", "negative"}:
                self.positive_at("-a" if "negative" in said else "a", self.claim.known(self.claim.texts[name]))

    def evaluate(self) -> None:
        """See that all vanishes, and isn't 0, that has to."""
        self.check_domain()
        if any(map(self.text, self.asked.zeros)):
            raise Stop("not shown", "that all of it is 0")
        self.check_scale()
        if isinstance(self.asked, alone_wider.Wider):
            self.check()

    def check_scale(self) -> None:
        """A scale that isn't stated is the same at another point, with these parameters: sign(x) isn't."""
        claim = self.asked
        if "_scale" not in claim.texts or claim.texts["_scale"] == "1":
            return
        if here := [a for a in alone.SMALL if (self.text("_scale") - a) % self.p == 0]:
            if claim.scale not in (None, *here):
                raise Stop("not shown", "that the scale is one number")
            claim.scale = here[0]
            return
        names = {*claim.words} - {*claim.variables}
        names = names.union(*(claim.within(name) for name in names & {*claim.put}))
        other = type(self)(claim, self.p)
        other.free = {k: x for k, x in self.free.items() if len(k) == 1 and k[0] in names}  # type: ignore
        other.check_domain()
        if other.text("_scale") != self.text("_scale"):
            raise Stop("not shown", "that the scale is one number")

    def check_apart(self, f: Any) -> None:
        """What is 1 everywhere, or another small number, is 0 nowhere."""
        if f(self) not in {a % self.p for a in alone.SMALL}:
            super().check_apart(f)

    def at(self, f: Any, *by: str) -> int:
        """The derivative of what doesn't contain a name by it is 0, where it has a value."""
        return super().at(f, *by) if {*by} <= self.asked.reach(f) else 0 * self.at(f)

    def named(self, name: str) -> int:
        if name in self.fixed or name == self.asked.zero:
            return self.fixed.get(name, 0)
        return self.given(name) if name in self.asked.put and name not in self.claim.texts else super().named(name)

    def given(self, name: str) -> int:
        """The value of a name within its bounds: by others, and by positive ones that are free."""
        if name not in self.asked.put:
            return self.positive(name) if name[0] == "#" else super().named(name)
        of = lambda x: sum(self.fraction(c, self.p) * self.monomial(m) for m, c in x.items())
        n, d = map(of, self.asked.put[name])
        return n * pow(d, -1, self.p) % self.p

    def positive(self, *key: Any) -> int:
        """A random number that is positive."""
        self.sure.add(x := self.any(*key) ** 2 % self.p)
        return x

    def monomial(self, m: Any) -> int:
        found = 1
        for name, k in m:
            found = found * pow(self.given(name), k, self.p) % self.p
        return found

    def value(self, f: Any) -> int:
        if f.kind == "^" and f.of[1].kind == "#":
            return self.raised(f, f.of[1].of[0])
        if f.kind in ("sin", "cos"):
            c, s = self.circle(self.terms(f.of[0]))
            for k in self.asked.halves(f.of[0]):
                self.square((s, -c, -s, c)[k % 4])
            return s if f.kind == "sin" else c
        if f.kind == "exp":
            found = 1
            for v, r in self.terms(f.of[0]).items():
                base = self.powers[v] if v in self.powers else self.positive("exp", v)
                found = found * (self.root(base, r) if v else 1) % self.p
            return found
        if "germ" in self.asked.form and f.kind in MORE:
            raise Stop("not shown", f"{f.kind[:40]} near 0")
        if "germ" in self.asked.form or f.kind not in {*MORE, *ARCS, *AREAS, "log", "atan2"}:
            return super().value(f)
        return self.function(f, *(self.at(x) for x in f.of))

    def raised(self, f: Any, r: Fraction) -> int:
        """A power."""
        a, claim = self.at(f.of[0]), self.asked
        if (
            claim.bases
            and r < 0
            and f.of[0].kind in "+."
            and not claim.is_positive(f.of[0])
            and claim.is_above(f.of[0], False)
        ):
            self.positive_at("a", f.of[0])
        if claim.is_positive(f.of[0]):
            self.sure.add(a)
        elif r.denominator > 1 and f.of[0].kind != "#":
            self.positive_at("a", f.of[0])
        return self.root(a, r)

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
        half = Fraction(1, 2)
        if kind in ("log", *AREAS):
            v = self.any(kind, a)
            if kind == "log":
                base = self.positive_at("a", *f.of)
            elif kind == "atanh":
                base = (1 + a) * self.root(self.positive_at("1 - a**2", *f.of), -half)
            elif kind == "asinh":
                base = a + self.root(self.positive_at("a**2 + 1", *f.of), half)
            else:
                base = a + self.root(self.positive_at("a - 1", *f.of) * self.positive_at("a + 1", *f.of), half)
            self.powers[v] = self.square(base)
            return v
        if kind == "atan2" and not self.asked.is_above(f.of[1]):
            v, r = self.any("atan2", a, b), self.root(self.positive_at("a**2 + b**2", *f.of), -half)
            self.turns[v] = b * r % p, a * r % p
            return v
        if kind in ("atan", "atan2"):
            if kind == "atan2":
                a = a * pow(self.positive_at("b", *f.of), -1, p) % p
            r = self.root(self.positive_at("a**2 + b**2" if kind == "atan2" else "1 + a**2", *f.of), -half)
            c, s = (b * r, a * b * r) if kind == "atan2" else (r, a * r)
            return self.arc(c % p, s % p)
        other = self.root(self.positive_at("1 - a**2", *f.of), half)
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
        """sn, cn and dn."""
        positive, p = self.asked.is_above(self.asked.formula("1 - a", f.of[1])), self.p
        while ("jacobi", a, b, 2) not in self.free:
            v = RANDOM.randrange(2, self.p)
            s, c = 2 * v * pow(1 + v * v, -1, self.p), (1 - v * v) * pow(1 + v * v, -1, self.p)
            square = (1 - b * s * s) % self.p
            if pow(square, self.half, self.p) == 1:
                d = pow(square, self.fraction(Fraction(1, 2), self.half), p) * RANDOM.choice((1, -1))
                self.free |= {("jacobi", a, b, k): x % self.p for k, x in enumerate((s, c, d))}
        if positive:
            self.square(self.free["jacobi", a, b, 2])
        return self.free["jacobi", a, b, 0], self.free["jacobi", a, b, 1], self.free["jacobi", a, b, 2]

    def circle(self, terms: Any) -> tuple[int, int]:
        """(cos, sin): quarters of a turn are known, and arcs are."""
        p, quarters, rest, c, s = self.p, 0, dict[int, Fraction](), 1, 0
        for v, r in terms.items():
            if v == self.text("pi") and (2 * r).denominator == 1:
                quarters = int(2 * r)
            elif v in self.turns and r.denominator == 1:
                x, y = self.turns[v][0], self.turns[v][1] * (1 if r > 0 else -1)
                for bit in f"{abs(int(r)):b}"[::-1]:
                    c, s = ((c * x - s * y) % p, (c * y + s * x) % p) if bit == "1" else (c, s)
                    x, y = (x * x - y * y) % p, 2 * x * y % p
            elif v:
                rest[v] = r
        x, y = super().circle(rest)
        c, s = (c * x - s * y) % p, (c * y + s * x) % p
        return ((c, s), (-s % p, c), (-c % p, -s % p), (s, -c % p))[quarters % 4]


def random_prime() -> int:
    """A prime as `alone.random_prime` gives it, where what has a small factor is passed over first."""
    while True:
        p = alone.MODULUS * RANDOM.getrandbits(127 - alone.MODULUS.bit_length()) - 1
        if p > 2**110 and gcd(p, FACTORS) == 1 and all(pow(RANDOM.randrange(2, p), p - 1, p) == 1 for _ in range(20)):
            return p


def shown(claim: Any, of_kind: Any = Values) -> tuple[str, str]:
    """The answer about a claim; first there is seen what is refused modulo a prime at some points and not at others."""
    claim.loose, done = set[int](), False
    for _ in range(PROBED):
        prime, met, passed = random_prime(), list[list[bool]](), 0
        while passed < ENOUGH and len(met) < MOST:
            point = of_kind(claim, prime)
            with suppress(alone.Elsewhere):
                point.evaluate()
                passed += 1
            met.append(point.steps)
        claim.loose |= {n for n in range(max(map(len, met))) if len({x[n] for x in met if len(x) > n}) > 1}
        done = done or passed > 0
    if not done:
        raise Stop("not shown", "points at which everything is positive that has to be")
    done, tried, needed = 0, 0, FEW
    while done < needed:
        point, tried = of_kind(claim, random_prime()), tried + 1
        if tried > alone.MOST_TRIED + 80 * done or needed > alone.TRIALS << alone.MOST_ROOTS:
            raise Stop("not shown", "points at which everything is positive that has to be, or so many roots")
        with suppress(alone.Elsewhere):
            point.evaluate()
            roots = point.components() if isinstance(point, Values) else len(point.roots)
            needed, done = max(needed, alone.TRIALS << roots if roots else FEW), done + 1
    return "shown", ""
