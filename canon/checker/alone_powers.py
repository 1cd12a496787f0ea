"""Names in exponents, and whole turns, for the table's claims: `python alone_powers.py CERTIFICATE.json …`

aᵉ with an exponent e that isn't a number has an a that is seen to be positive (`alone_signs.py`). Then e is split into
terms, each a rational multiple of a product: a number r gives aʳ, any other term v a random square for each (a, v). So
that aᵉ⁺ʳ = aᵉ aʳ is all that is known of it; its slopes are e aᵉ⁻¹ and aᵉ log a. And sines and cosines of so many
right angles are known.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from typing import Any

if __package__:
    from canon.checker import alone, alone_constraints, alone_regular, alone_wider
    from canon.checker.counterexample_formulas import Writer
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_constraints  # type: ignore
    import alone_regular  # type: ignore
    import alone_wider  # type: ignore
    from counterexample_formulas import Writer  # type: ignore

Formula, Stop, KINDS = alone.Formula, alone.Stop, ("euler_lagrange", "noether", "solves")


def is_open(f: Any) -> bool:
    """Whether it is a power whose exponent isn't a number."""
    return f.kind == "^" and f.of[1].kind != "#"


class Powers(alone_wider.Wider):
    """A claim that the table knows, with such powers."""

    def __init__(self, tables: Any) -> None:
        super().__init__(tables)
        self.outer = cache(self.slope)
        own, write = alone_regular.itself(self), Writer(self)
        if any("integer" in words for words in self.words.values()):
            raise Stop("not shown", "whole numbers")
        for text in [x for x in (*self.zeros, *self.besides, *self.nonzero) if isinstance(x, str)]:
            write.written(self.read(text, own))
            for f in {id(g): g for h in (*write.under, self.read(text, own)) for g in parts(h) if is_open(g)}.values():
                self.check_base(write.written(f.of[0]), own)

    def check_base(self, a: Any, own: Any) -> None:
        """See that it is positive, or that the domain says so. Raises Stop."""
        if alone_regular.is_positive(self, a):
            return
        for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in self.domain.get("where", [])):
            for x, sign, y in zip(words[::2], words[1::2], words[2::2], strict=False):
                text = {">": f"({x}) - ({y})", "<": f"({y}) - ({x})"}.get(sign)
                if text and alone_constraints.is_nothing(self, [self.made("+", a, self.read(f"-({text})", own))]):
                    return
        raise Stop("not shown", "a power of what isn't seen to be positive")

    def slope(self, f: Any, k: int) -> Any:
        """∂f/∂(its k-th argument)."""
        if is_open(f) and k == 1:
            return self.read("log(a)*a**b", dict(zip("ab", f.of, strict=True)))
        return alone.Claim.outer(self, f, k)


def parts(f: Any) -> Any:
    """A formula and all within it."""
    yield f
    for g in (g for g in f.of if isinstance(g, Formula)):
        yield from parts(g)


class Powered(alone_wider.Placed):
    """A random point at which such powers have values."""

    def value(self, f: Any) -> int:
        if not is_open(f):
            return super().value(f)
        a, found = self.square(self.at(f.of[0])), 1
        for value, r in self.terms(f.of[1]).items():
            found = found * (self.root(a, r) if value == 1 else self.root(self.any("power", a, value) ** 2, r)) % self.p
        return found

    def terms(self, f: Any) -> dict[int, Fraction]:
        return {self.at(f): Fraction(1)} if is_open(f) else super().terms(f)

    def circle(self, terms: Any) -> tuple[int, int]:
        """Quarters of a turn are known."""
        quarters = 2 * terms.get(pi := self.text("pi"), Fraction(0))
        if quarters.denominator > 1:
            return super().circle(terms)
        c, s = super().circle({v: r for v, r in terms.items() if v != pi})
        return ((c, s), (-s, c), (-c, -s), (s, -c))[int(quarters) % 4]


def sample(claim: Any, prime: int) -> int:
    """See at one point that all vanishes; the certificate's kernels may have more roots, and aren't looked at."""
    point = Powered(claim, prime)
    point.check_domain()
    point.check()
    if any(map(point.text, claim.zeros)):
        raise Stop("not shown", "that all of it is 0")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    if data["tables"]["claim"]["kind"] not in KINDS:
        raise Stop("not shown", "such a claim")
    return alone.tried(sample, Powers(data["tables"]))


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
