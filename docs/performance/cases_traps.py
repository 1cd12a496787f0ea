"""Branch and constant traps: expressions with the truth about them on the domain where they are defined.

`zero` where the expression is identically 0, `not` where it is not, `open` where that depends on a convention or the
domain is empty: what is open must not be called proved. x, y, z, theta are real, p and q positive.
"""

from __future__ import annotations

import sympy as sp
from sympy import (
    Abs,
    I,
    Rational,
    acos,
    acosh,
    asin,
    asinh,
    atan,
    atan2,
    cbrt,
    cos,
    cosh,
    exp,
    log,
    pi,
    sin,
    sinh,
    sqrt,
    tan,
)  # fmt: skip

x, y, z, theta = sp.symbols("x y z theta", real=True)
p, q = sp.symbols("p q", positive=True)
TINY = Rational(1, 10**50)

ZERO = (
    cbrt(x**3) - x,
    sqrt(p + q) * sqrt(p * (p + q)) - (p + q) * sqrt(p),
    log(p * (p + q)) - log(p) - log(p + q),
    sqrt(x * y) - sqrt(x) * sqrt(y),
    sqrt(x * y * z) ** 2 - x * y * z,
    log(x**2) - 2 * log(Abs(x)),
    log(x * y) - log(Abs(x)) - log(Abs(y)),
    Abs(x * y) - Abs(x) * Abs(y),
    sqrt((x - 1) ** 2 * (x + 2)) - Abs(x - 1) * sqrt(x + 2),
    log((x - 1) / (x + 1)) - log(x - 1) + log(x + 1),
    sqrt((1 - x) / (1 + x)) - sqrt(1 - x**2) / (1 + x),
    sqrt((1 - x) / (1 + x)) - (1 - x) / sqrt(1 - x**2),
    sqrt((1 - cos(theta)) * (1 + cos(theta))) - Abs(sin(theta)),
    sqrt(p**2 + q**2 + 2 * p * q) - p - q,
    sqrt(1 - 2 * sin(x) * cos(x)) - Abs(sin(x) - cos(x)),
    exp(log(x) / 2) - sqrt(x),
    sqrt(exp(2 * x)) - exp(x),
    sqrt(exp(x) + 2 + exp(-x)) - 2 * cosh(x / 2),
    sqrt(cosh(x) ** 2 - 1) - Abs(sinh(x)),
    log(cosh(x) + sinh(x)) - x,
    log(p + sqrt(p**2 + 1)) + log(sqrt(p**2 + 1) - p),
    asinh(x) + asinh(-x),
    acosh(1 + 2 * p**2) - 2 * asinh(p),
    atan(p / q) + atan(q / p) - pi / 2,
    asin(x) + acos(x) - pi / 2,
    cos(pi / 7) * cos(2 * pi / 7) * cos(3 * pi / 7) - Rational(1, 8),
    sqrt(2 + sqrt(3)) - (sqrt(6) + sqrt(2)) / 2,
    sin(pi / 12) - (sqrt(6) - sqrt(2)) / 4,
    (x + I * y) * (x - I * y) - x**2 - y**2,
    exp(I * x) * exp(-I * x) - 1,
    x**p * x**q - x ** (p + q),
    (p**q) ** x - p ** (q * x),
    sqrt(1 + x**2) - x - 1 / (sqrt(1 + x**2) + x),
    cbrt(2 + sqrt(5)) - cbrt(sqrt(5) - 2) - 1,
    sqrt(p**2 + 1 + 2 * p) - p - 1,
)

NOT = (
    sqrt(x**2 + 2 * x + 1) - (x + 1),
    sqrt(sin(x) ** 2) - sin(x),
    asin(sin(x)) - x,
    acos(cos(x)) - x,
    atan(tan(x)) - x,
    atan2(sin(x), cos(x)) - x,
    2 * atan(x) - atan(2 * x / (1 - x**2)),
    sqrt(x / y) * y - sqrt(x * y),
    sqrt((x - 1) ** 2 * (x + 2)) - (x - 1) * sqrt(x + 2),
    sqrt((1 - cos(theta)) / 2) - sin(theta / 2),
    sqrt((1 - cos(theta)) * (1 + cos(theta))) - sin(theta),
    sqrt(p**2 + q**2 - 2 * p * q) - p + q,
    sqrt(cosh(x) ** 2 - 1) - sinh(x),
    exp(pi * sqrt(163)) - 262537412640768744,
    sin(x) ** 2 + cos(x) ** 2 - 1 + Rational(1, 10**60),
    sin(10**30 * x) - sin(10**30 * x + TINY),
)

OPEN = (
    cbrt(2 + sqrt(5)) + cbrt(2 - sqrt(5)) - 1,
    1 / (sqrt(x**2) - x),
    sqrt(-(x**2) - 1) - I * sqrt(x**2 + 1),
)

TRAPS = tuple((e, truth) for truth, group in (("zero", ZERO), ("not", NOT), ("open", OPEN)) for e in group)
