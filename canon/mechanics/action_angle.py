"""Action variables J = ∮ p dq (without 1/2π) of one degree of freedom: what is integrated, and over which coordinate.

With H quadratic in p the two branches of the orbit H = E are mean ± √square; round a libration the mean cancels, so
that J = 2 ∫ √square dq between turning points; for a rotation it stays. Goldstein, Poole and Safko (2002), 10.6.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.domain import Condition
from canon.sign import known_sign

Test = Callable[[Any], bool]
"""Whether an expression in the constants is certainly positive wherever a claim is made."""

NOT_NEGATIVE = ("positive", "zero", "nonnegative")


def nowhere(_: Any) -> bool:
    """The test of one who knows nothing of the constants."""
    return False


class NotQuadratic(ValueError):
    """The Hamiltonian has other branches than the two of a quadratic one."""


@dataclass(frozen=True, slots=True)
class OneDegree:
    """The orbits H = E of one degree of freedom.

    **Arguments:** the coordinate `q` and its open range from `low` to `high`; `square`, ((p₊ − p₋)/2)² and `mean`,
    (p₊ + p₋)/2, as functions of q, the energy and constants; `leading`, the coefficient of p² in H.
    """

    q: sp.Symbol
    square: sp.Expr
    mean: sp.Expr
    leading: sp.Expr
    low: sp.Expr
    high: sp.Expr

    def spans(self, least: sp.Expr, greatest: sp.Expr) -> bool:
        """Whether the range lies within these bounds."""
        return at_most(least, self.low) and at_most(self.high, greatest)


@dataclass(frozen=True, slots=True)
class ClosedAction:
    """An action in closed form, and what it rests on.

    **Arguments:** `value`; `exists`, what must be positive for such a motion to exist, and is whenever it does;
    `vanishes`, identities by which the integrand is the one of the standard integral, in q or in u; `method`;
    `passes_zero`, whether the orbit passes q = 0, where |q| has its kink; `needs`, what has to be positive for the
    closed form to be that of the orbit, wherever the claim is made; `period`, ∂J/∂E, where that isn't found by
    differentiating `value`; `inside`, a value of the coordinate between the turning points; `through`, what of
    `exists` is enough where an orbit is known to pass: the rest follows from a point where p² > 0 (None: all of it).
    """

    value: sp.Expr
    exists: tuple[sp.Expr, ...]
    vanishes: tuple[tuple[str, sp.Expr], ...]
    method: str
    passes_zero: bool = False
    needs: tuple[sp.Expr, ...] = ()
    period: sp.Expr | None = None
    inside: sp.Expr | None = None
    through: tuple[sp.Expr, ...] | None = None


def one_degree(
    H: sp.Expr, q: sp.Symbol, p: sp.Symbol, energy: sp.Expr, conditions: Iterable[Condition] = ()
) -> OneDegree:
    """The orbits of H(q, p) = energy, where q is restricted by the conditions that are linear in it and free of p.

    **Raises:** `NotQuadratic` where H isn't a polynomial of degree 2 in p.
    """
    polynomial = sp.Poly(sp.expand(H - energy), p) if sp.expand(H).is_polynomial(p) else None
    if polynomial is None or polynomial.degree() != 2:
        raise NotQuadratic(f"H isn't quadratic in {p}")
    a, b, c = polynomial.all_coeffs()
    low, high = coordinate_range(q, (c for c in conditions if not c.terms[0].has(p)))
    square: Any = sp.together((b**2 - 4 * a * c) / (4 * a**2))
    return OneDegree(q, square, -b / (2 * a), a, low, high)


def coordinate_range(q: sp.Symbol, conditions: Iterable[Condition]) -> tuple[sp.Expr, sp.Expr]:
    """The open interval that q's assumptions and the conditions linear in q leave it."""
    low: sp.Expr = sp.S.Zero if q.is_nonnegative else sp.S.NegativeInfinity
    high: sp.Expr = sp.S.Zero if q.is_nonpositive else sp.S.Infinity
    for condition in conditions:
        edge = linear_edge(q, condition)
        if edge is None:
            continue
        value, is_low = edge
        if is_low and not at_most(value, low):
            low = value
        elif not is_low and not at_most(high, value):
            high = value
    return low, high


def linear_edge(q: sp.Symbol, condition: Condition) -> tuple[sp.Expr, bool] | None:
    """(edge, whether it is a lower one) of a condition c₀ + c₁ q > 0, the sign of c₁ being known; None for others."""
    if condition.kind != "positive" or q not in condition.terms[0].free_symbols:
        return None
    term: Any = sp.expand(condition.terms[0])
    slope = term.diff(q)
    sign = known_sign(slope)
    if slope.has(q) or sign not in ("positive", "negative"):
        return None
    return -term.xreplace({q: sp.S.Zero}) / slope, sign == "positive"


def degree(polynomial: Any, x: sp.Symbol) -> int:
    """The degree in x of something polynomial in x."""
    return int(sp.Poly(polynomial, x).degree())


def at_most(a: Any, b: Any) -> bool:
    """a ≤ b, as far as it shows."""
    if a == sp.S.NegativeInfinity or b == sp.S.Infinity:
        return True
    if a == sp.S.Infinity or b == sp.S.NegativeInfinity:
        return False
    difference = sp.expand(b - a)
    if difference.is_number:
        return bool(difference >= 0)
    return known_sign(difference) in NOT_NEGATIVE or known_sign(sp.factor(difference)) in NOT_NEGATIVE
