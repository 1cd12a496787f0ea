"""What is positive at a random point modulo a prime, and how many points are needed, for the small checkers beside it.

Positive means: a square (`alone.py`). What is seen to be positive in the domain (`alone_special.py`) has to be one;
names that the domain's conditions bound are chosen within their bounds, as far as may be. A root √c may tell components
of the cover of all points apart, on one of which alone something vanishes, only where c is a square of a function, up
to a number. What is refused at some points and not at others, modulo the same prime, is none, and leaves the cover
irreducible; so only what is never refused is counted, and what comes after it.
"""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction
from functools import cache
from math import prod
from typing import Any

if __package__:
    from canon.checker import alone, alone_wider
    from canon.checker.alone_special import UNIT
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_wider  # type: ignore
    from alone_special import UNIT  # type: ignore

Stop, Elsewhere, random_prime = alone.Stop, alone.Elsewhere, alone.random_prime
HALF, SIGNS = Fraction(1, 2), {"positive", "nonnegative", "negative"}
PROBED, PRIMES, ENOUGH, ALIKE, MOST, FEW, AGAIN = 2, 60, 4, 12, 300, 8, 10


class Squares(alone_wider.Placed):
    """A random point; names in `fixed` have these values.

    `sure` are squares for certain, of names that are chosen so; `seen` are those that were met and had to be squares.
    """

    sure: set[int]
    free: dict[Any, int]

    def __init__(self, claim: Any, prime: int, fixed: Any = None, free: Any = None) -> None:
        super().__init__(claim, prime)
        self.fixed, self.free = dict[str, int](fixed or {}), dict[Any, int](free or {})
        self.bounded, self.seen, self.steps, self.kinds = cache(self.bounded), set[int](), list[bool](), {(UNIT, UNIT)}

    # -- squares

    def step(self, x: int) -> None:
        """What has to be a square, and is counted if it is one at all points."""
        self.steps.append(pow(x, self.half, self.p) == 1)
        if not self.steps[-1]:
            raise Elsewhere

    def square(self, x: int) -> int:
        """What has to be positive; a square of what is so has no other root."""
        x %= self.p
        known = self.seen | self.sure
        if x not in known and pow(x, self.fraction(HALF, self.half), self.p) not in known:
            self.step(x)
        if pow(x, self.half, self.p) != 1:
            raise Elsewhere
        self.seen.add(x)
        return x

    def above(self, f: Any) -> int:
        """The value of a formula that has to be positive; one that differs by squares from another has its root."""
        x, kind = self.at(f), self.asked.factor(f)
        if kind in self.kinds and kind:
            if pow(x, self.half, self.p) != 1:
                raise Elsewhere
            self.seen.add(x)
        self.kinds.add(kind)
        return self.square(x)

    def positive_at(self, text: str, *of: Any) -> int:
        """The same of a text about formulas, which are called a and b in it."""
        return self.above(self.asked.formula(text, *of))

    def positive(self, *key: Any) -> int:
        """A random number that is positive."""
        self.sure.add(x := self.any(*key) ** 2 % self.p)
        return x

    def components(self) -> int:
        """The logarithm of the number of components that the roots may tell apart."""
        firm = (n for n in range(len(self.steps)) if n not in self.asked.loose)
        return len(self.steps) - next(firm, len(self.steps))

    # -- names

    def named(self, name: str) -> int:
        """The value of a name: one that is fixed, or that of what gives it, or one within its bounds."""
        if name in self.fixed or name == self.asked.zero:
            return self.fixed.get(name, 0)
        if name in self.asked.given:
            return self.signed(name, self.at(self.asked.given[name]))
        if name in self.asked.put and name not in self.claim.texts:
            return self.bounded(name)
        value = super().named(name)
        self.sure -= {value} if "negative" in self.claim.words.get(name, ()) else set()
        return value

    def signed(self, name: str, value: int) -> int:
        """A value, which has the sign that the name has."""
        if (said := {*self.claim.words.get(name, ())}) & SIGNS:
            self.square(-value if "negative" in said else value)
        return value

    def bounded(self, name: str) -> int:
        """The value of a name within its bounds: by others, and by positive ones that are free."""
        if name not in self.asked.put or name in self.fixed:
            return self.positive(name) if name[0] == "#" else self.named(name)
        of = lambda x: sum(self.fraction(c, self.p) * self.monomial(m) for m, c in x.items())
        n, d = map(of, self.asked.put[name])
        return n * pow(d, -1, self.p) % self.p

    def monomial(self, m: Any) -> int:
        return prod(pow(self.bounded(name), k, self.p) for name, k in m) % self.p

    def at(self, f: Any, *by: str) -> int:
        """The derivative of what doesn't contain a name by it is 0, where it has a value."""
        return super().at(f, *by) if {*by} <= self.asked.reach(f) else 0 * self.at(f)

    # -- the claim

    def check_domain(self) -> None:
        """See that all is positive that has to be in the domain."""
        claim: Any = self.asked
        for f in claim.conditions():
            if not claim.is_bound(f):
                self.above(f)
        for name in claim.put if claim.chosen_too else ():
            self.signed(name, self.named(name))
        for name in claim.names:  # what a map gives for a name is what is assumed of it
            said = {*claim.words.get(name, ())} & SIGNS if name in claim.texts else ()
            if said:
                self.positive_at("-a" if "negative" in said else "a", claim.known(claim.texts[name]))
        for f in claim.facts:
            self.above(f)

    def evaluate(self) -> None:
        """See that all vanishes, and isn't 0, that has to."""
        self.check_domain()
        if any(map(self.text, self.asked.zeros)):
            raise Stop("not shown", "that all of it is 0")
        self.check_scale()
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
        other.free = {k: x for k, x in self.free.items() if len(k) == 1 and k[0] in names}
        other.check_domain()
        if other.text("_scale") != self.text("_scale"):
            raise Stop("not shown", "that the scale is one number")

    def check_apart(self, f: Any) -> None:
        """What is 1 everywhere, or another small number, is 0 nowhere."""
        if f(self) not in {a % self.p for a in alone.SMALL}:
            super().check_apart(f)


def probe(claim: Any, of_kind: Any) -> list[Any]:
    """See what is refused modulo a prime at some points and not at others; where all are alike it is the prime.

    Returns the points that weren't refused.
    """
    claim.loose, found, good, bad = set[int](), list[Any](), 0, 0
    for _ in range(PRIMES):
        prime, met, passed = random_prime(), list[list[bool]](), 0
        while passed < ENOUGH and len(met) < MOST:
            point = of_kind(claim, prime)
            with suppress(Elsewhere):
                point.evaluate()
                found.append(point)
                passed += 1
            met.append(point.steps)
            if len(met) == ALIKE and not passed and len({*map(len, met)}) == 1:
                break
        claim.loose |= {n for n in range(max(map(len, met))) if len({x[n] for x in met if len(x) > n}) > 1}
        good, bad = good + (passed > 0), bad + (len(met) == MOST)
        if good + bad >= PROBED:
            break
    if not good:
        raise Stop("not shown", "points at which everything is positive that has to be")
    return found


def shown(claim: Any, of_kind: Any) -> tuple[str, str]:
    """The answer about a claim; a prime is kept while points are refused for what is refused at some points alone."""
    found = probe(claim, of_kind)
    if len(found) >= FEW and not any(point.components() for point in found):
        return "shown", ""
    done, tried, needed, prime = 0, 0, FEW, random_prime()
    while done < needed:
        point, tried = of_kind(claim, prime), tried + 1
        if tried > 3 * alone.MOST_TRIED + 200 * done or needed > alone.TRIALS << alone.MOST_ROOTS:
            raise Stop("not shown", "points at which everything is positive that has to be, or so many roots")
        try:
            point.evaluate()
            roots = point.components()
            needed, done = max(needed, alone.TRIALS << roots if roots else FEW), done + 1
        except Elsewhere:
            if tried % AGAIN and len(point.steps) - 1 in claim.loose:
                continue
        prime = random_prime()
    return "shown", ""
