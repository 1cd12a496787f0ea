"""Equations between formulas that hold wherever both sides are defined: what a formula may be rewritten by.

Each rule makes a pair of equal formulas of two random ones; `n` is an integer, `m` a parameter between 0 and 1. Those
that need a branch or a sign besides are `properties.soundness.identities.REAL`.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from properties.soundness.formula import Formula, of, variable
from properties.soundness.identities import f, sqrt

Rule = Callable[[Formula, Formula], tuple[Formula, Formula]]

x, y, a, n, m, pi = (variable(name) for name in ("x", "y", "a", "n", "m", "pi"))
HALF = Fraction(1, 2)
sin, cos, tan, exp, log, atan, asin, acos, atan2, sign, cosh, sinh, tanh, absolute = map(
    f, ("sin", "cos", "tan", "exp", "log", "atan", "asin", "acos", "atan2", "sign", "cosh", "sinh", "tanh", "abs")
)
cot, sec, csc, coth, asinh, acosh, atanh, cbrt, gamma, w = map(
    f, ("cot", "sec", "csc", "coth", "asinh", "acosh", "atanh", "cbrt", "gamma", "lambertw")
)
K, E, F, Pi, sn, cn, dn = map(
    f, ("elliptic_k", "elliptic_e", "elliptic_f", "elliptic_pi", "jacobi_sn", "jacobi_cn", "jacobi_dn")
)
V, W, D = f("V"), f("W"), f("D")

TURNS: dict[str, Rule] = {
    "sine squared": lambda u, v: (sin(u) ** 2, 1 - cos(u) ** 2),
    "sine doubled": lambda u, v: (sin(2 * u), 2 * sin(u) * cos(u)),
    "cosine doubled": lambda u, v: (cos(2 * u), 1 - 2 * sin(u) ** 2),
    "sine trebled": lambda u, v: (sin(3 * u), 3 * sin(u) - 4 * sin(u) ** 3),
    "sine of a sum": lambda u, v: (sin(u + v), sin(u) * cos(v) + cos(u) * sin(v)),
    "product of cosines": lambda u, v: (2 * cos(u) * cos(v), cos(u - v) + cos(u + v)),
    "tangent": lambda u, v: (tan(u), sin(u) / cos(u)),
    "tangent of a sum": lambda u, v: (tan(u + v), (tan(u) + tan(v)) / (1 - tan(u) * tan(v))),
    "tangent of a half": lambda u, v: (tan(u / 2), sin(u) / (1 + cos(u))),
    "cotangent": lambda u, v: (cot(u) - tan(u), 2 * cot(2 * u)),
    "secant": lambda u, v: (sec(u) ** 2, 1 + tan(u) ** 2),
    "cosecant": lambda u, v: (csc(u) * sin(u) * v, v),
    "quarter turn": lambda u, v: (tan(u + pi / 2), -cot(u)),
    "half turn": lambda u, v: (sec(pi - u), -sec(u)),
    "turned n times": lambda u, v: (cos(u + n * pi), of(-1) ** n * cos(u)),
    "tangent turned n times": lambda u, v: (tan(u + n * pi + v), tan(u + v)),
    "tangent turned to the cotangent": lambda u, v: (tan(u + n * pi + pi / 2), -cot(u)),
    "cotangent turned to the tangent": lambda u, v: (cot(n * pi - u + pi * HALF), tan(u)),
    "tangent by an eighth": lambda u, v: (tan(n * pi + u - pi / 4), (tan(u) - 1) / (1 + tan(u))),
    "cosecant turned": lambda u, v: (csc(u + pi * n), of(-1) ** n * csc(u)),
}
GROWTH: dict[str, Rule] = {
    "hyperbolic one": lambda u, v: (cosh(u) ** 2 * v, v + v * sinh(u) ** 2),
    "hyperbolic sine doubled": lambda u, v: (sinh(2 * u), 2 * sinh(u) * cosh(u)),
    "hyperbolic sum": lambda u, v: (cosh(u + v), cosh(u) * cosh(v) + sinh(u) * sinh(v)),
    "hyperbolic tangent": lambda u, v: (tanh(u), (exp(2 * u) - 1) / (exp(2 * u) + 1)),
    "hyperbolic half": lambda u, v: (tanh(u / 2), sinh(u) / (1 + cosh(u))),
    "hyperbolic cotangent": lambda u, v: (coth(2 * u), (tanh(u) + coth(u)) / 2),
    "exponential": lambda u, v: (exp(u + v), exp(u) * (cosh(v) + sinh(v))),
    "logarithm of it": lambda u, v: (log(exp(u) * exp(v)), u + v),
    "exponential of a logarithm": lambda u, v: (exp(v * log(u)), u**v),
    "logarithm of a product": lambda u, v: (log(u * v), log(u) + log(v)),
    "logarithm of a square": lambda u, v: (log(u**2), 2 * log(absolute(u))),
    "logarithm of a root": lambda u, v: (log(sqrt(u)), log(u) / 2),
    "power of a power": lambda u, v: ((u**a) ** 2, u ** (2 * a)),
    "root of a power": lambda u, v: (sqrt(u**a), u ** (a / 2)),
    "integer power": lambda u, v: ((u * v) ** n, u**n * v**n),
}
ROOTS: dict[str, Rule] = {
    "root of a square": lambda u, v: (sqrt(u**2), absolute(u)),
    "square of a root": lambda u, v: (sqrt(u) ** 2 * v, u * v),
    "root of a product": lambda u, v: (sqrt(u * v), sqrt(u) * sqrt(v)),
    "root below": lambda u, v: (1 / (sqrt(u) + sqrt(v)), (sqrt(u) - sqrt(v)) / (u - v)),
    "cube root": lambda u, v: (cbrt(u**3) * v, u * v * sqrt(u) / sqrt(u)),
    "fourth root": lambda u, v: ((u**4) ** Fraction(1, 4), absolute(u)),
    "absolute value": lambda u, v: (absolute(u), u * sign(u)),
    "sign squared": lambda u, v: (sign(u) ** 2 * v, v),
    "absolute product": lambda u, v: (absolute(u * v), absolute(u) * absolute(v)),
    "sign of a quotient": lambda u, v: (sign(u / v), sign(u) * sign(v)),
}
BACK: dict[str, Rule] = {
    "cosine of an arcsine": lambda u, v: (cos(asin(u)), sqrt(1 - u**2)),
    "tangent of an arccosine": lambda u, v: (tan(acos(u)), sqrt(1 - u**2) / u),
    "sine of an arctangent": lambda u, v: (sin(atan(u)), u / sqrt(1 + u**2)),
    "arcsine and arccosine": lambda u, v: (asin(u), pi / 2 - acos(u)),
    "arccosine reflected": lambda u, v: (acos(-u), pi - acos(u)),
    "arcsine by an arctangent": lambda u, v: (asin(u), atan(u / sqrt(1 - u**2))),
    "arctangent of the inverse": lambda u, v: (atan(1 / u), sign(u) * pi / 2 - atan(u)),
    "difference of arctangents": lambda u, v: (atan(u) - atan(v), atan2(u - v, 1 + u * v)),
    "half of an angle": lambda u, v: (atan2(u, v), 2 * atan(u / (sqrt(u**2 + v**2) + v))),
    "sine of an angle": lambda u, v: (sin(atan2(u, v)), u / sqrt(u**2 + v**2)),
    "Gudermann": lambda u, v: (atan(sinh(u)), 2 * atan(tanh(u / 2))),
    "area sine": lambda u, v: (asinh(u), log(u + sqrt(u**2 + 1))),
    "area cosine": lambda u, v: (acosh(u), log(u + sqrt(u - 1) * sqrt(u + 1))),
    "area tangent": lambda u, v: (atanh(u), log((1 + u) / (1 - u)) / 2),
    "area cosine of a cosine": lambda u, v: (acosh(cosh(u)), absolute(u)),
    "area cosine doubled": lambda u, v: (acosh(2 * u**2 - 1), 2 * acosh(u) * sign(u - 1)),
    "area sine of a sine": lambda u, v: (asinh(sinh(u)) + atanh(tanh(v)), u + v),
}
SPECIAL: dict[str, Rule] = {
    "gamma's recurrence": lambda u, v: (gamma(u + 1), u * gamma(u)),
    "gamma reflected": lambda u, v: (gamma(u) * gamma(1 - u), pi * csc(pi * u)),
    "Lambert": lambda u, v: (w(u) * exp(w(u)), u),
    "complete": lambda u, v: (K(m) * u + E(m), F(pi / 2, m) * u + E(pi / 2, m)),
    "one turn": lambda u, v: (E(u + pi, m), E(u, m) + 2 * E(m)),
    "Jacobi's sine": lambda u, v: (sn(u, m) ** 2, 1 - cn(u, m) ** 2),
    "Jacobi's delta": lambda u, v: (dn(u, m) ** 2 + m * sn(u, m) ** 2, of(1)),
    "Jacobi's sine doubled": lambda u, v: (sn(2 * u, m), 2 * sn(u, m) * cn(u, m) * dn(u, m) / (1 - m * sn(u, m) ** 4)),
    "amplitude": lambda u, v: (sn(F(u, m), m), sin(u)),
    "third kind": lambda u, v: (Pi(m, m) * (1 - m), E(m)),
    "slope of K": lambda u, v: (D(K(m), m) * 2 * m * (1 - m), E(m) - (1 - m) * K(m)),
    "slope of Jacobi's cosine": lambda u, v: (D(cn(u, m), x), -sn(u, m) * dn(u, m) * D(u, x)),
}
SLOPES: dict[str, Rule] = {
    "product": lambda u, v: (D(V(u) * v, x), D(V(u), x) * v + V(u) * D(v, x)),
    "quotient": lambda u, v: (D(v / V(u), x), (D(v, x) * V(u) - v * D(V(u), x)) / V(u) ** 2),
    "chain": lambda u, v: (D(sin(V(u)) * y, x), cos(V(u)) * D(V(u), x) * y),
    "mixed": lambda u, v: (D(D(W(u, v), x), y), D(D(W(u, v), y), x)),
    "power": lambda u, v: (D(V(u) ** 2, y), 2 * V(u) * D(V(u), y)),
    "root": lambda u, v: (D(sqrt(u), x), D(u, x) / (2 * sqrt(u))),
    "kink": lambda u, v: (D(absolute(u), y), sign(u) * D(u, y)),
    "arctangent": lambda u, v: (D(atan2(u, v), x), (v * D(u, x) - u * D(v, x)) / (u**2 + v**2)),
}
RULES: dict[str, dict[str, Rule]] = {
    "turns": TURNS, "growth": GROWTH, "roots": ROOTS, "back": BACK, "special": SPECIAL, "slopes": SLOPES,
}  # fmt: skip
