"""Square roots of products as products of square roots, so that two formulas with the same ones can be compared.

√(x y) = √x √y where x is positive. What is known to be positive are names, numbers, and polynomials that the domain, or
the caller, says to be so; what is left of a radicand after these is nowhere negative where the root is real.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from canon.checker import core
from canon.checker.core import Polynomial
from canon.checker.formulas import ONE
from canon.checker.functions import Unreadable
from canon.checker.polynomials import Undetermined, divided, minus, times
from canon.checker.rational import formula
from canon.checker.signs import Signs
from canon.checker.statement import Statement


class Radicals:
    """The roots of a claim's formulas, `positive` ones being known."""

    def __init__(self, s: Statement, positive: Sequence[int]) -> None:
        self.s, self.f, self.signs, self.bases = s, s.f, Signs(s), list[Polynomial]()
        for a in (*(a for a, kind in s.conditions if kind == "positive"), *positive):
            self._rest(self._product(a))
        for p in [*self.bases]:  # what the later ones say may divide the first ones
            self.bases.remove(p)
            self._rest(p)

    def _fraction(self, a: int) -> tuple[Polynomial, Polynomial] | None:
        """Numerator and a positive denominator, as polynomials in names; None where that isn't seen."""
        try:
            pair = self.signs.fraction(a)
        except (Undetermined, Unreadable):
            return None
        if any(name[0] == "#" for p in pair for name in core.names(p)):
            return None
        rest = formula(self.s, self._stripped(pair[1])[0])
        if self.signs.is_positive(rest, strict=True):
            return pair
        other = self.signs.is_positive(self.f.mul(self.f.number(-1), rest), strict=True)
        return (minus(pair[0]), minus(pair[1])) if other else None

    def _product(self, a: int) -> Polynomial:
        """Numerator times denominator: of the same sign. 1 where these aren't polynomials in names."""
        try:
            over, under = self.signs.fraction(a)
            p = times(over, under)
        except (Undetermined, Unreadable):
            return core.ONE
        return p if p and all(name[0] != "#" for name in core.names(p)) else core.ONE

    def known(self) -> list[int]:
        """What is positive, without factors that are known to be so by themselves."""
        return [formula(self.s, p) for p in self.bases]

    def split(self, target: int) -> int:
        """The formula with its square roots written as products."""
        f, new = self.f, dict[int, int]()
        for a in f.reach(target):
            op, parts = f.ops[a], [new[b] for b in f.parts(a)]
            r = f.value(op[3][1]) if op[:2] == ("f", "power") else None
            new[a] = f.rebuilt(a, parts)
            if r is not None and r.denominator == 2 and (pair := self._fraction(op[3][0])) is not None:
                new[a] = f.mul(*(x for p, k in zip(pair, (r, -r), strict=True) for x in self._powers(p, k)))
        return new[target]

    def _powers(self, p: Polynomial, r: Fraction) -> list[int]:
        """The factors of p^r, p being nowhere negative."""
        found, used = self._rest(p)
        return [self.f.power(base, self.f.number(e * r)) for base, e in [(found, 1), *used.items()]]

    def _rest(self, p: Polynomial) -> tuple[int, dict[int, int]]:
        """A positive number, and other factors with their exponents; a factor that is new is one of the known now."""
        p, used = self._stripped(p)
        size = abs(p[min(p)])
        p = {m: c / size for m, c in p.items()}
        if p != core.ONE:
            self.bases.append(p)
            used[formula(self.s, p)] = 1
        return self.f.number(size) if size != 1 else ONE, used

    def _stripped(self, p: Polynomial) -> tuple[Polynomial, dict[int, int]]:
        """What is left without factors that are known to be positive, and these with their exponents."""
        used = dict[int, int]()
        for name in sorted(core.names(p)):
            low = min(dict(m).get(name, 0) for m in p)
            if low and "positive" in self.signs.words.get(name, ()):
                used[self.f.node("s", name)] = low
                p = {tuple((n, e - low * (n == name)) for n, e in m if n != name or e > low): c for m, c in p.items()}
        for base in self.bases:
            while core.names(p) and (quotient := divided(p, base)) is not None:
                node = formula(self.s, base)
                used[node], p = used.get(node, 0) + 1, quotient
        return p, used
