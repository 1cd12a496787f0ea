"""Formulas as data, for the files beside `counterexample.py`: derivatives written out, what is put in a name's
place, and of which degree a formula is in a name."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

if __package__:
    from canon.checker.alone import Formula, Stop, number
else:  # as a program's part, beside the other files
    from alone import Formula, Stop, number  # type: ignore

MOST, NOUGHT, UNIT = 20_000, number(0), number(1)


def is_nought(f: Formula) -> bool:
    """Whether it is the number 0, as it stands."""
    return f.kind == "#" and f.of[0] == 0


def total(claim: Any, a: Formula, b: Formula) -> Formula:
    """a + b, without what is 0."""
    return b if is_nought(a) else a if is_nought(b) else claim.made("+", a, b)


def times(claim: Any, a: Formula, b: Formula) -> Formula:
    """a b, where a factor may be 0 or 1."""
    if is_nought(a) or is_nought(b):
        return NOUGHT
    ones = [x for x in (a, b) if not (x.kind == "#" and x.of[0] == 1)]
    return claim.made("*", a, b) if len(ones) == 2 else ones[0] if ones else UNIT


class Writer:
    """Derivatives of a claim's formulas, written out; nothing is simplified but 0 and 1. A place at which a factor of 0
    has no value is lost, so what is differentiated is listed `under`, for who asks to look at."""

    def __init__(self, claim: Any) -> None:
        self.claim, self.size, self.under = claim, 0, list[Formula]()
        self.slope, self.written = cache(self.slope), cache(self.written)

    def slope(self, f: Formula, name: str) -> Formula:
        """∂f/∂name of a formula without derivatives."""
        self.size += 1
        if self.size > MOST:
            raise Stop("not shown", "formulas that are so long")
        if f.kind in "#.":
            return UNIT if f.of == (name,) else NOUGHT
        found = NOUGHT
        for k, inner in enumerate(f.of):
            if not is_nought(steep := self.slope(inner, name)):
                found = total(self.claim, found, times(self.claim, self.written(self.claim.outer(f, k)), steep))
        return found

    def written(self, f: Formula) -> Formula:
        """The formula with its derivatives, and abbreviations, written out."""
        if f.kind == "D":
            found = self.written(f.of[0])
            self.under.append(found)
            for name in f.orders:
                found = self.slope(found, name)
            return found
        if f.kind in "#.":
            return f
        return Formula(f.kind, tuple(self.written(x) for x in f.of), f.orders)


def put(f: Formula, of: Callable[[Formula], Formula | None]) -> Formula:
    """A formula without derivatives, with other formulas in the place of some."""
    done: dict[int, Formula] = {}

    def replaced(x: Formula) -> Formula:
        if id(x) not in done:
            new = of(x)
            if new is None:
                new = x if x.kind in "#." else Formula(x.kind, tuple(map(replaced, x.of)), x.orders)
            done[id(x)] = new
        return done[id(x)]

    return replaced(f)


def put_names(f: Formula, names: dict[str, Formula]) -> Formula:
    """A formula without derivatives, with formulas in the place of names."""
    return put(f, lambda x: names.get(x.of[0]) if x.kind == "." else None)


def inner_names(f: Formula, claim: Any) -> set[str]:
    """The names in a formula, and those in the texts that stand for them."""
    seen: dict[int, set[str]] = {}

    def of(x: Formula) -> set[str]:
        if id(x) not in seen:
            if x.kind == ".":
                text = claim.texts.get(x.of[0])
                seen[id(x)] = {x.of[0]} | (of(claim.known(text)) if text is not None else set())
            else:
                seen[id(x)] = set[str]().union(*(of(y) for y in x.of if isinstance(y, Formula)))
        return seen[id(x)]

    return of(f)


def degree(f: Formula, name: str, claim: Any) -> int | None:
    """The degree of a polynomial in a name, or an upper bound; None for what is none."""

    @cache
    def of(x: Formula) -> int | None:
        if x.kind in "#.":
            return (None if name in claim.texts else 1) if x.of == (name,) else 0
        parts = [of(y) for y in x.of if isinstance(y, Formula)]
        if not any(parts) and None not in parts:
            return 0
        known = [n for n in parts if n is not None]
        if len(known) < len(parts):
            return None
        if x.kind in "+*":
            return max(known) if x.kind == "+" else sum(known)
        whole = x.kind == "^" and x.of[1].kind == "#" and x.of[1].of[0].denominator == 1 and x.of[1].of[0] >= 0
        return known[0] * int(x.of[1].of[0]) if whole else None

    return of(f) if name in inner_names(f, claim) else 0
