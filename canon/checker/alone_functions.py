"""What `alone.py` leaves free among functions: right angles, arcs, logarithms, Jacobi's functions, names in exponents.

A random point modulo a prime, for the files that ask for identities. The cosine of arctan2(y, x) is x/√(x² + y²), that
of half of it the positive root of half of 1 + cos; exp(log x) is x. sn, cn and dn of an argument and a modulus are a
random point of the curve sn² + cn² = 1, dn² + m sn² = 1. x^n with a name in n is a positive number where x is one.
What is said of positive here is what `alone.py` says: a square. Products of squares aren't counted as roots that may go
wrong, as they are squares for certain. What the domain's conditions say of a name alone is used to choose it.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from math import prod
from typing import Any

if __package__:
    from canon.checker import alone, alone_wider
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_wider  # type: ignore

Formula, Stop, Elsewhere = alone.Formula, alone.Stop, alone.Elsewhere
SN, CN, DN = (f"jacobi_{x}" for x in ("sn", "cn", "dn"))
EPSILON, LEFT = "the integral of dn squared", "((1 - b)*a - e)"
JACOBI = {
    SN: (f"{CN}(a, b)*{DN}(a, b)", f"({LEFT}*{CN}(a, b)*{DN}(a, b)/b + {SN}(a, b)*{CN}(a, b)**2)/(2*(1 - b))"),
    CN: (f"-{SN}(a, b)*{DN}(a, b)", f"-({LEFT}*{SN}(a, b)*{DN}(a, b)/b + {SN}(a, b)**2*{CN}(a, b))/(2*(1 - b))"),
    DN: (f"-b*{SN}(a, b)*{CN}(a, b)", f"-({LEFT}*{SN}(a, b)*{CN}(a, b) + {SN}(a, b)**2*{DN}(a, b))/(2*(1 - b))"),
    EPSILON: (
        f"{DN}(a, b)**2",
        f"(e - a)/(2*b) + {DN}(a, b)*({LEFT}*{DN}(a, b)/b + {SN}(a, b)*{CN}(a, b))/(2*(1 - b))",
    ),
}  # fmt: skip
"""Their derivatives by the argument a and the parameter b = m = k², with e = ∫ dn² da from 0."""
ARCS, LOGS = ("atan2", "asin", "acos", "atan"), ("log", "asinh", "acosh", "atanh")
HALF, TRIES, MOST_INSIDE = Fraction(1, 2), 4000, 300


def names_of(f: Any) -> frozenset[str]:
    """The names that stand in a formula, also where it is differentiated."""
    inner = [names_of(x) for x in f.of if isinstance(x, Formula)]
    return frozenset({f.of[0]} if f.kind == "." else ()).union(*inner)


class Calls:
    """What is read besides: a claim with Jacobi's functions; and where a name's value is that of a formula."""

    form: Any = {}  # noqa: RUF012
    places: Any = ()
    besides: Any = ()
    nonzero: Any = ()

    def __init__(self, tables: Any) -> None:
        self.given = dict[str, Any]()  # name: the formula that says its value; derivatives by the name are taken before
        self.facts = list[Any]()  # formulas that are positive wherever all formulas of the claim have values
        self.branches = dict[Any, Any]()  # an arc of a sine: what it is on the domain
        self.moduli = set[Any]()  # those of Jacobi's functions that are less than 1
        self.cosh = list[Any]()  # what hyperbolic cosines are taken of
        super().__init__(tables)  # type: ignore[call-arg]
        self.conditions = cache(self.conditions)
        self.outer = cache(self.steep)
        if {SN, CN, DN} & {*self.words, *self.texts, *self.names}:  # type: ignore[attr-defined]
            raise Stop("not shown", "names with two meanings")

    def conditions(self) -> list[tuple[Any, list[tuple[str, Any, int]]]]:
        """What is positive in the domain; and names that stand alone there, above (1) or below (-1) a formula."""
        found, own = list[Any](), self
        names = {*own.names, *own.words} - {*own.texts} - {*self.given}  # type: ignore[attr-defined]
        for words in (re.split(r"(<=|>=|<|>)", text) for text in own.domain.get("where", [])):  # type: ignore
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                a, b = (b, a) if "<" in sign else (a, b)
                alone_there = list[Any]()
                for one, other, up in ((a.strip(), b, 1), (b.strip(), a, -1)):
                    f = self.known(other)  # type: ignore[attr-defined]
                    if one in names and not self.is_function(one) and not names_of(f) & {one, *self.given}:
                        alone_there.append((one, f, up))
                found.append((self.known(f"({a}) - ({b})"), alone_there))  # type: ignore[attr-defined]
        return found

    def is_function(self, name: str) -> bool:
        """Whether a name is declared as one."""
        return "function" in self.words.get(name, ())  # type: ignore[attr-defined]

    def made(self, kind: str, *of: Any) -> Any:
        if kind in (SN, CN, DN) and len(of) == 2:
            return Formula(kind, of)
        if kind == "cosh" and len(of) == 1:
            self.cosh.append(of[0])
        return super().made(kind, *of)  # type: ignore[misc]

    def steep(self, f: Any, k: int) -> Any:
        """∂f/∂(its k-th argument)."""
        if f.kind in JACOBI:
            own = dict(zip("ab", f.of, strict=True)) | {"e": Formula(EPSILON, f.of)}
            return self.read(JACOBI[f.kind][k], own)  # type: ignore[attr-defined]
        return alone.Claim.outer(self, f, k)  # type: ignore[arg-type]


class Small(Calls, alone.Claim):
    """A claim that `alone` knows."""


class Wide(Calls, alone_wider.Wider):
    """One of the table."""


class Functions(alone_wider.Placed):
    """A random point; some names may be `held` at a value."""

    roots: set[int]
    sure: set[int]
    free: dict[Any, int]

    def __init__(self, claim: Any, prime: int, held: Any = None) -> None:
        super().__init__(claim, prime)
        self.held, self.arcs, self.logs = dict[str, int](held or {}), dict[int, Any](), dict[int, Any]()
        self.curves, self.turned = dict[Any, Any](), cache(self.turned)

    # -- names

    def named(self, name: str) -> int:
        """The value of a name: one that is held, or that of what gives it."""
        if name in self.held:
            return self.held[name]
        if name not in self.asked.given:  # type: ignore[attr-defined]
            return super().named(name)
        return self.signed(name, self.at(self.asked.given[name]))  # type: ignore[attr-defined]

    def signed(self, name: str, value: int) -> int:
        """A value, which has the sign that the name has."""
        if (said := {*self.claim.words.get(name, ())}) & {"positive", "nonnegative", "negative"}:
            self.square(value * (-1 if "negative" in said else 1) % self.p)
            self.sure.add(value)
        return value

    def check_domain(self) -> None:
        """Choose names for which the domain's conditions hold, where they stand alone; then see that all hold."""
        claim: Any = self.asked
        for f, choices in claim.conditions():
            for choice in choices:
                self.choose(*choice)
            self.sure.add(self.square(self.at(f)))
        for f in claim.facts:
            self.sure.add(self.square(self.at(f)))

    def choose(self, name: str, other: Any, sign: int) -> None:
        """A name above, or below, a formula without it: by a square."""
        if name in self.held or (name,) in self.free:
            return
        value = self.at(other) + sign * self.any("step", name) ** 2
        if (said := {*self.claim.words.get(name, ())}) & {"positive", "nonnegative", "negative"}:
            value = self.root(value * (-1 if "negative" in said else 1) % self.p, HALF)
        self.free.setdefault((name,), value % self.p)

    # -- functions

    def value(self, f: Any) -> int:
        if f in self.asked.branches:  # type: ignore[attr-defined]
            return self.at(self.asked.branches[f])  # type: ignore[attr-defined]
        if f.kind == "^" and f.of[1].kind != "#":
            return self.raised(f)
        if f.kind == "exp":
            return prod(self.rooted(self.exponential(v), r) for v, r in self.terms(f.of[0]).items()) % self.p
        if f.kind in JACOBI:
            u, m = map(self.at, f.of)
            return self.curve(u, m, f.of[1] in self.asked.moduli)[[*JACOBI].index(f.kind)]
        found = super().value(f)
        if f.kind in ARCS:
            self.arcs[found] = f
        if f.kind in LOGS:
            self.logs[found] = f
        if f.kind == "#":
            n, d = f.of[0].as_integer_ratio()
            certain = n > 0 and pow(alone.MODULUS, alone.LONGEST, n * d) == 0
        else:
            certain = f.kind in "*^" and all(self.at(x) in self.sure for x in (f.of if f.kind == "*" else f.of[:1]))
        self.sure |= {found} if certain else set()
        return found

    def rooted(self, x: int, r: Fraction) -> int:
        """x^r, with the root counted among those that may go wrong."""
        self.roots |= {x} - self.sure if r.denominator % 2 == 0 else set()
        return self.root(x, r)

    def raised(self, f: Any) -> int:
        """A power of what is positive; the exponent is a sum with names in it."""
        base, x = f.of[0], self.at(f.of[0])
        is_root = base.kind == "^" and base.of[1].kind == "#" and base.of[1].of[0].denominator % 2 == 0
        if x not in self.sure and not is_root:
            raise Stop("not shown", "a power of what may be negative")
        self.square(x)
        found, powers = 1, self.terms(f.of[1]).items()
        for v, r in powers:
            found *= self.rooted(x, r) if v == 1 else self.root(self.any("power", x, v) ** 2 % self.p, r)
        self.sure.add(found % self.p)
        return found % self.p

    def exponential(self, v: int) -> int:
        """exp of a term: of a logarithm what it is the logarithm of, which is positive; of any other a square."""
        if v not in self.logs:
            return self.any("exp", v) ** 2 % self.p
        f = self.logs[v]
        a, p = self.at(f.of[0]), self.p
        if f.kind == "log":
            x = a
        elif f.kind == "asinh":
            x = a + self.rooted((a * a + 1) % p, HALF)
        elif f.kind == "acosh":
            x = a + self.rooted((a - 1) % p, HALF) * self.rooted((a + 1) % p, HALF)
        else:
            x = self.rooted((1 + a) * pow(1 - a, -1, p) % p, HALF)
        return self.square(x % p)

    def curve(self, u: int, m: int, below: bool) -> tuple[int, ...]:
        """(sn, cn, dn, ε); dn is positive for m `below` 1, and else, as the others, of either sign.

        Twice as many points are asked for, as for m = 0 and 1 the curve has two parts.
        """
        p = self.p
        if (u, m) not in self.curves:
            squares = ((s, (1 - s * s) % p, (1 - m * s * s) % p) for s in iter(lambda: alone.RANDOM.randrange(2, p), 0))
            s, c, d = next(x for x in squares if pow(x[1], self.half, p) == pow(x[2], self.half, p) == 1)
            either = lambda x: self.root(x, HALF) * alone.RANDOM.choice((1, -1)) % p
            self.curves[u, m] = s, either(c), self.root(d, HALF) if below else either(d), self.any(EPSILON, u, m)
            self.roots.add(d)
        return self.curves[u, m]

    def terms(self, f: Any) -> dict[int, Fraction]:
        if f.kind == "D" or (f.kind == "^" and f.of[1].kind != "#"):
            return {self.at(f): Fraction(1)}  # not by the value of what is differentiated, which may be another's here
        given: Any = self.asked.given if f.kind == "." and f.of[0] not in self.held else {}  # type: ignore
        if f in self.asked.branches:  # type: ignore[attr-defined]
            return self.terms(self.asked.branches[f])  # type: ignore[attr-defined]
        found = self.terms(given[f.of[0]]) if f.of[0] in given else super().terms(f)
        return {v: r for v, r in found.items() if v}

    # -- angles

    def circle(self, terms: dict[int, Fraction]) -> tuple[int, int]:
        """(cos, sin) of a sum, of right angles and arcs by what these are."""
        plain, c, s, p = dict[int, Fraction](), 1, 0, self.p
        for v, r in terms.items():
            if (turn := self.turned(v, r)) is None:
                plain[v] = r
            else:
                c, s = (c * turn[0] - s * turn[1]) % p, (c * turn[1] + s * turn[0]) % p
        x, y = super().circle(plain)
        return (c * x - s * y) % p, (c * y + s * x) % p

    def turned(self, v: int, r: Fraction) -> tuple[int, int] | None:
        """(cos, sin) of r v, where v is π or an arc and 2 r a whole number that isn't large."""
        n = 2 * r
        if n.denominator > 1 or abs(n) > alone.MOST_TERMS or (v != self.named("pi") and v not in self.arcs):
            return None
        p = self.p
        if v not in self.arcs:
            return ((1, 0), (0, 1), (p - 1, 0), (0, p - 1))[int(n) % 4]
        x, y = self.arc(self.arcs[v])
        if r.denominator > 1:  # less than a right angle
            x, y = (h := self.rooted((1 + x) * pow(2, -1, p) % p, HALF)), y * pow(2 * h, -1, p) % p
        c, s, n = 1, 0, int(n) if r.denominator > 1 else int(r)
        for _ in range(abs(n)):
            c, s = (c * x - s * y) % p, (c * y + s * x) % p
        return c, s if n > 0 else -s % p

    def arc(self, f: Any) -> tuple[int, int]:
        """(cos, sin) of an arc."""
        a, p = [self.at(x) for x in f.of], self.p
        if f.kind in ("asin", "acos"):
            other = self.rooted((1 - a[0] * a[0]) % p, HALF)
            return (a[0], other) if f.kind == "acos" else (other, a[0])
        y, x = a if f.kind == "atan2" else (a[0], 1)
        length = pow(self.rooted((x * x + y * y) % p, HALF), -1, p)
        return x * length % p, y * length % p


def sample(claim: Any, prime: int, of: Any = Functions) -> int:
    """See at one random point of the domain that all vanishes; returns the number of roots that were met."""
    tries = 0
    for _ in range(TRIES):
        point, inside = of(claim, prime), False
        try:
            point.check_domain()
            inside = True
            if any(map(point.text, claim.zeros)):
                raise Stop("not shown", "that all of it is 0")
            point.check()
        except Elsewhere:
            tries += inside
            if tries == MOST_INSIDE:
                break
            continue
        return len(point.roots)
    raise Stop("not shown", "points at which everything is positive that has to be")
