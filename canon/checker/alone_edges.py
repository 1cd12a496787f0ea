"""What is so at a limit, where formulas have limits within them: for `alone_tending.py`."""

from __future__ import annotations

from fractions import Fraction
from math import factorial
from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals, alone_limits
    from canon.checker import alone_polynomials as of
else:  # as a program's part, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_limits  # type: ignore
    import alone_polynomials as of  # type: ignore

Stop = alone.Stop
HIGHEST, REMOVED = 6, "/0"
EDGES = {"asin": ("1 - a", "1 + a"), "acos": ("1 - a", "1 + a"), "acosh": ("a - 1",)}
"""Orders of derivatives; the kind of a quotient N/D at whose limit both vanish, D in the order that is stated; what
isn't negative where a function is continuous, but not smooth."""


class Edge(alone_limits.Beside):
    """What is so at the limit, of quotients too that have one there."""

    of: Any  # the claim, which knows how to divide and to differentiate

    def quotient(self, f: Any) -> of.Quotient:
        if f.kind != REMOVED:
            return super().quotient(f)
        (n, a), (m, b) = (self.quotient(self.of.derivative(g, f.orders[0])) for g in f.of)
        sign = 1 if self.shown(m, True) else -1
        if sign < 0 and not self.shown(of.minus(m), True):
            raise Stop("not shown", "the limit of a denominator's derivative")
        return of.times(of.times(of.number(sign), n), b), of.times(of.times(of.number(sign), m), a)

    def first(self, f: Any) -> tuple[int, int]:
        """The order in which a formula vanishes at the limit, and the sign of its derivative there."""
        try:
            return super().first(f)
        except Stop:
            pass
        self.check(f, strict=True)
        for order in range(HIGHEST + 1):
            p = self.plain(self.quotient(self.of.derivative(f, order))[0])
            for sign in (1, -1):
                if p and self.shown(of.times(of.number(sign), p), True):
                    return order, sign
            if p:
                break
        raise Stop("not shown", "in which order a denominator vanishes")

    def check(self, f: Any, strict: bool = False) -> None:
        """See that a formula is smooth at the limit; without `strict`, that it is continuous on its side."""
        if f.kind == REMOVED:
            return  # it was looked at
        root = f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0] > 0 and f.of[1].of[0].denominator > 1
        if strict or not self.of.has(f) or not (root or f.kind in EDGES):
            return super().check(f, strict)
        try:
            return super().check(f, True)
        except Stop:
            super().check(f, False)
        sides = [f.of[0]] if root else [self.of.read(text, {"a": f.of[0]}) for text in EDGES[f.kind]]
        if any(self.of.tends(*self.of.split(g))[1] != 1 for g in sides):
            raise Stop("not shown", f"that {f.kind} has values beside the limit")


class Coming(alone_integrals.Along):
    """A random point, at the limit."""

    def at(self, f: Any, *by: str) -> int:
        """The derivative of N/D from those of N and D."""
        if f.kind != REMOVED:
            return super().at(f, *by)
        n, x = f.orders[0], self.of.x
        if {*by} - {x}:
            raise Stop("not shown", "a derivative of a limit")
        top, bottom = ([self.at(g, *(x,) * (n + j)) * pow(factorial(n + j), -1, self.p) for j in range(len(by) + 1)]
                       for g in f.of)  # fmt: skip
        found = list[int]()
        for j, a in enumerate(top):
            known = sum(c * bottom[j - i] for i, c in enumerate(found))
            found.append((a - known) * pow(bottom[0], -1, self.p) % self.p)
        return found[-1] * factorial(len(by)) % self.p

    def value(self, f: Any) -> int:
        return self.at(f) if f.kind == REMOVED else super().value(f)

    def terms(self, f: Any) -> dict[int, Fraction]:
        return {v: r for v, r in super().terms(f).items() if v}
