"""Taylor's coefficients of elementary functions at a ball: each encloses f⁽ᵐ⁾/m! at all of its points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, Final

from flint import arb, arb_series

from canon.decide.arbitrary import rational
from canon.decide.series import Ball


class Unenclosed(Exception):
    """The program isn't certified to be smooth, or defined, where it was evaluated."""


def number(value: Any) -> Ball:
    """A program's number as a ball: floats and fractions exactly."""
    if value == "pi":
        return arb.pi()
    return arb(rational(value)) if isinstance(value, Fraction) else arb(value)


def binomial(base: Ball, exponent: Fraction, degree: int) -> list[Ball]:
    """Taylor's coefficients of x ** exponent at x = base."""
    if exponent.denominator != 1:
        if not base > 0:
            raise Unenclosed("a root of something that may be zero or negative")
    elif base.contains(0):
        raise Unenclosed("a denominator that may be zero")
    coefficients, factor = [], Fraction(1)
    for m in range(degree + 1):
        coefficients.append(number(factor) * _monotone_power(base, exponent - m))
        factor = factor * (exponent - m) / (m + 1)
    return coefficients


def _monotone_power(base: Ball, exponent: Fraction) -> Ball:
    """base ** exponent for a ball without 0, by its ends: a wide ball multiplied by itself would grow to contain 0."""
    if base < 0:
        return _monotone_power(-base, exponent) * (-1) ** exponent.numerator
    ends = []
    for end in (base.lower(), base.upper()):
        if exponent.denominator == 1:
            ends.append(end**exponent.numerator if exponent >= 0 else (1 / end) ** -exponent.numerator)
        else:
            ends.append(end.sqrt() ** exponent.numerator if exponent.denominator == 2 else end ** number(exponent))
    return ends[0].union(ends[1])


def _cyclic(cycle: Sequence[Ball], degree: int) -> list[Ball]:
    """cycle[m] / m!, where the derivatives repeat."""
    coefficients, factorial = [], arb(1)
    for m in range(degree + 1):
        factorial = factorial * m if m else factorial
        coefficients.append(cycle[m % len(cycle)] / factorial)
    return coefficients


def _sine(x: Ball, degree: int) -> list[Ball]:
    s, c = x.sin(), x.cos()
    return _cyclic([s, c, -s, -c], degree)


def _cosine(x: Ball, degree: int) -> list[Ball]:
    s, c = x.sin(), x.cos()
    return _cyclic([c, -s, -c, s], degree)


def _riccati(name: str, sign: int) -> Callable[[Ball, int], list[Ball]]:
    """tan and tanh by their differential equation y′ = 1 ± y²."""

    def rule(x: Ball, degree: int) -> list[Ball]:
        y = [getattr(x, name)()]
        for m in range(degree):
            square = sum((y[i] * y[m - i] for i in range(m + 1)), arb(0))
            y.append(((1 if m == 0 else 0) + sign * square) / (m + 1))
        return y

    return rule


def _integrated(name: str, slope: Callable[[Any], Any]) -> Callable[[Ball, int], list[Ball]]:
    """A function by its value and the series of its derivative."""

    def rule(x: Ball, degree: int) -> list[Ball]:
        value = getattr(x, name)()
        series = slope(arb_series([x, 1], degree + 1)).integral()
        coefficients = [arb(c) for c in series.coeffs()]
        return [value, *(coefficients + [arb(0)] * degree)[1 : degree + 1]]

    return rule


def _logarithm(x: Ball, degree: int) -> list[Ball]:
    if not x > 0:
        raise Unenclosed("the logarithm of something that may be zero or negative")
    return [x.log(), *(_monotone_power(x, Fraction(-m)) * (-1) ** (m - 1) / m for m in range(1, degree + 1))]


def _square(x: Ball) -> Ball:
    """x², which is not negative."""
    least, most = x.abs_lower(), x.abs_upper()
    return (least * least).union(most * most)


def _arctangent(x: Ball, degree: int) -> list[Ball]:
    """The m-th coefficient is the imaginary part of −(−i − x)⁻ᵐ/m: with x = cot θ, ± sinᵐθ sin(mθ)/m."""
    angle, sine = arb.pi() / 2 - x.atan(), _monotone_power(1 + _square(x), Fraction(-1, 2))
    powers = [_monotone_power(sine, Fraction(m)) for m in range(1, degree + 1)]
    return [x.atan(), *((-1) ** (m - 1) * power * (m * angle).sin() / m for m, power in enumerate(powers, 1))]


TAYLOR: Final[dict[str, Callable[[Ball, int], list[Ball]]]] = {
    "sin": _sine,
    "cos": _cosine,
    "exp": lambda x, degree: _cyclic([x.exp()], degree),
    "expm1": lambda x, degree: [x.expm1(), *_cyclic([x.exp()], degree)[1:]],
    "sinh": lambda x, degree: _cyclic([x.sinh(), x.cosh()], degree),
    "cosh": lambda x, degree: _cyclic([x.cosh(), x.sinh()], degree),
    "tan": _riccati("tan", 1),
    "tanh": _riccati("tanh", -1),
    "log": _logarithm,
    "log1p": lambda x, degree: [x.log1p(), *_logarithm(1 + x, degree)[1:]],
    "atan": _arctangent,
    "asin": _integrated("asin", lambda t: (1 - t * t).rsqrt()),
    "acos": _integrated("acos", lambda t: -(1 - t * t).rsqrt()),
    "asinh": _integrated("asinh", lambda t: (1 + t * t).rsqrt()),
    "acosh": _integrated("acosh", lambda t: (t * t - 1).rsqrt()),
    "atanh": _integrated("atanh", lambda t: (1 - t * t).inv()),
}
