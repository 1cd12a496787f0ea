"""Inequalities, by what is seen to be positive: `python alone_signs.py CERTIFICATE.json …`

`alone.py` reads the claim. Its formulas become quotients of polynomials with exact fractions, in names that are
positive and names that are real: a root is a positive name w with wⁿ = its radicand, an exponential a positive name, a
cosine and a sine (1 − u²)/(1 + u²) and 2 u/(1 + u²), any other function a real name. What holds for all values of these
holds for those that they have. A condition of the domain is put into them, and all its points are kept: v > L as v =
L + s, 0 < v < U as v = U s/(1 + s), with a new name s > 0. A polynomial is seen to be positive by its coefficients, as
a quadratic one by its discriminant, with a root by squares, and for a real name by cases.
"""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import count
from math import isqrt
from typing import Any

if __package__:
    from canon.checker import alone
    from canon.checker import alone_polynomials as of
    from canon.checker.counterexample import Arithmetic, Open, Point
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_polynomials as of  # type: ignore
    from counterexample import Arithmetic, Open, Point  # type: ignore

Stop, ONE, plus, times, power, minus = alone.Stop, of.ONE, of.plus, of.times, of.power, of.minus
named, number, by_powers, names_in = of.named, of.number, of.by_powers, of.names_in
MOST_WORK, DEEPEST = 20_000, 6


class Signs:
    """What is positive in the domain of a claim; `flat` are angles that are π."""

    late: Any = str  # the order in which names are solved for
    everywhere = False  # without such cases sines and cosines are names, but of angles between 0 and π

    def __init__(self, claim: alone.Claim, flat: Any = ()) -> None:
        self.claim, self.flat, self.count, self.work = claim, flat, count(), 0
        self.sure = {"pi"}  # names that are positive
        self.roots = dict[str, tuple[int, of.Quotient]]()  # w: (n, wⁿ), each after those in its radicand
        self.put = dict[str, of.Quotient]()  # what stands in a name's place
        self.seen = dict[Any, str]()  # the names of roots and functions
        self.angles = list[Any]()
        for words in (re.split(r"(<=|>=|<|>)", text) for text in claim.domain.get("where", [])):
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                if sign in "<>" and "=" not in a + b:
                    self.use(self.quotient(claim.read(f"({b}) - ({a})" if sign == "<" else f"({a}) - ({b})"))[0])

    def spend(self, n: int = 1) -> None:
        """Stop where it takes too long."""
        self.work += n
        if self.work > MOST_WORK:
            raise Stop("not shown", "a sign that takes so long")

    def new(self, key: Any, positive: bool) -> str:
        """The name of something; the same for the same."""
        if key not in self.seen:
            self.seen[key] = f"#{next(self.count)}"
            self.sure |= {self.seen[key]} if positive else set()
        return self.seen[key]

    def structure(self, f: Any) -> Any:
        """What a formula is, to compare it with others."""
        self.spend()
        if f.kind == "." and f.of[0] in self.claim.texts:
            return self.structure(self.claim.known(self.claim.texts[f.of[0]]))
        return (f.kind, f.orders, *(self.structure(x) if isinstance(x, alone.Formula) else x for x in f.of))

    def quotient(self, f: Any) -> of.Quotient:
        """A formula as a quotient."""
        self.spend()
        if f.kind == "#":
            return number(f.of[0]), ONE
        if f.kind == "." and f.of[0] in self.claim.texts:
            return self.quotient(self.claim.known(self.claim.texts[f.of[0]]))
        if f.kind == ".":
            self.sure |= {*f.of} if "positive" in self.claim.words.get(f.of[0], ()) else set()
            return self.at(named(f.of[0]))
        if f.kind in "+*":
            a, b = map(self.quotient, f.of)
            return of.added(a, b) if f.kind == "+" else of.multiplied(a, b)
        if f.kind == "^" and f.of[1].kind == "#":
            return self.raised(self.quotient(f.of[0]), f.of[1].of[0])
        if f.kind in ("sin", "cos"):
            return self.turn(f.kind == "sin", f.of[0])
        positive = f.kind == "exp" or ("positive" in self.claim.words.get(f.kind, ()) and not any(f.orders))
        return named(self.new(self.structure(f), positive)), ONE

    def turn(self, sine: bool, angle: Any) -> of.Quotient:
        """The sine, or the cosine, of an angle; that of π has no u."""
        a, key = self.quotient(angle), self.structure(angle)
        quarters = 2 * a[0].get((("pi", 1),), Fraction(0))
        if a == (times(number(quarters / 2), named("pi")), ONE) and quarters.denominator == 1:
            return number((1, 0, -1, 0)[int(quarters - sine) % 4]), ONE
        half = self.shown(a[0], True) and self.shown(plus(times(named("pi"), a[1]), minus(a[0])), True)  # below π
        self.angles += [key] if key not in self.angles and not half else []
        if key in self.flat:
            return number(sine - 1), ONE
        if self.everywhere and not half:
            return named(self.new((sine, key), False)), ONE
        u = named(self.new(("angle", key), half))
        return (times(number(2), u) if sine else plus(ONE, minus(power(u, 2)))), plus(ONE, power(u, 2))

    def raised(self, base: of.Quotient, r: Fraction) -> of.Quotient:
        """A power; a root is a positive name, as it has a value."""
        n, d = base
        if r.denominator > 1:
            square = times(n, d)  # √(n/d) = √(n d)/d
            (m, c), *more = [*square.items(), ((), Fraction(0))]
            low = Fraction(isqrt(c.numerator), isqrt(c.denominator)) if c > 0 else Fraction(0)
            even = all(x in self.sure and k % 2 == 0 for x, k in m)
            if r.denominator == 2 and low**2 == c and even and len(more) == 1:
                n = {tuple((x, k // 2) for x, k in m): low}
            else:
                w = self.new(("root", r.denominator, *sorted(n.items()), *sorted(d.items())), True)
                self.roots[w], n, d = (r.denominator, base), named(w), ONE
        if r < 0:
            if not self.shown(n, True):
                positive = self.shown(minus(n), True)
                n, d = (minus(n), minus(d)) if positive else (power(n, 2), times(n, d))
            n, d = d, n
        return power(n, abs(r.numerator)), power(d, abs(r.numerator))

    def at(self, p: of.Polynomial) -> of.Quotient:
        """A polynomial with what stands in the place of names."""
        if not {*names_in(p)} & {*self.put}:
            return p, ONE
        found: of.Quotient = ({}, ONE)
        for m, c in p.items():
            term: of.Quotient = (number(c), ONE)
            for name, k in m:
                n, d = self.at_name(name)
                term = of.multiplied(term, (power(n, k), power(d, k)))
            found = of.added(found, term)
        return found

    def at_name(self, name: str) -> of.Quotient:
        if name not in self.put:
            return named(name), ONE
        n, d = map(self.at, self.put[name])
        return times(n[0], d[1]), times(n[1], d[0])

    def use(self, p: of.Polynomial) -> None:
        """Use that p > 0, for one name in it: all values with p > 0 are kept, and others may come."""
        for v in sorted(names_in(p), key=self.late):
            powers, s = by_powers(p, v), f"#{next(self.count)}"
            if v[0] == "#" and v not in self.put and v in self.seen.values():
                continue
            (a, b), square = (powers.get(k, {}) for k in (1, 0)), powers.get(2, {})
            new: of.Quotient | None = None
            if {*powers} <= {0, 1} and self.shown(a, True) and (v not in self.sure or self.shown(minus(b), False)):
                new = plus(named(s), minus(b)), a  # a v + b = s
            elif {*powers} <= {0, 1} and self.shown(minus(a), True):
                a = minus(a)
                one = plus(ONE, named(s))  # b − a v = s, or v = b s/(a (1 + s))
                new = (times(b, named(s)), times(a, one)) if v in self.sure else (plus(b, minus(named(s))), a)
            elif {*powers} == {0, 2} and v not in self.sure and square == number(-1) and b == ONE:
                new = plus(named(s), minus(ONE)), plus(named(s), ONE)  # 1 − v² > 0
            if new:
                self.sure |= {s}
                self.put[v] = new
                return

    def plain(self, p: of.Polynomial) -> of.Polynomial:
        """The same with what stands for names and with roots in their lowest powers, times what is positive."""
        p = self.at(p)[0]
        for w in reversed([*self.roots]):
            n, base = self.roots[w]
            up, down = (self.at(x) for x in base)
            up, down = times(up[0], down[1]), times(up[1], down[0])
            powers = by_powers(p, w)
            top, found = max(powers, default=0) // n, dict[Any, Fraction]()
            for k, q in powers.items():
                q = times(times(q, named(w, k % n) if k % n else ONE), power(up, k // n))
                found = plus(found, times(q, power(down, top - k // n)))
            p = found if top else p
        return p

    def shown(self, p: of.Polynomial, strict: bool, depth: int = DEEPEST) -> bool:
        """Whether a polynomial is seen to be positive, or at least not negative."""
        p = self.plain(p)
        self.spend(1 + len(p))
        odd = [v for v in names_in(p) if v not in self.sure]
        if all(c > 0 and all(k % 2 == 0 for x, k in m if x in odd) for m, c in p.items()):
            return not strict or any(all(x not in odd for x, _ in m) for m in p)
        if depth == 0 or (not odd and all(c < 0 for c in p.values())):
            return False
        return (
            self.by_name(p, strict, depth - 1) or self.by_root(p, strict, depth - 1) or self.by_case(p, strict, depth)
        )

    def by_name(self, p: of.Polynomial, strict: bool, depth: int) -> bool:
        """Σ a vᵏ by its coefficients, and a v²ᵏ + b vᵏ + c by 4 a c − b²."""
        for v in names_in(p):
            powers = by_powers(p, v)
            if len(powers) == 1:  # a factor
                (k, rest), *_ = powers.items()
                even, left = (v in self.sure) or k % 2 == 0, times(rest, named(v))
                if even and not (strict and v not in self.sure) and self.shown(rest, strict, depth):
                    return True
                if not even and k > 1 and not strict and self.shown(left, strict, depth):
                    return True
                continue
            if v in self.sure or all(k % 2 == 0 for k in powers):
                least = powers.get(0, {})
                if (not strict or self.shown(least, True, depth - 2)) and all(
                    self.shown(q, False, depth - 2) for q in powers.values()
                ):
                    return True
            half = max(powers) // 2
            if {*powers} <= {0, half, 2 * half} and 2 * half in powers and v not in self.roots:
                a, b, c = (powers.get(k, {}) for k in (2 * half, half, 0))
                apart = plus(times(number(4), times(a, c)), minus(times(b, b)))
                if self.shown(a, False, depth - 1) and self.shown(c, strict, depth - 1):
                    return self.shown(apart, strict, depth - 1)
        return False

    def by_root(self, p: of.Polynomial, strict: bool, depth: int) -> bool:
        """a + b w with a root w, where a and b have different signs, by a² − b² w²."""
        for w in reversed([*self.roots]):
            powers = by_powers(p, w)
            if {*powers} != {0, 1} or self.roots[w][0] != 2:
                continue
            a, b = powers[0], powers[1]
            apart = plus(times(a, a), minus(times(times(b, b), named(w, 2))))
            if self.shown(a, False, depth) and self.shown(apart, strict, depth):
                return True
            if self.shown(b, False, depth) and self.shown(minus(apart), strict, depth):
                return True
        return False

    def by_case(self, p: of.Polynomial, strict: bool, depth: int) -> bool:
        """A real name is positive, negative or 0."""
        for v in names_in(p):
            powers = by_powers(p, v)
            if v in self.sure or all(k % 2 == 0 for k in powers) or v in self.touched():
                continue
            x = named(f"#{next(self.count)}")
            self.sure |= {name for name, _ in next(iter(x))}
            if strict and not self.shown(powers.get(0, {}), True, depth - 2):
                return False
            signs = (dict[Any, Fraction](), dict[Any, Fraction]())
            for k, q in powers.items():
                term = times(q, power(x, k))
                signs = plus(signs[0], term), plus(signs[1], minus(term) if k % 2 else term)
            return self.shown(powers.get(0, {}), strict, depth - 2) and all(
                self.shown(q, strict, depth - 2) for q in signs
            )
        return False

    def touched(self) -> set[str]:
        """Names in radicands."""
        return {x for _, base in self.roots.values() for q in base for x in names_in(self.at(q)[0])}


def claim_of(tables: Any) -> tuple[alone.Claim, str]:
    """What is greater than 0, or not less, as `_lhs - _rhs` or `_rhs - _lhs`; and whether it isn't 0."""
    claim = tables["claim"]
    if claim["kind"] != "inequality" or claim["relation"] not in ("<", "<=", ">", ">="):
        raise Stop("not shown", "a claim that is no inequality")
    left = {key: x for key, x in claim.items() if key != "relation"} | {"kind": "identity"}
    return alone.Claim({**tables, "claim": left}), claim["relation"]


def in_numbers(claim: alone.Claim, f: Any) -> bool:
    """Whether a number is seen to be positive in intervals. A value of a function that is declared may be any."""
    try:
        return Point(claim, {name: name for name in claim.words}, Arithmetic(256)).at(f)[0] > 0
    except (Open, Stop):
        return False


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    claim, relation = claim_of(data["tables"])
    f, strict = claim.read("_lhs - _rhs" if ">" in relation else "_rhs - _lhs"), "=" not in relation
    if in_numbers(claim, f):
        return "shown", ""
    first = Signs(claim)
    first.quotient(f)
    flats = [[k for n, k in enumerate(first.angles) if ways >> n & 1] for ways in range(1 << len(first.angles[:3]))]
    if len(first.angles) <= 3 and all(
        (signs := Signs(claim, flat)).shown(signs.quotient(f)[0], strict) for flat in (flats if strict else flats[:1])
    ):
        return "shown", ""
    return "not shown", "the sign of the difference"


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
