"""The square of the momentum on an orbit H = E, where H is even in p but not quadratic: solved for step by step.

p occurs in one place of H: sums, products, powers, exponentials and hyperbolic cosines round it are undone one by one,
a quartic by the formula for quadratic equations. Each step is one-to-one for p > 0 where what it yields, a guard, is
positive. A guard that isn't 0 between the turning points is positive there if it is so at one point.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.domain import Condition
from canon.mechanics.action_angle import NotQuadratic, OneDegree, coordinate_range
from canon.sign import known_sign

Y = sp.Symbol("y(p)", positive=True)  # p², no name of a file
STEPS = 12


@dataclass(frozen=True, slots=True)
class SolvedMomentum:
    """The orbits H = energy of an even H.

    **Arguments:** `motion`, with p² as its square; `guards`, what is positive along each orbit; `level`, a name for the
    energy, in which `of_level` is p².
    """

    motion: OneDegree
    guards: tuple[sp.Expr, ...]
    level: sp.Symbol
    of_level: sp.Expr


def solved_momentum(
    H: sp.Expr, q: sp.Symbol, p: sp.Symbol, energy: sp.Expr, conditions: Iterable[Condition] = ()
) -> SolvedMomentum:
    """p² as a function of q and the energy.

    **Raises:** `NotQuadratic` where it isn't found.
    """
    reason = NotQuadratic(f"H isn't quadratic in {p}, and wasn't solved for {p}**2")
    if sp.expand(H.xreplace({p: -p}) - H) != 0:  # type: ignore[operator]
        raise reason
    level = sp.Dummy("E", real=True)
    rest: Any = H.xreplace({p: sp.sqrt(Y)})
    value: Any = level
    guards: list[Any] = []
    for _ in range(STEPS):
        if rest == Y:
            break
        step = _undone(rest, value, guards)
        if step is None:
            raise reason
        rest, value = step
    else:
        raise reason
    low, high = coordinate_range(q, (c for c in conditions if not c.terms[0].has(p)))
    put: Any = {level: energy}
    motion = OneDegree(q, value.xreplace(put), sp.S.Zero, sp.S.One, low, high)
    return SolvedMomentum(motion, tuple(g.xreplace(put) for g in guards), level, value)


def _undone(rest: Any, value: Any, guards: list[Any]) -> tuple[Any, Any] | None:
    """One step inwards: (inner, its value) from rest = value; None where it isn't one-to-one for p > 0."""
    if rest.is_Add:
        constant, inner = rest.as_independent(Y, as_Add=True)
        if constant != 0:
            return inner, value - constant
        return _by_quadratic(rest, value)
    if rest.is_Mul:
        factor, inner = rest.as_independent(Y, as_Add=False)
        return None if factor == 1 or known_sign(factor) != "positive" else (inner, value / factor)
    if isinstance(rest, sp.exp):
        guards.append(value)
        return rest.args[0], sp.log(value)
    if isinstance(rest, sp.cosh):
        guards.append(value - 1)
        return rest.args[0], sp.acosh(value)
    if isinstance(rest, sp.Pow) and isinstance(rest.exp, sp.Rational) and known_sign(rest.base) == "positive":
        if rest.exp < 0:  # H falls with p²: its orbits are run through backward, round a maximum
            return None
        guards.append(value)
        return rest.base, value ** (1 / rest.exp)
    return None


def _by_quadratic(rest: Any, value: Any) -> tuple[Any, Any] | None:
    """αy² + βy = value, α > 0 and β ≥ 0, for y > 0."""
    polynomial = sp.Poly(rest, Y) if rest.is_polynomial(Y) else None
    if polynomial is None or polynomial.degree() > 2:
        return None
    alpha, beta = polynomial.coeff_monomial(Y**2), polynomial.coeff_monomial(Y)
    if polynomial.degree() == 1:
        return (Y, value / beta) if known_sign(beta) == "positive" else None
    if known_sign(alpha) != "positive" or known_sign(beta) not in ("positive", "nonnegative"):
        return None
    return Y, (sp.sqrt(beta**2 + 4 * alpha * value) - beta) / (2 * alpha)
