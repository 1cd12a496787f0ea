"""Inequalities in one variable by pieces of its range, and of names that may be 0: `python alone_covers.py
CERTIFICATE.json …`

Where the difference f is a formula of one name v, between two numbers that the domain states, the range is cut into
pieces. In each f is positive by its values in intervals of fractions (`counterexample.py`), by f(middle) and the slopes
about it, or since it grows from an end at which it is positive; from an end that the domain leaves out also where it is
0 there, and its slope, or that one's, is positive. Elsewhere a name that isn't negative is a square
(`alone_signs.py`).
"""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone, alone_signs
    from canon.checker import alone_polynomials as of
    from canon.checker.counterexample import Arithmetic, Interval, Open, Point
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore
    from counterexample import Arithmetic, Interval, Open, Point  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
BITS, MOST_PIECES, MOST_SLOPES = 96, 400, 5
EXACTLY = {"exp": (0, Fraction(1)), "log": (1, Fraction(0)), "sin": (0, Fraction(0)), "cos": (0, Fraction(1)),
    "atan": (0, Fraction(0))}  # fmt: skip
"""Where values are no irrational numbers."""
End = tuple[Fraction, bool]
"""An end of a range, and whether it belongs to it, as far as is known."""


class Squares(alone_signs.Signs):
    """What is positive in the domain, where names may be at least 0."""

    def quotient(self, f: Any) -> of.Quotient:
        """A formula as a quotient; a name that isn't negative is a square of a real one."""
        if f.kind == "." and f.of[0] not in self.put and "nonnegative" in self.claim.words.get(f.of[0], ()):
            self.put[f.of[0]] = of.named(self.new(("square", f.of[0]), False), 2), of.ONE
        return super().quotient(f)


class Exact(Point):
    """A point at which sin 0 and so on are numbers."""

    def value(self, f: Any) -> Interval:
        known = EXACTLY.get(f.kind)
        return (known[1], known[1]) if known and self.at(f.of[0]) == (known[0],) * 2 else super().value(f)


class Cover:
    """f in pieces of the range of a name."""

    def __init__(self, claim: alone.Claim, f: Any, name: str) -> None:
        self.claim, self.f, self.name, self.real = claim, f, name, Arithmetic(BITS)

    def at(self, x: Interval, order: int) -> Interval:
        """The derivative of this order somewhere in x. Raises Open."""
        names: dict[str, Any] = {name: name for name in self.claim.words}  # a value of a function may be any
        return Exact(self.claim, names | {self.name: x}, self.real).at(self.f, *(self.name,) * order)

    def is_positive(self, low: End, high: End, strict: bool) -> bool:
        """Whether f is positive, or at least 0, between the ends, and at those that belong to the range."""
        pieces = [(low, high)]
        for _ in range(MOST_PIECES):
            if not pieces:
                return True
            a, b = pieces.pop()
            if not self.is_seen(a, b, strict):
                middle = (a[0] + b[0]) / 2, True
                pieces += [(a, middle), (middle, b)]
        return False

    def is_seen(self, low: End, high: End, strict: bool) -> bool:
        """The same by the values in all of the range, or by the slopes there."""
        (a, _), (b, _) = low, high
        middle, good = (a + b) / 2, (lambda x: x > 0) if strict else (lambda x: x >= 0)
        try:
            if good(self.at((a, b), 0)[0]):
                return True
            steep = self.at((a, b), 1)
            if good(self.at((middle, middle), 0)[0] - (b - a) / 2 * max(map(abs, steep))):
                return True
            return any(self.is_growing(*one, strict, (a, b)) for one in ((*low, 1), (*high, -1)))
        except Open:
            return False

    def is_growing(self, end: Fraction, within: bool, sign: int, strict: bool, x: Interval) -> bool:
        """Whether f isn't negative at an end, and the first slope that isn't 0 there makes it grow throughout the
        range."""
        value, toward = self.at((end, end), 0), sign
        if value[0] < 0 or (value[0] == 0 and strict and within):
            return False
        for order in range(1, MOST_SLOPES + 1):
            low, high = self.at(x, order)
            if (low if toward > 0 else -high) > 0:
                return True
            if value != (0, 0) and order == 1 and (value[0] > 0 or not strict):
                return (low if toward > 0 else -high) >= 0
            if self.at((end, end), order) != (0, 0):
                return False
            toward *= sign
        return False


def ends(claim: alone.Claim, name: str) -> tuple[End, End]:
    """The numbers between which a name is by the domain's conditions, and by what is assumed of it."""
    words, low, high = claim.words.get(name, ()), list[End](), list[End]()
    low += [(Fraction(0), "nonnegative" in words)] if {"positive", "nonnegative"} & {*words} else []
    for parts in (re.split(r"(<=|>=|!=|<|>)", text) for text in claim.domain.get("where", [])):
        for a, sign, b in zip(parts[::2], parts[1::2], parts[2::2], strict=False):
            for one, other, less in ((a, b, "<" in sign), (b, a, ">" in sign)):
                if one.strip() == name:
                    try:
                        x = Point(claim, {n: n for n in claim.words}, Arithmetic(BITS)).at(claim.read(other))
                    except (Open, Stop):
                        continue
                    end, exact = x[1] if less else x[0], x[0] == x[1]
                    if sign != "!=":
                        (high if less else low).append((end, "=" in sign or not exact))
    if not low or not high:
        raise Stop("not shown", "between which numbers the variable is")
    return max(low, key=lambda end: (end[0], not end[1])), min(high)


def names_in(claim: alone.Claim, f: Any) -> set[str]:
    """The names of which a formula is made."""
    found, left, seen = set[str](), [f], 0
    while left:
        g, seen = left.pop(), seen + 1
        if seen > alone.MOST_VALUES:
            raise Stop("not shown", "formulas that are so long")
        if g.kind == "." and g.of[0] in claim.texts:
            left.append(claim.known(claim.texts[g.of[0]]))
        elif g.kind == ".":
            found |= {*g.of} - {"pi"}
        left += [x for x in g.of if isinstance(x, Formula)]
    return found


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    claim, relation = alone_signs.claim_of(data["tables"])
    f, strict = claim.read("_lhs - _rhs" if ">" in relation else "_rhs - _lhs"), "=" not in relation
    names = names_in(claim, f)
    if any("nonnegative" in claim.words.get(name, ()) for name in names):
        signs = Squares(claim)
        n, _ = signs.quotient(f)
        if not signs.angles and signs.shown(n, strict):
            return "shown", ""
    if len(names) != 1:
        raise Stop("not shown", "an inequality in several variables")
    low, high = ends(claim, *names)
    if low[0] >= high[0]:
        raise Stop("not shown", "a range that runs upwards")
    if Cover(claim, f, *names).is_positive(low, high, strict):
        return "shown", ""
    return "not shown", "the sign of the difference, in so many pieces"


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
