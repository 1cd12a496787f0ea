"""A momentum's square as a formula, by the energy."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from canon.checker.enclosures import Integrand
from canon.checker.formulas import ONE, ZERO, Formulas
from canon.checker.orbits import Form
from canon.checker.positive import is_positive
from canon.checker.rational import Rational, plain_root
from canon.checker.statement import Statement


class Square(NamedTuple):
    """A momentum's square D and ∂D/∂E; an orbit ends at zeros of the factor `turning` of D, and `up` is positive."""

    D: int
    slope: int
    turning: int
    up: int

    def integrand(self, f: Formulas, x: str, *, rate: bool) -> tuple[Integrand, list[tuple[int, str]]]:
        """2 √D, or with `rate` ∂D/∂E over √D, round a libration; and what must be positive along it."""
        u, r = (self.slope, -1) if rate else (f.number(2), 1)
        return Integrand(f, x, ZERO, u, self.D, Fraction(r, 2)), [(self.up, "positive")]


def squared(s: Statement, form: Form, H: int, level: int) -> Square | None:
    """p² by the energy, where H is a p² + c with a > 0, or c + √(a p² + b) with E > c; the domain says nothing of p."""
    f, r, p = s.f, Rational(s), form.p
    moving = [("s", name) for name in s.p]
    if {*s.words.get(p, ())} - {"real"} or any(f.ops[b] in moving for a, _ in s.conditions for b in f.reach(a)):
        return None
    if form.quadratic:
        a, b, c = form.parts
        if not r.is_zero(b) or not is_positive(s, a, strict=True, real=True):
            return None
        D = f.over(f.sub(level, c), a)
        return Square(D, f.over(ONE, a), D, ONE)
    roots = [b for b in f.reach(H) if f.ops[b][:2] == ("f", "power") and any(f.ops[k] == ("s", p) for k in f.reach(b))]
    if len(roots) != 1 or f.value(f.ops[roots[0]][3][1]) != Fraction(1, 2):
        return None
    inner = f.ops[roots[0]][3][0]
    rest, nothing, new = f.sub(H, roots[0]), {p: ZERO}, dict[int, int]()
    for node in f.reach(H):
        new[node] = ZERO if node == roots[0] else f.rebuilt(node, [new[part] for part in f.parts(node)])
    c, b = new[H], f.substitute(inner, nothing)
    a = f.mul(f.number(Fraction(1, 2)), f.substitute(f.slope(f.slope(inner, p), p), nothing))
    left = f.sub(inner, f.add(b, f.mul(a, f.power(f.node("s", p), f.number(2)))))
    if any(f.ops[k] == ("s", p) for k in f.reach(c)) or not r.is_zero(left) or not r.is_zero(f.sub(rest, c)):
        return None
    if not is_positive(s, a, strict=True, real=True):
        return None
    up = f.sub(level, c)
    slope, root = f.over(f.mul(f.number(2), up), a), plain_root(s, b)
    if root is not None:
        turning = f.sub(up, root)
        return Square(f.over(f.mul(turning, f.add(up, root)), a), slope, turning, up)
    D = f.over(f.sub(f.mul(up, up), b), a)
    return Square(D, slope, D, up) if is_positive(s, up, strict=True, real=True) else None
