"""Limits of formulas as a variable grows, or falls, beyond all bounds: by what tends to 0, for `alone_integrals.py`."""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone, alone_signs
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
SMOOTH = ("+", "*", "sin", "cos", "exp", "atan", "asinh")


class Endless(alone_signs.Signs):
    """Limits as the variable grows, or falls, beyond all bounds."""

    everywhere = True

    def __init__(self, claim: Any, sign: int) -> None:
        super().__init__(claim)
        self.of, self.sign = claim, sign

    def tends(self, f: Any) -> int:
        """1 or −1 where a polynomial of the variable grows or falls beyond all bounds; else 0."""
        whole = lambda g: g.kind == "^" and g.of[1].kind == "#" and g.of[1].of[0].denominator == 1 and g.of[1].of[0] > 0
        if not self.of.has(f) or not all(g.kind in "+*." or whole(g) for g in self.of.parts(f) if self.of.has(g)):
            return 0
        powers = of.by_powers(self.quotient(f)[0], self.of.x)
        top = max(powers)
        signs = [sign for sign in (1, -1) if self.shown(of.times(of.number(sign), powers[top]), True)]
        return signs[0] * self.sign**top if top and signs else 0

    def is_bounded(self, f: Any) -> bool:
        """Whether a formula doesn't grow faster than a power of the variable."""
        if not self.of.has(f) or f.kind in ("sin", "cos"):
            return True
        if f.kind == "exp":
            return self.tends(f.of[0]) < 0
        natural = f.kind != "^" or (f.of[1].kind == "#" and f.of[1].of[0] >= 0 and f.of[1].of[0].denominator == 1)
        return f.kind in "+*.^" and natural and all(map(self.is_bounded, self.of.inner(f)))

    def factors(self, f: Any) -> list[Any]:
        self.of.spend()
        return [*self.factors(f.of[0]), *self.factors(f.of[1])] if f.kind == "*" else [f]

    def limit(self, f: Any) -> Any:
        """What a formula tends to, as a formula without the variable."""
        claim, r = self.of, f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else None
        if not claim.has(f):
            return f
        each = self.factors(f)
        if any(g.kind == "exp" and self.tends(g.of[0]) < 0 for g in each) and all(map(self.is_bounded, each)):
            return alone.number(0)
        if f.kind == "." and f.of[0] in claim.texts:
            return self.limit(claim.known(claim.texts[f.of[0]]))
        if r is not None and r < 0 and self.tends(f.of[0]):
            return alone.number(0)
        if f.kind in (*SMOOTH, "asin", "acos") or (r is not None and r.denominator == 1 and r > 0):
            return Formula(f.kind, tuple(self.limit(g) if isinstance(g, Formula) else g for g in f.of))
        raise Stop("not shown", "what an antiderivative tends to")
