"""Random points of a surface f = 0, for the small checkers beside this file.

f is solved for a name that stands in it linearly, or as a square alone, with a factor that is 0 nowhere; all else is
free, and each point of the surface has its turn. (Of a square either root is taken, and twice as many points, as the
surface may have two parts; and where the claim has roots it has to be smooth.) Or, where all is rational, the factor of
a name is another name, alone, that doesn't divide the rest: then f is irreducible, and what vanishes where the factor
isn't 0 vanishes on all of it. By x p = 0 nothing is shown: x = 0 would be left out. Derivatives are taken before, in
the space around the surface.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import chain
from typing import Any

if __package__:
    from canon.checker import alone
    from canon.checker.alone_special import names_of
    from canon.checker.alone_values import Values
else:  # as a program, beside the other files
    import alone  # type: ignore
    from alone_special import names_of  # type: ignore
    from alone_values import Values  # type: ignore

Formula, Stop, HALF = alone.Formula, alone.Stop, Fraction(1, 2)
RATIONAL = ("#", ".", "+", "*", "^", "D")


def is_rational(f: Any, entire: bool = False) -> bool:
    """Whether there are only whole powers in it; and in what is `entire` none below 0."""
    if f.kind == "^" and (f.of[1].kind != "#" or f.of[1].of[0].denominator > 1 or (entire and f.of[1].of[0] < 0)):
        return False
    return f.kind in RATIONAL and all(is_rational(g, entire) for g in f.of if isinstance(g, Formula))


class Surface:
    """A claim on the surface where `equation` vanishes, by the `solved` name, or its square."""

    equation: Any = None
    solved, power = "", 1

    def solve(self, f: Any, names: list[str]) -> None:
        """Choose a name by which the surface's equation is solved, the first that will do."""
        own: Any = self
        if names_of(f) & {*own.given}:
            raise Stop("not shown", "a surface in variables that a map gives")
        for name in (name for name in dict.fromkeys(names) if name in names_of(f)):
            for power in (1, 2):
                try:
                    (factors,) = self.products(f, name, power)
                except (Stop, ValueError):  # no such equation, or several products
                    continue
                known = all(map(self.is_apart, factors)) and (power == 1 or self.is_fine(f))
                if known or (power == 1 and self.is_irreducible(f, name, factors)):
                    self.equation, self.solved, self.power = f, name, power
                    own.settle({name})
                    return
        raise Stop("not shown", "a surface that isn't solved for a name")

    def products(self, f: Any, name: str, power: int) -> list[list[Any]]:
        """The products that stand before a power of a name in a formula that is linear in it."""
        if name not in names_of(f):
            return []
        one = alone.number(1)
        base, n = (f.of[0], f.of[1]) if f.kind == "^" else (f, one)
        if base.kind == "." and n.kind == "#" and n.of[0] == power:
            return [[]]
        if f.kind == "+":
            return [*chain(*(self.products(g, name, power) for g in f.of))]
        within = [name in names_of(g) for g in f.of if isinstance(g, Formula)]
        if f.kind != "*" or all(within):
            raise Stop("not shown", "a surface that isn't linear in a name")
        inside, rest = f.of if within[0] else f.of[::-1]
        return [[*product, rest] for product in self.products(inside, name, power)]

    def is_apart(self, f: Any) -> bool:
        """Whether a formula isn't 0 anywhere where it has a value."""
        if f.kind == "^":
            n = f.of[1].of[0] if f.of[1].kind == "#" else Fraction(1)
            return n < 0 or n.denominator % 2 == 0 or self.is_apart(f.of[0])
        if f.kind == "*":
            return all(map(self.is_apart, f.of))
        words = {*self.words.get(f.of[0], ())} if f.kind == "." else set[str]()  # type: ignore[attr-defined]
        return bool(words & {"positive", "negative", "nonzero"}) or (f.kind == "#" and f.of[0] != 0)

    def is_claimed_rational(self) -> bool:
        """Whether what has to vanish is a rational function."""
        own: Any = self
        return all(map(is_rational, (*own.given.values(), *map(own.known, (*own.zeros, *own.besides)))))

    def is_fine(self, f: Any) -> bool:
        """Whether what vanishes at most points of f = 0 does so at real ones where the surface may be singular."""
        return is_rational(f) and self.is_claimed_rational()

    def is_irreducible(self, f: Any, name: str, factors: Any) -> bool:
        """Whether f = ±v · name + d, a polynomial, with a name v that doesn't divide d; and the claim is rational."""
        others = [g for g in factors if g.kind != "#"]
        odd = len(others) != 1 or others[0].kind != "." or any(g.of[0] == 0 for g in factors if g.kind == "#")
        if odd or not is_rational(f, entire=True) or not self.is_claimed_rational():
            return False
        return bool(Values(self, alone.random_prime(), {name: 0, others[0].of[0]: 0}).at(f))


class On(Values):
    """A random point, on the surface where the claim is on one."""

    def check_domain(self) -> None:
        self.place()
        super().check_domain()

    def place(self) -> None:
        """Solve for the name for which the surface is solved."""
        claim, p = self.asked, self.p
        name = getattr(claim, "solved", "")
        if not name or name in self.fixed:
            return
        low, high = (type(self)(claim, p, {**self.fixed, name: k}) for k in (0, 1))
        for line in (low, high):  # what they meet counts here
            line.free, line.sure, line.seen, line.steps = self.free, self.sure, self.seen, self.steps
        rest = low.at(claim.equation)
        factor = (high.at(claim.equation) - rest) % p
        if not factor:
            raise alone.Elsewhere
        value = -rest * pow(factor, -1, p) % p
        if claim.power == 2:
            self.step(value)
            value = pow(value, self.fraction(HALF, self.half), p) * alone.RANDOM.choice((1, -1)) % p
        self.fixed[name] = self.signed(name, value)
