"""Actions on a separatrix whose unstable point is a double root of p²: elementary integrals.

p² = Q(u) S(u)² with Q of degree 1 or 2 and a polynomial S that vanishes at u = e, where Q > 0. The orbit runs between
e, which it approaches for ever, and the root of Q next to it; round it, there and back, ∮ p du = 2 ∫ √Q |S| du. With
a polynomial g and a number h such that Q S = g'Q + gQ'/2 + h this is [g√Q] + h ∫ du/√Q, and the latter an arc sine, a
hyperbolic one, or a root (Gradshteyn and Ryzhik 2.260-2.264).
"""

from collections.abc import Iterable, Iterator
from typing import Any

import sympy as sp

from canon.mechanics.action_angle import ClosedAction, OneDegree, Test, degree
from canon.mechanics.residues import root_and_factor
from canon.mechanics.substitutions import Substitution, U

SEPARATRIX = "the area inside the separatrix"
MOST = 4


def separatrix(
    motion: OneDegree, cases: Iterable[tuple[Substitution, sp.Expr]], positive: Test, well: sp.Expr | None = None
) -> Iterator[ClosedAction]:
    """The action of the loop at a double root, where it is known which of two loops is meant.

    **Arguments:** `cases`, substitutions with the square of the integrand; `positive`, by which places are put in
    order; `well`, a point inside the loop.
    """
    for chosen, G in cases:
        if chosen.u != motion.q:
            continue
        try:
            parts = root_and_factor(G)
            found = None if parts is None else _with(motion, parts, positive, well)
        except (sp.PolynomialError, NotImplementedError, TypeError, ValueError):
            continue
        if found is not None:
            yield found


def _with(motion: OneDegree, parts: Any, positive: Test, well: Any) -> ClosedAction | None:
    Q, factors = parts
    S: Any = sp.Mul(*(f**e for f, e in factors))
    zeros = [f for f, _ in factors if f.has(U)]
    if degree(Q, U) > 2 or not S.is_polynomial(U) or len(zeros) != 1 or degree(S, U) not in range(1, MOST + 1):
        return None
    if degree(zeros[0], U) != 1:
        return None
    (e,) = sp.roots(sp.Poly(zeros[0], U))
    at_e: Any = {U: e}
    height, slope = Q.xreplace(at_e), sp.diff(Q, U).xreplace(at_e)
    if not positive(height):
        return None
    if degree(Q, U) == 2 and not positive(_discriminant(Q)):  # else Q has no root where the loop would end
        return None
    left = _is_left(motion, Q, e, slope, positive, well)
    if left is None:
        return None
    found = _antiderivative(Q, S)
    if found is None:
        return None
    g, h = found
    side = 1 if left else -1  # the loop lies to the left of e: from the root to e
    total = side * g.xreplace(at_e) * sp.sqrt(height) + h * _of_root(Q, e, slope, height, left, positive)
    inside = e - side * sp.Dummy(positive=True)
    sign = _sign_beside(S, e, inside, positive)
    if sign is None:
        return None
    back: Any = {U: motion.q}
    checks = (
        ("p**2 as a quadratic times a square", motion.square - (Q * S**2).xreplace(back)),
        ("the integrand less a derivative", sp.expand(Q * S - sp.diff(g, U) * Q - g * sp.diff(Q, U) / 2 - h)),
    )
    needs = (height,)
    return ClosedAction(2 * sign * total, (), checks, SEPARATRIX, needs=needs)


def _discriminant(Q: Any) -> Any:
    return Q.coeff(U, 1) ** 2 - 4 * Q.coeff(U, 2) * Q.coeff(U, 0)


def _is_left(motion: OneDegree, Q: Any, e: Any, slope: Any, positive: Test, well: Any) -> bool | None:
    """Whether the loop is the one to the left of e; None where that isn't known, or the range may cut it."""
    top = Q.coeff(U, 2)
    if top == 0 or positive(top):  # on one side Q grows for ever: the loop is on the other one
        rising, falling = positive(slope), positive(-slope)
        if not (rising or falling):
            return None
        left = rising
        if well is not None:
            there: Any = {U: well}
            turned: Any = sp.diff(Q, U).xreplace(there)
            beside = (e - well, turned) if left else (well - e, -turned)
            if not all(positive(x) for x in beside):
                return None
    elif positive(-top):
        before = _ends_before(motion.high, e, positive) or (well is not None and positive(e - well))
        after = _ends_before(e, motion.low, positive) or (well is not None and positive(well - e))
        if before == after:
            return None
        left = before
    else:
        return None
    edge, reach = (motion.low, sp.S.NegativeInfinity) if left else (motion.high, sp.S.Infinity)
    if edge != reach:
        ends: Any = {U: edge}
        beyond = (e - edge) if left else (edge - e)
        if not (positive(-Q.xreplace(ends)) and positive(beyond)):
            return None
    near = motion.high if left else motion.low
    if near.is_infinite or positive(near - e if left else e - near) or sp.expand(near - e) == 0:
        return left
    return None


def _ends_before(a: Any, b: Any, positive: Test) -> bool:
    """a ≤ b, for ends of a range."""
    if a.is_infinite or b.is_infinite:
        return False
    return bool(sp.expand(a - b) == 0) or positive(b - a)


def _antiderivative(Q: Any, S: Any) -> tuple[Any, Any] | None:
    """(g, h) with QS = g'Q + gQ'/2 + h."""
    names = sp.symbols(f"g0:{degree(S, U) + 2}")
    h = sp.Dummy("h")
    g = sp.Add(*(name * U**k for k, name in enumerate(names)))
    equation = sp.Poly(sp.expand(Q * S - sp.diff(g, U) * Q - g * sp.diff(Q, U) / 2 - h), U)
    found: Any = sp.solve(equation.all_coeffs(), [*names, h], dict=True)
    if not found:
        return None
    free: Any = dict.fromkeys((*names, h), sp.S.Zero)
    solution: Any = {name: sp.factor(value.xreplace(free)) for name, value in found[0].items()}
    solution = {**free, **solution}
    return g.xreplace(solution), solution[h]


def _of_root(Q: Any, e: Any, slope: Any, height: Any, left: bool, positive: Test) -> Any:
    """∫ du/√Q between e and the root of Q."""
    top, middle = Q.coeff(U, 2), Q.coeff(U, 1)
    side = 1 if left else -1
    if top == 0:
        return 2 * sp.sqrt(height) / (side * middle)
    arc: Any
    root: Any = sp.sqrt(sp.factor(_discriminant(Q)))
    if positive(top):
        arc = sp.acosh(slope / root) if left else sp.acosh(-slope / root)
        return arc / sp.sqrt(top)
    arc = sp.asin(slope / root) if left else sp.asin(-slope / root)
    return (sp.pi / 2 - arc) / sp.sqrt(-top)


def _sign_beside(S: Any, e: Any, inside: Any, positive: Test) -> int | None:
    """The sign of S next to e; its only zero is e."""
    near: Any = {U: inside}
    value: Any = sp.factor(S.xreplace(near))
    step = next(iter(inside.free_symbols - sp.sympify(e).free_symbols))
    for sign in (1, -1):
        if positive(sp.expand(sign * value / step ** degree(S, U))):
            return sign
    return None
