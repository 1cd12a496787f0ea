"""Integrals by an antiderivative, which the certificate has: `python alone_integrals.py CERTIFICATE.json …`

That its derivative is the integrand is seen at random points modulo random primes (`alone.py`), with x = (a + b s)/(1
+ s), s > 0, in the place of the variable, or a + s, b − s. Between the ends each radicand, denominator and argument of
a logarithm in either formula is seen to be positive, or not 0 (`alone_signs.py`); so they are smooth there. At the ends
the antiderivative is continuous: a root of 0 is 0, an arcsine of 1 is π/2. At infinity it has a limit.
"""

from __future__ import annotations

import re
import unicodedata
from fractions import Fraction
from functools import cache
from typing import Any

if __package__:
    from canon.checker import alone, alone_endless, alone_signs
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_endless  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore

Formula, Stop, RANDOM = alone.Formula, alone.Stop, alone.RANDOM
MOST_WORK = 100_000
ENDLESS = {"infinity": 1, "-infinity": -1}
KEYS = {"f", "variable", "from", "to", "equals", "antiderivative"}
ARCS = {"asin": (("0", "0"), ("1", "pi/2")), "atan": (("0", "0"), ("1", "pi/4")), "asinh": (("0", "0"),),
    "atanh": (("0", "0"),), "log": (("1", "0"),), "acosh": (("1", "0"),)}  # fmt: skip
"""Values that are known; of odd functions those at −1 follow."""


class Integral(alone.Claim):
    """∫ f from a to b over a name x, with an antiderivative."""

    def __init__(self, tables: Any, antiderivative: Any) -> None:
        said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
        self.work, self.has = 0, cache(self.has)
        x, ends = said["variable"], {f"_{key}": str(said[key]) for key in ("from", "to", "equals")}
        whole = alone.formulas({**tables, "claim": {**said, "antiderivative": antiderivative}})
        odd = re.search(r"(?<!\w)_", whole) or unicodedata.normalize("NFKC", whole) != whole or {*said} - KEYS
        words = tables.get("symbols", {}).get(x, "real")
        self.signed = words == "positive"
        besides = str([tables.get(key) for key in ("hamiltonian", "transformation", "generating_function")])
        odd = odd or words not in ("real", "positive") or x in {"pi", "infinity", *tables.get("definitions", {})}
        odd = odd or "infinity" in re.findall(r"\w+", str({**tables, "claim": ""}))  # a name, which is written so, too
        if odd or x in re.findall(r"\w+", besides):
            raise Stop("not shown", "an integral over such a name, or with other keys")
        identity = {"kind": "identity", "lhs": str(said["f"]), "rhs": str(antiderivative)}
        super().__init__({**tables, "symbols": {**tables.get("symbols", {}), x: "real"}, "claim": identity})
        self.positive = False
        self.x, self.texts, self.domain = x, self.texts | ends, tables.get("domain", {})
        self.ends = [ENDLESS.get(ends[key].strip()) or self.known(ends[key]) for key in ("_from", "_to")]
        self.f, self.antiderivative, self.equals = map(self.known, ("_lhs", "_rhs", "_equals"))
        where = [side for text in self.domain.get("where", []) for side in re.split("<=|>=|!=|<|>", text)]
        apart = [*(end for end in self.ends if not isinstance(end, int)), self.equals, *map(self.known, where)]
        if any(self.has(f) for f in apart):
            raise Stop("not shown", "what depends on the variable besides the integrand")
        self.limits = [self.antiderivative, self.antiderivative]
        self.given = {self.structure(g) for f in (self.f, *apart) for g in self.parts(f)}
        self.calls = {
            self.structure(self.bare(g)) for f in (self.f, *apart) for g in self.parts(f) if self.is_called(g)
        }

    def outer(self, f: Any, k: int) -> Any:
        """∂f/∂(its k-th argument); that of a is 1 where a is 0, too."""
        n = f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else 2
        return alone.number(n) if n in (0, 1) else super().outer(f, k)

    def is_called(self, f: Any) -> bool:
        """Whether it is a value of a function that is declared."""
        return "function" in self.words.get(f.kind, ())

    def spend(self) -> None:
        """Stop where it takes too long."""
        self.work += 1
        if self.work > MOST_WORK:
            raise Stop("not shown", "formulas that are so long")

    def bare(self, f: Any) -> Any:
        """The value of a function itself."""
        return Formula(f.kind, f.of, (0,) * len(f.of))

    def inner(self, f: Any) -> Any:
        """What a formula is made of; a definition's is what it says."""
        self.spend()
        if f.kind == "." and f.of[0] in self.texts:
            return [self.known(self.texts[f.of[0]])]
        return [g for g in f.of if isinstance(g, Formula)]

    def parts(self, f: Any) -> Any:
        """A formula and all within it."""
        yield f
        for g in self.inner(f):
            yield from self.parts(g)

    def structure(self, f: Any, end: Any = None) -> Any:
        """What a formula is, to compare it with others; with what stands for the variable at an end."""
        self.spend()
        if f.kind == "." and (f.of[0] in self.texts or (end is not None and f.of[0] == self.x)):
            return self.structure(*((self.known(self.texts[f.of[0]]), end) if f.of[0] in self.texts else (end,)))
        return (f.kind, f.orders, *(self.structure(x, end) if isinstance(x, Formula) else x for x in f.of))

    def has(self, f: Any) -> bool:
        """Whether the variable is in a formula."""
        return any(g.kind == "." and g.of[0] == self.x for g in self.parts(f))


class Between(alone_signs.Signs):
    """What is smooth between the ends, or continuous at one: the variable is `at`, a quotient."""

    everywhere = True

    def __init__(self, claim: Integral, end: int | None = None) -> None:
        super().__init__(claim)
        self.of, self.end, s = claim, end, of.named("#s")
        if end is not None:
            self.put[claim.x] = self.quotient(claim.ends[end])
            return
        a, b = (x if isinstance(x, int) else self.quotient(x) for x in claim.ends)
        self.sure |= {"#s"}
        if isinstance(a, int) or isinstance(b, int):
            if (isinstance(a, int) and a > 0) or (isinstance(b, int) and b < 0):
                raise Stop("not shown", "a range that runs upwards")
            if not isinstance(a, int) or not isinstance(b, int):
                one = a if not isinstance(a, int) else b if not isinstance(b, int) else ((), ())
                self.put[claim.x] = of.added(one, (s if isinstance(b, int) else of.minus(s), of.ONE))  # type: ignore
            return
        if not self.is_positive(of.added(b, (of.minus(a[0]), a[1]))):
            raise Stop("not shown", "a range that runs upwards")
        n = of.added(a, of.multiplied(b, (s, of.ONE)))
        self.put[claim.x] = n[0], of.times(n[1], of.plus(of.ONE, s))

    def is_positive(self, q: Any) -> bool:
        return self.shown(q[0], True)

    def check(self, f: Any, strict: bool = False) -> None:
        """See that a formula is smooth, or that at an end it is continuous. Raises Stop."""
        claim, inside = self.of, self.end is None or strict
        if not claim.has(f) and claim.structure(f) in claim.given:
            return  # the claim speaks of where it has a value
        for g in claim.inner(f):
            self.check(g, strict or f.kind == "D")
        if f.kind in ("#", ".", "D", *alone_endless.SMOOTH):
            return
        a = [self.quotient(g) for g in f.of if isinstance(g, Formula)]
        r = f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else None
        negative = [(of.minus(n), d) for n, d in a]
        less, more = ([of.added((of.ONE, of.ONE), x) for x in side] for side in (negative, a))
        if claim.is_called(f):
            end = None if self.end is None else claim.ends[self.end]
            right = (
                not isinstance(end, int) and claim.structure(claim.bare(f), end) in claim.calls
            )  # it is smooth where the claim calls it
        elif f.kind == "^" and r is not None and r.denominator == 1:
            right = r >= 0 or self.is_positive(a[0]) or self.is_positive(negative[0])
        elif f.kind == "^" and r is not None and r > 0 and not inside:
            right = True
        elif f.kind in ("^", "log"):
            right = self.is_positive(a[0])
        elif f.kind in ("asin", "acos", "atanh"):
            right = (not inside and f.kind != "atanh") or (self.is_positive(less[0]) and self.is_positive(more[0]))
        elif f.kind == "acosh":
            right = not inside or self.is_positive(of.added(a[0], (of.minus(of.ONE), of.ONE)))
        else:
            right = f.kind == "atan2" and any(map(self.is_positive, (a[1], a[0], negative[0])))
        if not right:
            raise Stop("not shown", f"that {f.kind[:40]} is smooth along the range")


class Along(alone.Point):
    """A random point of the range, or one of its ends."""

    def __init__(self, claim: Integral, prime: int, inside: Any = None, end: Any = None) -> None:
        super().__init__(claim, prime)
        self.of, self.end = claim, end
        if inside:
            self.x = inside.at(end)
            self.free, self.roots, self.sure, self.count = inside.free, inside.roots, inside.sure, inside.count

    def start(self) -> None:
        """Choose the point, by an s for which 1 + s is a square as well."""
        v = RANDOM.randrange(2, self.p)
        s = ((1 - v * v) * pow(2 * v, -1, self.p)) ** 2 % self.p
        a, b = (end if isinstance(end, int) else (self.at(end),) for end in self.of.ends)
        if isinstance(a, tuple) and isinstance(b, tuple):
            self.square((b[0] - a[0]) % self.p)
            self.x = (a[0] + b[0] * s) * pow(1 + s, -1, self.p) % self.p
        else:
            self.x = a[0] + s if isinstance(a, tuple) else b[0] - s if isinstance(b, tuple) else self.any("x")
        if self.of.positive:
            self.square(self.x % self.p)

    def named(self, name: str) -> int:
        return self.x % self.p if name == self.of.x else super().named(name)

    def root(self, x: int, r: Fraction) -> int:
        return 0 if self.end and not x and r > 0 else super().root(x, r)

    def terms(self, f: Any) -> dict[int, Fraction]:
        return self.terms(self.end) if self.end and f.kind == "." and f.of[0] == self.of.x else super().terms(f)

    def value(self, f: Any) -> int:
        """Arcs have values that are known, and arcsines and such ones are odd."""
        if f.kind == "acos":
            return (self.text("pi/2") - self.at(Formula("asin", f.of))) % self.p
        if f.kind not in ARCS:
            return super().value(f)
        a, odd = self.at(f.of[0]), f.kind not in ("log", "acosh")
        for where, what in ARCS[f.kind]:
            for sign in (1, -1) if odd else (1,):
                if (a - sign * int(where)) % self.p == 0:
                    return sign * self.text(what) % self.p
        sign = -1 if odd and a > self.half else 1
        return sign * self.any(f.kind, sign * a % self.p) % self.p

    def circle(self, terms: Any) -> tuple[int, int]:
        """Quarters of a turn are known."""
        quarters = 2 * terms.get(pi := self.text("pi"), Fraction(0))
        if quarters.denominator > 1:
            return super().circle(terms)
        c, s = super().circle({v: r for v, r in terms.items() if v != pi})
        return ((c, s), (-s, c), (-c, -s), (s, -c))[int(quarters) % 4]


def sample(claim: Integral, prime: int, kind: Any = Along) -> int:
    """See at one point that the derivative is the integrand, and what the antiderivative is at the ends."""
    point = kind(claim, prime)
    point.check_domain()
    point.start()
    if point.text(f"D(_rhs, {claim.x}) - _lhs"):
        raise Stop("not shown", "that the antiderivative is one")
    values = []
    for end, limit in zip(claim.ends, claim.limits, strict=True):
        at = point if isinstance(end, int) else kind(claim, prime, point, end)
        values.append(at.at(limit))
    if (values[1] - values[0] - point.at(claim.equals)) % prime:
        raise Stop("not shown", "that this is the integral's value")
    return len(point.roots)


def shown(data: Any, by: Any = sample, of_kind: Any = Between) -> tuple[str, str]:
    """The answer about the claim, by the certificate's antiderivative."""
    if data["tables"]["claim"]["kind"] != "integral" or "antiderivative" not in data["known"]:
        raise Stop("not shown", "no integral, or without an antiderivative")
    claim = Integral(data["tables"], data["known"]["antiderivative"])
    between = of_kind(claim)
    claim.positive = between.is_positive(between.at(of.named(claim.x)))
    if claim.signed and not claim.positive:
        raise Stop("not shown", "that what is assumed of the variable holds along the range")
    between.check(claim.f)
    between.check(claim.antiderivative)
    for n, end in enumerate(claim.ends):
        if isinstance(end, int):
            claim.limits[n] = alone_endless.Endless(claim, end).limit(claim.antiderivative)
        else:
            of_kind(claim, n).check(claim.antiderivative)
    return alone.tried(by, claim)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
