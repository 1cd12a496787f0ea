"""∮ √Q(u) R(u) du for a quadratic Q and a rational R, by the residues outside of the cut between the turning points.

With Q = A (u − u₋)(u₊ − u), A > 0, and c outside of [u₋, u₊]: ∫ √Q/(u − c) du = π (√A (m − c) ∓ √−Q(c)) between the
turning points, m being their middle; the upper sign where c lies below (Sommerfeld, Atombau und Spektrallinien I,
appendix 6; Goldstein, Poole and Safko 2002, section 10.8). Derivatives by c give the higher poles. Poles off the real
line come in pairs, and are known where they and the turning points lie symmetrically about 0.
"""

from collections.abc import Iterable, Iterator
from typing import Any

import sympy as sp

from canon.mechanics.action_angle import ClosedAction, OneDegree, at_most, degree
from canon.mechanics.substitutions import Substitution, U, integrands
from canon.sign import known_sign

HIGHEST_POWER = 2


def by_residues(
    motion: OneDegree, cases: Iterable[tuple[Substitution, sp.Expr]] | None = None
) -> Iterator[ClosedAction]:
    """The action of the libration, for each substitution that leads to one quadratic root.

    **Arguments:** `cases`, substitutions with the square of the integrand, where these are there already.
    """
    for chosen, G in integrands(motion) if cases is None else cases:
        found = _with(motion, chosen, G)
        if found is not None:
            yield found


def _with(motion: OneDegree, chosen: Substitution, G: sp.Expr) -> ClosedAction | None:
    try:
        parts = root_and_factor(G)
    except (sp.PolynomialError, NotImplementedError, TypeError, ValueError):
        return None
    if parts is None:
        return None
    Q, factors = parts
    if degree(Q, U) != 2:
        return None
    S: Any = sp.Mul(*(f**e for f, e in factors))
    sign = _sign(factors, chosen)
    if sign is None:
        return None
    A, B, C = -Q.coeff(U, 2), Q.coeff(U, 1), Q.coeff(U, 0)
    exists: list[Any] = [A, B**2 + 4 * A * C]
    through: list[Any] = [A]  # a parabola that opens downwards, positive in the range and negative at its ends
    if chosen.low != sp.S.NegativeInfinity:
        exists += [-Q.xreplace({U: chosen.low}), B - 2 * A * chosen.low]
        through.append(exists[-2])
    if chosen.high != sp.S.Infinity:
        exists += [-Q.xreplace({U: chosen.high}), 2 * A * chosen.high - B]
        through.append(exists[-2])
    exists, through = ([sp.factor(sp.together(e)) for e in part] for part in (exists, through))
    if any(known_sign(e) in ("zero", "negative", "nonpositive") for e in exists):
        return None
    terms = sp.Add.make_args(sp.apart(S, U) if S.has(U) else S)
    integrals = [_integral(term, Q, (A, B, C), chosen) for term in terms]
    if any(value is None for value in integrals):
        return None
    back = {U: chosen.u}
    same = motion.square - Q.xreplace(back) * S.xreplace(back) ** 2 * chosen.u.diff(motion.q) ** 2
    checks = (("p**2 as a square root of a quadratic", same), ("partial fractions", S - sp.Add(*terms)))
    value = 2 * sign * sp.Add(*(value for value in integrals if value is not None))
    middle: Any = {U: B / (2 * A)}
    inside: Any = chosen.q.xreplace(middle)
    method = f"residues in u = {chosen.u}"
    return ClosedAction(value, tuple(exists), checks, method, inside=inside, through=tuple(through))


def root_and_factor(G: Any) -> tuple[Any, list[tuple[Any, int]]] | None:
    """(Q, factors) with G = Q (∏ factor^exponent)², Q a polynomial in u without square factors; None for no u."""
    above, below = sp.fraction(G)
    number, found = sp.S.One, dict[Any, int]()
    for polynomial, side in ((above, 1), (below, -1)):
        constant, factors = factored(polynomial)
        number = number * constant**side
        for factor, exponent in factors:
            if factor.has(U):
                found[factor] = found.get(factor, 0) + side * exponent
            else:
                number = number * factor ** (side * exponent)
    Q = sp.expand(number * sp.Mul(*(f for f, e in found.items() if e % 2)))
    if not Q.is_polynomial(U) or not Q.has(U):
        return None
    return Q, [(f, (e - e % 2) // 2) for f, e in found.items() if e - e % 2]


def factored(*arguments: Any) -> tuple[Any, list[tuple[Any, int]]]:
    """sympy's `factor_list`: a number and the factors with their exponents."""
    found: Any = sp.factor_list(*arguments)
    return found[0], found[1]


def _pole(factor: Any, chosen: Substitution) -> tuple[Any, Any, int] | None:
    """(slope, c, side) of a linear factor slope·(u − c) whose c is at or below (+1), or at or above (−1) the range."""
    if degree(factor, U) != 1:
        return None
    slope = factor.coeff(U, 1)
    c = sp.cancel(-factor.xreplace({U: sp.S.Zero}) / slope)
    if at_most(c, chosen.low):
        return slope, c, 1
    return (slope, c, -1) if at_most(chosen.high, c) else None


def _sign(factors: list[tuple[Any, int]], chosen: Substitution) -> int | None:
    """The sign of S on the whole range; None where a factor may vanish in it."""
    sign = 1
    for factor, exponent in factors:
        pole = _pole(sp.expand(factor), chosen)
        if pole is None:
            if (known := known_sign(factor)) not in ("positive", "negative"):
                return None
            if exponent % 2 and known == "negative":
                sign = -sign
            continue
        slope, _, side = pole
        known = known_sign(slope)
        if known not in ("positive", "negative"):
            return None
        if exponent % 2:
            sign *= side * (1 if known == "positive" else -1)
    return sign


def _integral(term: Any, Q: Any, coefficients: tuple[Any, Any, Any], chosen: Substitution) -> Any | None:
    """∫ √Q · term du between the turning points."""
    A, B, C = coefficients
    if term.is_polynomial(U):
        power = degree(term, U) if term.has(U) else 0
        if power > HIGHEST_POWER or sp.expand(term - term.coeff(U, power) * U**power) != 0:
            return None
        middle, spread = B / (2 * A), (B**2 + 4 * A * C) / (4 * A**2)
        moments = (sp.S.One, middle, middle**2 + spread / 4)
        return term.coeff(U, power) * sp.pi * sp.sqrt(A) * spread / 2 * moments[power]
    above, below = sp.fraction(sp.together(term))
    constant, factors = factored(below, U)
    if len(factors) != 1:
        return None
    (factor, order) = factors[0]
    if degree(factor, U) == 2:
        return _of_two_poles(above / constant, sp.expand(factor), order, coefficients)
    if above.has(U):
        return None
    pole = _pole(sp.expand(factor), chosen)
    if pole is None:
        return None
    slope, c, side = pole
    at = sp.Dummy("c", real=True)
    value = sp.pi * (B / (2 * sp.sqrt(A)) - sp.sqrt(A) * at - side * sp.sqrt(-Q.xreplace({U: at})))
    value = sp.diff(value, at, order - 1) / sp.factorial(order - 1)
    return above / (constant * slope**order) * value.xreplace({at: c})


def _of_two_poles(above: Any, factor: Any, order: int, coefficients: tuple[Any, Any, Any]) -> Any | None:
    """∫ √(C − Au²) (β + αu)/(f(u² + s))ⁿ du between the turning points, which lie as far from 0 as one another, s > 0.

    The poles ±i√s give π(√(C + As)/√s − √A) for n = 1, and derivatives by s the others; what is odd gives nothing.
    """
    A, B, C = coefficients
    leading, square = factor.coeff(U, 2), sp.Dummy("s", positive=True)
    centred = sp.expand(B) == 0 and factor.coeff(U, 1) == 0 and above.is_polynomial(U) and degree(above, U) < 2
    at = sp.cancel(factor.coeff(U, 0) / leading)
    if not centred or known_sign(at) != "positive":
        return None
    value = sp.pi * (sp.sqrt(C + A * square) / sp.sqrt(square) - sp.sqrt(A))
    value = (-1) ** (order - 1) * sp.diff(value, square, order - 1) / sp.factorial(order - 1)
    return above.xreplace({U: sp.S.Zero}) / leading**order * value.xreplace({square: at})
