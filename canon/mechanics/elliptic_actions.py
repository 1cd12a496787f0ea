"""∮ √N(u) S(u) du for a cubic or quartic N with known real roots and a rational S, by elliptic integrals.

The orbit runs from a to b, two roots next to each other; c is a third root (or infinity), d the fourth. The map
u = (a + cκs)/(1 + κs) with κ = (b − a)/(c − b) takes s = 0, 1, ∞, 1/m to a, b, c, d, where m < 1 as c and d lie outside
of [a, b], and the integrand becomes R(s)/√W with W = s(1 − s)(1 − ms) and R rational. As partial fractions, and less a
derivative (h√W)' which is the integral of nothing from 0 to 1,

    R(s) = α + βs + Σ γ/(1 − ns) + hW' / 2 + h'W,

the integral is 2αK(m) + 2β(K(m) − E(m))/m + Σ 2γΠ(n, m) (Byrd and Friedman 1971, 250 to 258; DLMF 19.29).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.mechanics.action_angle import ClosedAction, OneDegree, Test, degree
from canon.mechanics.legendre import S, decomposed
from canon.mechanics.residues import factored, root_and_factor
from canon.mechanics.substitutions import Substitution, U

MOST_POLES = 3
LOWEST, HIGHEST = -8, 4


def elliptic(
    motion: OneDegree,
    cases: Iterable[tuple[Substitution, sp.Expr]],
    positive: Test,
    well: sp.Expr | None = None,
    rate: sp.Expr | None = None,
) -> Iterator[ClosedAction]:
    """The action of the libration between two neighbouring roots, where all roots are rational in the constants.

    **Arguments:** `cases`, substitutions with the square of the integrand; `positive`, by which roots and poles are
    put in order; `well`, a point inside where two are possible; `rate`, the derivative of the square by the energy,
    where instead of the action the period is asked for, at an energy that has been put in.
    """
    for chosen, G in cases:
        try:
            parts = root_and_factor(G)
            found = None if parts is None else _with(motion, chosen, parts, positive, well, rate)
        except (sp.PolynomialError, NotImplementedError, TypeError, ValueError):
            continue
        if found is not None:
            yield found


@dataclass(frozen=True, slots=True)
class _Orbit:
    """Neighbouring roots a < b with N > 0 between them, and the other roots: d last, c before it for a quartic."""

    a: Any
    b: Any
    others: tuple[Any, ...]
    leading: Any


def _with(
    motion: OneDegree, chosen: Substitution, parts: Any, positive: Test, well: Any, rate: Any
) -> ClosedAction | None:
    N, factors = parts
    if degree(N, U) not in (3, 4):
        return None
    leading, roots = _roots(N)
    if roots is None:
        return None
    orbit = _orbit(leading, roots, chosen, positive, None if well is None else chosen.u.xreplace({motion.q: well}))
    if orbit is None:
        return None
    factor = _factors(sp.Mul(*(f**e for f, e in factors)))
    if factor is None:
        return None
    if rate is None:
        return _reduced(motion, chosen, orbit, factor, None, positive)
    slow = _factors(sp.cancel(rate.xreplace({motion.q: chosen.q}) * chosen.rate / factor.formula))
    return None if slow is None else _reduced(motion, chosen, orbit, factor, (rate, slow), positive)


@dataclass(frozen=True, slots=True)
class _Factors:
    """constant · ∏ (u − place)^exponent."""

    constant: Any
    powers: tuple[tuple[Any, int], ...]

    @property
    def formula(self) -> Any:
        return self.constant * sp.Mul(*((U - place) ** e for place, e in self.powers))


def _factors(expression: Any) -> _Factors | None:
    """A rational function of u whose factors are all linear; None for any other."""
    constant, powers = sp.S.One, dict[Any, int]()
    for polynomial, side in zip(sp.fraction(sp.together(expression)), (1, -1), strict=True):
        number, found = factored(polynomial)
        constant = constant * number**side
        for factor, times in found:
            if not factor.has(U):
                constant = constant * factor ** (side * times)
                continue
            pole = _linear(factor)
            if pole is None:
                return None
            constant = constant * pole[0] ** (side * times)
            powers[pole[1]] = powers.get(pole[1], 0) + side * times
    kept = tuple((place, e) for place, e in powers.items() if e)
    return _Factors(constant, kept) if len(kept) <= MOST_POLES else None


def _linear(factor: Any) -> tuple[Any, Any] | None:
    """(slope, zero) of a linear factor."""
    if degree(factor, U) != 1:
        return None
    factor = sp.expand(factor)
    slope = factor.coeff(U, 1)
    return slope, sp.cancel(-factor.coeff(U, 0) / slope)


def _roots(N: Any) -> tuple[Any, list[Any] | None]:
    """The leading coefficient and the roots of a product of linear factors; None for any other."""
    leading, found = factored(N, U)
    roots: list[Any] = []
    for factor, times in found:
        pole = _linear(factor)
        if pole is None or times != 1:
            return leading, None
        leading = leading * pole[0]
        roots.append(pole[1])
    return leading, roots


def _orbit(leading: Any, roots: list[Any], chosen: Substitution, positive: Test, well: Any) -> _Orbit | None:
    """The interval between roots where the orbit lies; None where their order isn't known, or there are two."""
    ordered: list[Any] = []
    for root in roots:
        place = 0
        while place < len(ordered) and positive(root - ordered[place]):
            place += 1
        if not all(positive(other - root) for other in ordered[place:]):
            return None
        ordered.insert(place, root)
    if not (rising := positive(leading)) and not positive(-leading):
        return None
    found = []
    for k in range(len(ordered) - 1):
        above = len(ordered) - 1 - k  # so many roots lie above the interval
        if (above % 2 == 0) != rising:
            continue
        a, b = ordered[k], ordered[k + 1]
        if well is not None and (positive(a - well) or positive(well - b)):
            continue
        if _inside(a, chosen, positive) and _inside(b, chosen, positive):
            found.append((a, b))
        elif not (_not_below(chosen.low, a, positive) or _not_below(b, chosen.high, positive)):
            return None
    if len(found) != 1:
        return None
    ((a, b),) = found
    others = tuple(r for r in ordered if r not in (a, b))
    return _Orbit(a, b, others, leading)


def _inside(root: Any, chosen: Substitution, positive: Test) -> bool:
    low, high = chosen.low, chosen.high
    return (low == sp.S.NegativeInfinity or positive(root - low)) and (high == sp.S.Infinity or positive(high - root))


def _not_below(a: Any, b: Any, positive: Test) -> bool:
    """a ≥ b, for ends of the range that may be infinite."""
    if a.is_infinite or b.is_infinite:
        return False
    return bool(sp.expand(a - b) == 0) or positive(a - b)


def _reduced(
    motion: OneDegree, chosen: Substitution, orbit: _Orbit, factor: _Factors, slow: Any, positive: Test
) -> ClosedAction | None:
    """The action, or where `slow` is given, (∂square/∂E, the factors that 1/√N is multiplied with), the period."""
    a, b, others = orbit.a, orbit.b, orbit.others
    asked = factor if slow is None else slow[1]
    needs = [b - a]
    for place in (*others, *(c for c, _ in asked.powers)):
        if _same(place, a) or _same(place, b):
            continue
        outside = next((e for e in (a - place, place - b) if positive(e)), None)
        if outside is None:
            return None
        needs.append(outside)
    c, d = (None, others[0]) if len(others) == 1 else others
    m, kappa = sp.Symbol("m(q)", real=True), sp.Symbol("k(q)", real=True)
    images: dict[Any, Any] = {}

    def image(place: Any) -> Any:
        """1/s at a place."""
        return (b - a) / (place - a) if c is None else (b - a) * (c - place) / ((place - a) * (c - b))

    images[m] = image(d)
    images[kappa] = stretch = sp.S.Zero if c is None else (b - a) / (c - b)
    jump = (b - a) if c is None else (b - a) * (c - a) / (c - b)  # du/ds = jump/(1 + κs)²
    number, shape = jump * asked.constant, dict[Any, int]()  # of R
    if slow is None:
        shape = {S: 1, 1 - S: 1, 1 - m * S: 1, 1 + kappa * S: -4}
    for place, e in asked.powers:
        if c is not None and _same(place, c):
            f, scale = sp.S.One, a - c
        elif _same(place, a):
            f, scale = S, jump
        elif _same(place, b):
            f, scale = 1 - S, a - b
        elif _same(place, d):
            f, scale = 1 - m * S, a - d
        else:
            n = sp.Symbol(f"n{len(images)}(q)", real=True)
            images[n] = image(place)
            f, scale = 1 - n * S, a - place
        number = number * scale**e
        shape[f] = shape.get(f, 0) + e
        shape[1 + kappa * S] = shape.get(1 + kappa * S, 0) - e
    shape.pop(sp.S.One, None)
    if c is None:
        shape.pop(1 + kappa * S, None)
    sign = next((sign for sign in (1, -1) if positive(sign * number)), None)
    if shape.get(S, 0) < 0 or shape.get(1 - S, 0) < 0 or sign is None:
        return None
    if any(not LOWEST <= e <= HIGHEST for e in shape.values()):
        return None
    found = decomposed(shape, m)
    if found is None:
        return None
    parts, rest = found
    product = orbit.leading * sp.Mul(*(U - r for r in (a, b, *others)))
    ratio = orbit.leading * ((d - a) if c is None else (c - b) * (a - d))
    height, size = ratio * jump**2, jump * sp.sqrt(sp.factor(ratio))  # jump > 0, as c lies outside of [a, b]
    terms = [sp.factor(sign * number * e.xreplace(images)) * f.xreplace(images) for f, e in parts.items()]
    total = (2 * size if slow is None else 1 / size) * sp.Add(*terms)
    back: Any = {U: chosen.u}
    turn = chosen.u.diff(motion.q) ** 2
    moved = a + (b - a) * S if c is None else (a + c * stretch * S) / (1 + stretch * S)
    steep = sp.S.One if c is None else 1 + stretch * S
    W: Any = (S * (1 - S) * (1 - m * S)).xreplace(images)
    here = asked.formula.xreplace({U: moved}) * jump * (W / steep**4 if slow is None else sp.S.One)
    legendre: Any = number * sp.Mul(*(f**e for f, e in shape.items())).xreplace(images)
    checks = [
        ("p**2 as a square root of a polynomial", motion.square - (product * factor.formula**2).xreplace(back) * turn),
        ("the roots moved to 0, 1, 1/m and infinity", product.xreplace({U: moved}) - height * W / steep**4),
        ("the integrand of Legendre's form", here - legendre),
        ("partial fractions, less a derivative", rest),
    ]
    if slow is not None:
        checks.append(("the slowness", slow[0] - (asked.formula * factor.formula).xreplace(back) * turn))
    middle: Any = {U: (a + b) / 2}
    inside: Any = chosen.q.xreplace(middle)
    method = f"elliptic integrals in u = {chosen.u}"
    value, period = (total, None) if slow is None else (sp.S.Zero, total)
    return ClosedAction(value, (), tuple(checks), method, needs=tuple(needs), period=period, inside=inside)


def _same(a: Any, b: Any) -> bool:
    return bool(sp.expand(a - b) == 0)
