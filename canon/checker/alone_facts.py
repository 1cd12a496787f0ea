"""Which of a claim's own formulas are positive, by `alone_signs.py`: points at which they aren't are thrown away.

√(x²) is x or −x, and with `alone.py` both occur: so √((u² + v²)²) is not u² + v². Here it is, as u² + v² is a part of
the claim that is positive for all u and v. Such a fact holds wherever the claim's formulas have values, in the domain;
a point modulo a prime at which it isn't a square is like no real one. What is looked at: sums in radicands and in what
is divided by; sines and cosines of angles that the domain holds in two right angles; cosh a ± cos b for a that isn't 0;
1 − m of a modulus. And arcs of sines, of angles that are there, are these up to a multiple of π.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone, alone_polynomials, alone_signs
    from canon.checker.alone_special import JACOBI
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_polynomials  # type: ignore
    import alone_signs  # type: ignore
    from alone_special import JACOBI  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
ONE, LAST = alone.number(1), "~pi"
MOST_PARTS, MOST_SUMS, MOST_WORK, TURNS = 2000, 24, 800, range(-3, 5)


class Everywhere(alone_signs.Signs):
    """Signs for all values of the names, angles that are π among them; in little time."""

    everywhere = True

    def spend(self, n: int = 1) -> None:
        super().spend(n * alone_signs.MOST_WORK // MOST_WORK)

    def use(self, p: Any) -> None:
        """Use that p > 0; what stands in a name's place stands in that of another one than π."""
        before = {*self.put}
        self.sure.add(LAST)
        super().use(renamed(p, "pi", LAST))
        self.put.pop(LAST, None)
        for v in {*self.put} - before:
            n, d = self.put[v]
            self.put[v] = renamed(n, LAST, "pi"), renamed(d, LAST, "pi")


def renamed(p: Any, old: str, new: str) -> Any:
    """A polynomial with another name for one."""
    return {tuple(sorted((new if x == old else x, k) for x, k in m)): c for m, c in p.items()}


def parts(claim: Any, formulas: Any) -> list[Any]:
    """All formulas within these, each once, those inside first."""
    found, seen = list[Any](), set[Any]()

    def walk(f: Any) -> None:
        if f in seen or len(seen) > MOST_PARTS:
            return
        seen.add(f)
        if f.kind == "." and f.of[0] in claim.given:
            walk(claim.given[f.of[0]])
        if f.kind == "." and f.of[0] in claim.texts:
            walk(claim.known(claim.texts[f.of[0]]))
        for g in f.of:
            if isinstance(g, Formula):
                walk(g)
        found.append(f)

    for f in formulas:
        walk(f)
    return [] if len(seen) > MOST_PARTS else found


class Facts:
    """What is positive in a claim, written into its `facts`, and its arcs of sines into `branches`."""

    def __init__(self, claim: Any) -> None:
        self.claim = claim
        self.parts = parts(claim, map(claim.known, (*claim.zeros, *claim.besides, *claim.nonzero)))
        self.radicands = [f.of[0] for f in self.parts if self.is_root(f)]

    def is_root(self, f: Any) -> bool:
        return f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0].denominator % 2 == 0

    def signs(self) -> Any:
        """What is positive; the radicands of the claim are so, where it has a value."""
        found = Everywhere(self.claim)
        for f in self.radicands:
            found.use(found.quotient(f)[0])
        return found

    def is_positive(self, *formulas: Any, strict: bool = True) -> bool:
        """Whether all these are seen to be positive, or at least not negative."""
        try:
            signs = self.signs()
            return all(signs.shown(signs.quotient(f)[0], strict) for f in formulas)
        except Stop:
            return False

    def less(self, a: Any, b: Any) -> Any:
        return self.claim.made("+", a, self.claim.made("*", alone.number(-1), b))

    def straight(self, r: Fraction) -> Any:
        """r π."""
        return self.claim.made("*", alone.number(r), Formula(".", ("pi",)))

    def found(self) -> None:
        """Write down all that is seen."""
        facts, claim, one = list[Any](), self.claim, alone.number(-1)
        claim.moduli = {f.of[1] for f in self.parts if f.kind in JACOBI and self.is_positive(self.less(ONE, f.of[1]))}
        turning = [f for f in self.parts if f.kind in ("sin", "cos")][:MOST_SUMS]
        if not self.radicands and not any(f.kind in ("asin", "acos") for f in self.parts):
            return
        for f, apart in self.sums():
            if f in self.radicands:  # it has to be positive anyhow
                continue
            for way in (f, claim.made("*", one, f)):
                if self.is_positive(way, strict=not apart):
                    facts.append(way)
                    break
        for f in turning:
            facts += self.turns(f.of[0])
        for a in claim.cosh[:3]:
            if self.is_positive(a) or self.is_positive(claim.made("*", one, a)):
                cosh = claim.made("cosh", a)
                for f in turning[:3]:
                    facts += [claim.made("+", cosh, f), claim.made("+", cosh, claim.made("*", one, f))]
        claim.facts = [*claim.facts, *facts]

    def divisors(self) -> list[Any]:
        """What isn't 0 where the claim has a value: factors of what is divided by, and of radicands."""
        found, left = list[Any](), [f.of[0] for f in self.parts if f.kind == "^" and self.is_below(f.of[1])]
        left += self.radicands
        while left:
            f = left.pop()
            if f.kind == "." and f.of[0] in self.claim.texts:
                f = self.claim.known(self.claim.texts[f.of[0]])
            left += f.of if f.kind == "*" else f.of[:1] if f.kind == "^" else ()
            found.append(f)
        return found

    def is_below(self, f: Any) -> bool:
        return f.kind == "#" and f.of[0] < 0

    def sums(self) -> list[tuple[Any, bool]]:
        """Sums of names in radicands and in what is divided by, and whether they are known not to be 0."""
        apart = {*self.divisors(), *self.radicands}
        looked = [*parts(self.claim, self.radicands), *apart]
        found, seen = list[Any](), set[Any]()
        for f in dict.fromkeys(f for f in looked if f.kind == "+"):
            signs = Everywhere(self.claim)
            try:
                names = alone_polynomials.names_in(signs.quotient(f)[0])
            except Stop:
                continue
            key = (signs.structure(f), f in apart)
            if names and key not in seen:
                seen.add(key)
                found.append((f, f in apart))
        return sorted(found, key=lambda one: not one[1])[:MOST_SUMS]

    def turns(self, angle: Any) -> list[Any]:
        """The sine and the cosine of an angle, where it lies between multiples of π/2 two of these apart."""
        claim, found = self.claim, list[Any]()
        for k in TURNS:  # between k π/2 and k π/2 + π
            ends = Fraction(k, 2), Fraction(k, 2) + 1
            if not self.is_positive(self.less(angle, self.straight(ends[0])), self.less(self.straight(ends[1]), angle)):
                continue
            kind = "cos" if k % 2 else "sin"  # sin for even k: its sign is that of (−1)^(k/2)
            turn = Fraction((k + 1) // 2) if k % 2 else Fraction(k // 2)
            sign = alone.number(-1 if turn % 2 else 1)
            found.append(claim.made("*", sign, claim.made(kind, angle)))
            for f in self.parts:  # asin(sin a) = ±(a − n π), acos(cos a) likewise
                if f.kind in ("asin", "acos") and f.of[0].kind == f.kind[1:] and f.of[0].of[0] is angle:
                    if (f.kind == "asin") == (k % 2 == 1):
                        near = self.less(angle, self.straight(turn))
                        if f.kind == "acos" and turn % 2:
                            near = self.less(self.straight(turn + 1), angle)
                        claim.branches[f] = claim.made("*", sign, near) if f.kind == "asin" else near
        return found


def find(claim: Any) -> None:
    """Write into a claim what is seen to be positive."""
    Facts(claim).found()
