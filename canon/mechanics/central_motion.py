"""The radial motion in a central field, exactly: the allowed regions and what kind of orbit lies in each."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any, Literal

import sympy as sp
from sympy.core.evalf import PrecisionExhausted

from canon.errors import InputError
from canon.expected import exact_object, instance_of, shown
from canon.mechanics.formulas import as_expression

Kind = Literal["bounded", "unbounded", "falls in", "falls in and escapes", "circular", "separatrix"]


@dataclass(frozen=True)
class RadialRegion:
    """An interval of r that a particle of this energy and angular momentum may run through.

    `low` and `high` are its ends, exact: turning points, 0, or infinity. `kind`: "bounded" between two turning points,
    "unbounded" from one to infinity, "falls in" from the centre to one, "falls in and escapes" without any, "circular"
    where the region is one point, a minimum of the effective potential; "separatrix" where an end is a maximum, an
    unstable circle that is approached for ever.
    """

    low: Any
    high: Any
    kind: Kind


def effective_potential(V: Any, r: sp.Symbol, mass: Any, angular_momentum: Any) -> Any:
    """V(r) + M²/(2 m r²) (Landau and Lifshitz, Mechanics, eq. 14.8)."""
    instance_of(r, sp.Symbol, "r")
    return as_expression(V) + as_expression(angular_momentum) ** 2 / (2 * as_expression(mass) * r**2)


def radial_regions(
    V: Any, r: sp.Symbol, *, mass: Any = 1, energy: Any, angular_momentum: Any
) -> tuple[RadialRegion, ...]:
    """The regions r > 0 where E − V(r) − M²/(2 m r²) > 0, with their ends as exact numbers, and isolated circles.

    The zeros are those of a polynomial, isolated exactly, so that turning points that nearly meet are told apart.

    **Arguments:** V, a rational function of r with rational coefficients; `mass`, `energy` and `angular_momentum`,
    rational numbers (decimal ones as strings or sympy's `Rational`).

    **Raises:** `InputError` for other potentials or numbers, and for one with a pole at some r > 0.
    """
    given = ((mass, "mass"), (energy, "energy"), (angular_momentum, "angular_momentum"))
    m, E, M = (_rational(x, where) for x, where in given)
    if m <= 0:
        raise InputError("a mass is positive", "mass")
    gap = sp.together(E - effective_potential(V, r, m, M))
    above, below = sp.fraction(sp.cancel(gap))
    try:
        parts: Any = [sp.Poly(part, r, domain="QQ") for part in (above, below)]
    except (sp.PolynomialError, sp.CoercionFailed):
        raise InputError("V must be a rational function of r with rational coefficients", "V") from None
    numerator, denominator = parts
    if any(root.is_positive for root in denominator.real_roots()):
        raise InputError("V has a pole at some r > 0", "V")
    if numerator.is_zero:
        raise InputError("E - V - M**2/(2 m r**2) is 0 everywhere: nothing moves", "V")
    multiplicity: dict[Any, int] = {}
    for root in numerator.real_roots():
        if root.is_positive:
            multiplicity[root] = multiplicity.get(root, 0) + 1
    roots = list(multiplicity)
    ends = [sp.Integer(0), *roots, sp.oo]
    try:
        signs = [_sign_between(numerator, denominator, a, b) for a, b in pairwise(ends)]
    except PrecisionExhausted:
        raise InputError(
            "the turning points are too far apart, or too large, to be told from each other", "V"
        ) from None
    found = []
    for k, sign in enumerate(signs):
        low, high = ends[k], ends[k + 1]
        if sign > 0:
            found.append(RadialRegion(low, high, _kind(low, high, multiplicity)))
        if k + 1 < len(signs) and sign < 0 and signs[k + 1] < 0:
            found.append(RadialRegion(high, high, "circular"))
    return tuple(found)


def _rational(value: Any, where: str) -> Any:
    try:  # a decimal one as text is 0.1 for "0.1"
        given = Fraction(value) if isinstance(value, str) else exact_object(value)
        finite = given is not None and given not in (sp.nan, sp.oo, -sp.oo, sp.zoo)  # the Rational of nan would be 0
        found = sp.Rational(given) if finite else None
    except (TypeError, ValueError, ZeroDivisionError):
        found = None
    if not isinstance(found, sp.Rational):
        raise InputError(f"mass, energy and angular momentum are rational numbers, not {shown(value)}", where)
    return found


def _kind(low: Any, high: Any, multiplicity: dict[Any, int]) -> Kind:
    if any(multiplicity.get(end, 1) > 1 for end in (low, high)):
        return "separatrix"
    if low == 0:
        return "falls in and escapes" if high is sp.oo else "falls in"
    return "unbounded" if high is sp.oo else "bounded"


def _sign_between(numerator: Any, denominator: Any, low: Any, high: Any) -> int:
    """The sign of the quotient at a rational point between two neighbouring zeros."""
    point = _between(low, high)
    value = numerator.eval(point) * denominator.eval(point)
    return 1 if value > 0 else -1


def _between(low: Any, high: Any) -> Any:
    """A rational number strictly between two exact ones."""
    if high is sp.oo:
        return sp.Integer(sp.floor(low)) + 1
    digits = 15
    while True:
        middle = sp.Rational(str(((low + high) / 2).evalf(digits)))
        if bool(low < middle) and bool(middle < high):
            return middle
        digits *= 2
