"""Motions of one degree of freedom as laws take them, and the areas that their orbits enclose, by quadrature."""

from typing import Any

import mpmath
import sympy as sp

from canon.mechanics.action_angle import OneDegree

q, p, E = sp.symbols("q p E", real=True)
r = sp.Symbol("r", positive=True)
c = sp.Symbol("c", positive=True)
HALF = sp.Rational(1, 2)
M = sp.Rational(2, 7)


def orbit(square: Any, x: sp.Symbol = q, low: Any = -sp.oo, high: Any = sp.oo) -> OneDegree:
    return OneDegree(x, sp.sympify(square), sp.S.Zero, HALF, sp.sympify(low), sp.sympify(high))


def sure(expression: Any) -> bool:
    return bool(sp.sympify(expression).is_number and expression > 0)


def area(square: Any, x: sp.Symbol, low: Any, high: Any) -> Any:
    """2 ∫ √square dx between turning points."""
    root = sp.lambdify(x, square, "mpmath")
    with mpmath.workdps(25):
        middle, half = (mpmath.mpf(sp.N(s, 30)) / 2 for s in (sp.sympify(high) + low, sp.sympify(high) - low))
        f = lambda t: mpmath.sqrt(abs(root(middle + half * mpmath.sin(t)))) * half * mpmath.cos(t)  # noqa: E731
        return 2 * mpmath.quad(f, [-mpmath.pi / 2, 0, mpmath.pi / 2])


FUNCTIONS = {"EllipticPi": mpmath.ellippi, "elliptic_k": mpmath.ellipk, "elliptic_e": mpmath.ellipe}


def number(closed: Any) -> Any:
    with mpmath.workdps(25):
        return sp.lambdify((), closed, [FUNCTIONS, "mpmath"])()


def same(closed: Any, value: Any) -> bool:
    return abs(number(closed) - value) < 1e-15 * abs(value)


CUBIC, QUARTIC = (q - 1) * (q - 2) * (q - 4), (q - 1) * (q - 2) * (q - 4) * (q - 7)


def allowed(expression: Any) -> bool:
    """Whether it is positive for every positive value of names in it that are small."""
    value = sp.sympify(expression)
    return bool(value.xreplace(dict.fromkeys(value.free_symbols, sp.Rational(1, 10**6))) > 0)
