"""Integrals with more roots, or beside conditions on other names: `python alone_radicands.py CERTIFICATE.json …`

Conditions of the domain that name nothing of which the claim's formulas are made are left out: what holds without them
holds with them. A radicand that is a product of positive names, of s and 1 + s, and of small primes is a square at
every point that `alone_integrals.py` chooses, so that it isn't counted among those that may not be.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_polynomials as of  # type: ignore

Stop, S = alone.Stop, "#s"


def without_others(tables: Any) -> Any:
    """The tables with the conditions that share a name with the claim, directly or by others."""
    defined, claim = tables.get("definitions", {}), tables["claim"]
    words = cache(lambda text: frozenset(re.findall(r"[^\W\d]\w*", text)))

    def names(text: Any) -> set[str]:
        seen, left = set[str](), {*words(str(text))}
        while left:
            seen |= left
            left = {w for name in left & {*defined} for w in words(str(defined[name]))} - seen
        return seen

    asked = set[str]().union(*(names(x) for key, x in claim.items() if key not in alone.UNASKED))
    where, kept = list(tables.get("domain", {}).get("where", [])), list[str]()
    while any(names(text) & asked - {"pi"} for text in where):
        kept += [text for text in where if names(text) & asked - {"pi"}]
        where = [text for text in where if text not in kept]
        asked |= set[str]().union(*map(names, kept))
    if "domain" not in tables or {*tables["domain"]} != {"where"}:
        return tables
    return {**tables, "domain": {"where": kept}}


class Range(alone_integrals.Between):
    """What is so between the ends, with what is a square there."""

    def is_square(self, f: Any) -> bool:
        """Whether a formula is a product of what is one at every point."""
        try:
            n, d = self.quotient(f)
        except Stop:
            return False
        p = of.times(n, d)
        powers = of.by_powers(p, S)
        if not powers or len(powers[least := min(powers)]) != 1:
            return False
        ((m, c),) = powers[least].items()
        grown = of.times({m: c}, of.power(of.plus(of.ONE, of.named(S)), max(powers) - least))
        plain = all((x in self.sure and x[0] != "#") or x in self.roots for x, _ in m)
        small = c > 0 and pow(alone.MODULUS, alone.LONGEST, c.numerator * c.denominator) == 0
        return plain and (small or c == 1) and p == of.times(grown, of.named(S, least) if least else of.ONE)


class Along(alone_integrals.Along):
    """A random point of the range, or an end; of its roots those count that may be of what is no square."""

    def value(self, f: Any) -> int:
        claim: Any = self.of
        if f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0].denominator % 2 == 0 and not self.end:
            if claim.squares(f.of[0]):
                self.sure.add(self.at(f.of[0]))
        return super().value(f)


def sample(claim: Any, prime: int) -> int:
    """What `alone_integrals.py` sees at one point."""
    if not hasattr(claim, "squares"):
        claim.squares = cache(Range(claim).is_square)
    return alone_integrals.sample(claim, prime, Along)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim, by the certificate's antiderivative."""
    return alone_integrals.shown({**data, "tables": without_others(data["tables"])}, sample)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
