"""Actions and periods of librations in closed form: D = b² − 4 a (c − E) is quadratic in a function of the coordinate.

With Q(u) = c₀ + c₁ u + c₂ u², which is positive between two zeros, ∫ √Q du = π (c₁² − 4 c₀ c₂)/8 (−c₂)^(3/2) and
∫ du/√Q = π/√−c₂; where both are positive ∫ √Q du/u = π (c₁/2√−c₂ − √−c₀), ∫ u du/√Q = π c₁/2 (−c₂)^(3/2) and
∫ du/u√Q = π/√−c₀ (Gradshteyn & Ryzhik, Table of Integrals, §§ 2.26, 2.28). Of a libration between two zeros of D such
signs follow; the coordinate is one that is positive where u = q or q² is divided by.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from canon.checker.enclosures import Integrand
from canon.checker.expansions import EXPONENTIAL, Expansion, NoSeries, Series
from canon.checker.followed import FAILURES, at_random, is_identity
from canon.checker.formulas import ONE, ZERO
from canon.checker.positive import is_positive
from canon.checker.statement import Statement

ORDER = 8
SHAPES = {"plain": (0, 1, 2), "line": (-2, -1, 0), "square": (-2, 0, 2)}
"""The powers of q in D: a quadratic; one in u = q over q²; one in u = q² over q²."""


def closed(s: Statement, g: Integrand, equals: int, *, rate: bool) -> tuple[list[int], list[int]] | None:
    """What must be 0 for a libration's action, or with `rate` its frequency, to be what is claimed, and what is
    positive where there is one.

    None where D has none of these forms, or the domain says more of the coordinate than that it is positive, or
    anything of momenta.
    """
    f, x, pi = s.f, g.x, s.f.node("s", "pi")
    words = {*s.words.get(x, ())} - {"real"}
    if _is_bound(s, x) or s.surface or not words <= {"positive"} or (not rate and f.slope(g.u, x) != ZERO):
        return None
    for shape, scale, form, (c0, c1, c2) in _forms(s, g.D, x):
        if (shape in ("line", "square")) != (words == {"positive"}):
            continue
        if not is_identity(at_random(s), f.sub(g.D, form)):  # it may differ in higher powers
            continue
        low, high = (f.power(f.mul(f.number(-1), c), f.read("1/2", {})) for c in (c0, c2))
        cube = f.mul(high, high, high)
        room = f.sub(f.mul(c1, c1), f.mul(f.number(4), c0, c2))
        signs = [room, f.mul(f.number(-1), c2), *([c1, f.mul(f.number(-1), c0)] if shape != "plain" else [])]
        if rate:
            period = {
                "plain": f.over(f.number(2), high), "line": f.over(c1, cube), "square": f.over(ONE, high),
                "exp": f.over(f.number(2), f.mul(scale, low)),
            }[shape]  # fmt: skip
            last = f.sub(f.mul(equals, pi, period), ONE)
        else:
            area = f.over(room, f.mul(f.number(8), cube))
            other = f.sub(f.over(c1, f.mul(f.number(2), high)), low)
            action = {"plain": area, "line": other, "square": f.over(other, f.number(2)), "exp": f.over(other, scale)}
            last = f.sub(f.mul(pi, action[shape], g.u), equals)
        return [f.sub(g.D, form), last], signs
    return None


def _is_bound(s: Statement, x: str) -> bool:
    """Whether the domain says something of the coordinate, or anything of momenta, beside that the one is positive."""
    moving = [("s", name) for name in (x, *s.p)]
    said = any({*s.words.get(name, ())} - {"real"} for name in s.p)
    return said or any(s.f.ops[b] in moving for a, _ in s.conditions for b in s.f.reach(a))


def constant(s: Statement, g: Integrand, signs: Sequence[int], period: int) -> int | None:
    """A rotation's integral over a period, where the momentum is the same at all places; the factor of its square is
    positive, and one of its two values: as they are opposite, or what is left of the energy where it is 0 is, too."""
    f = s.f
    if _is_bound(s, g.x) or {*s.words.get(g.x, ())} - {"real"} or s.surface:
        return None
    still = all(f.slope(x, g.x) == ZERO for x in (g.e, g.u, g.D, signs[0]))
    if not still or not all(
        is_positive(s, a, strict=True, real=True) for a in (*signs[: 1 if g.e == ZERO else 2], period)
    ):
        return None
    return f.mul(period, f.add(g.e, f.mul(g.u, f.power(g.D, f.number(g.r)))))


def _forms(s: Statement, D: int, x: str) -> Iterator[tuple[str, int, int, tuple[int, int, int]]]:
    """A shape of D, the rate of its exponential, D in that shape, and c₀, c₁, c₂."""
    f, q = s.f, s.f.node("s", x)
    try:
        expansion = Expansion(s, x, Series(0, (ZERO, ONE)), ORDER)
        series = expansion.of(D)
        for shape, powers in SHAPES.items():
            if (found := _only(expansion, series, powers)) is not None:
                terms = (f.mul(c, f.power(q, f.number(k))) if k else c for k, c in zip(powers, found, strict=True))
                yield shape, ONE, f.add(*terms), found
    except (NoSeries, *FAILURES):
        pass
    for op in (f.ops[a] for a in f.reach(D)):
        if op[0] != "f" or op[1] not in EXPONENTIAL:
            continue
        slope = f.slope(op[3][0], x)
        for sign in (1, -1):
            pace = f.mul(f.number(sign), slope)
            if not is_positive(s, pace, strict=True, real=True):
                continue
            try:
                expansion = Expansion(s, x, None, ORDER, pace)
                found = _only(expansion, expansion.of(D), (0, 1, 2))
            except (NoSeries, *FAILURES):
                continue
            if found is not None:
                u = f.node("f", "exp", (), (f.mul(f.number(-1), pace, q),))
                yield "exp", pace, f.add(found[0], f.mul(found[1], u), f.mul(found[2], u, u)), found


def _only(expansion: Expansion, series: Series, powers: tuple[int, int, int]) -> tuple[int, int, int] | None:
    """The coefficients of three powers; None where the first ones have others, or the last of them is 0."""
    terms = {series.low + k: c for k, c in enumerate(series.terms)}
    if max(terms) < powers[2] or any(k not in powers and not expansion.is_zero(c) for k, c in terms.items()):
        return None
    c0, c1, c2 = (terms.get(k, ZERO) for k in powers)
    return None if expansion.is_zero(c2) else (c0, c1, c2)
