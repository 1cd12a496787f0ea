"""Numbers as unevaluated sums of two doubles: some 106 bits, by error-free sums and products. Arrays of any shape.

Dekker (1971), Numer. Math. 18, 224; Joldes, Muller and Popescu (2017), ACM Trans. Math. Softw. 44, 15, whose bounds of
the four operations lie below 10 u², u = 2⁻⁵³; the functions as in Hida, Li and Bailey (2001), ARITH-15, 155. The range
is that of doubles, from 10⁻²⁹⁰ on, below which the second halves underflow. Conditioning is each operation's own:
nothing is kept that its arguments have lost.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial
from typing import Any, Final, NamedTuple

import numpy as np

from canon.numeric.compensated import two_product, two_sum

UNIT: Final = 2.0**-102
"""The relative error of an operation, or of a function, is less than this: 16 u²."""
HALVINGS: Final = 9
SERIES: Final = 16
WIDEST: Final = 2.0**20
"""Arguments of sin and cos beyond this have no value here: their turns are taken off with 210 bits of π."""


class Pair(NamedTuple):
    """high + low, |low| at most half a unit in the last place of high."""

    high: Any
    low: Any


def pair(value: Fraction | float) -> Pair:
    """The pair nearest to a number."""
    high = float(value)
    return Pair(high, float(Fraction(value) - Fraction(high)))


PI_OVER_2: Final = (1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33, 5.562271104316827e-50)
LOG_2: Final = Pair(0.6931471805599453, 2.3190468138462996e-17)
ONE: Final = Pair(1.0, 0.0)


def add(a: Pair, b: Pair) -> Pair:
    """a + b."""
    high, low = two_sum(a.high, b.high)
    other, rest = two_sum(a.low, b.low)
    high, low = two_sum(high, low + other)
    return Pair(*two_sum(high, low + rest))


def negative(a: Pair) -> Pair:
    """−a."""
    return Pair(-a.high, -a.low)


def subtract(a: Pair, b: Pair) -> Pair:
    """a − b."""
    return add(a, negative(b))


def multiply(a: Pair, b: Pair) -> Pair:
    """a · b."""
    high, low = two_product(a.high, b.high)
    return Pair(*two_sum(high, low + (a.high * b.low + a.low * b.high)))


def divide(a: Pair, b: Pair) -> Pair:
    """a / b, by three quotients in double precision."""
    first = a.high / b.high
    rest = subtract(a, multiply(b, Pair(first, 0.0 * first)))
    second = rest.high / b.high
    rest = subtract(rest, multiply(b, Pair(second, 0.0 * second)))
    return add(Pair(*two_sum(first, second)), Pair(rest.high / b.high, 0.0 * first))


def scaled(a: Pair, power_of_two: Any) -> Pair:
    """a times a power of two, exactly."""
    return Pair(a.high * power_of_two, a.low * power_of_two)


def power(a: Pair, exponent: int) -> Pair:
    """a to a whole exponent, by squares."""
    if exponent < 0:
        return divide(ONE, power(a, -exponent))
    result, square = ONE, a
    while exponent:
        if exponent & 1:
            result = multiply(result, square)
        exponent >>= 1
        square = multiply(square, square) if exponent else square
    return result


def square_root(a: Pair) -> Pair:
    """√a: one step of Newton's from the root in double precision. Karp and Markstein (1997), ACM TOMS 23, 561."""
    near = np.sqrt(a.high)
    rest = subtract(a, Pair(*two_product(near, near)))
    return Pair(*two_sum(near, np.where(near > 0, rest.high / (2 * near), 0.0)))


def absolute(a: Pair) -> Pair:
    """|a|."""
    sign = np.where(a.high < 0, -1.0, 1.0)
    return Pair(sign * a.high, sign * a.low)


def exponential(a: Pair) -> Pair:
    """e^a: e^r − 1 of a 512th of what multiples of log 2 leave, by its series, and doubled nine times."""
    turns = np.rint(a.high / LOG_2.high)
    rest = subtract(a, multiply(Pair(turns, 0.0 * turns), LOG_2))
    small = scaled(rest, 2.0**-HALVINGS)
    total = _series(small, [Fraction(1, factorial(k + 1)) for k in range(SERIES // 2)])
    beyond = multiply(total, small)
    for _ in range(HALVINGS):
        beyond = add(scaled(beyond, 2.0), multiply(beyond, beyond))
    value = add(beyond, ONE)
    return Pair(np.ldexp(value.high, turns.astype(int)), np.ldexp(value.low, turns.astype(int)))


def logarithm(a: Pair) -> Pair:
    """log a: near 1 by the series of 2 artanh((a − 1)/(a + 1)), whose digits are relative; else a step of Newton's."""
    near = np.log(a.high)
    first = Pair(near, 0.0 * near)
    newton = add(first, subtract(multiply(a, exponential(negative(first))), ONE))
    s = divide(subtract(a, ONE), add(a, ONE))
    series = scaled(multiply(_series(multiply(s, s), [Fraction(1, 2 * k + 1) for k in range(SERIES)]), s), 2.0)
    return _where(np.abs(a.high - 1) < 0.15, series, newton)


def sine_and_cosine(a: Pair) -> tuple[Pair, Pair]:
    """sin a and cos a, by series between −π/4 and π/4; not finite beyond `WIDEST`."""
    turns = np.rint(a.high / PI_OVER_2[0])
    turns = np.where(np.abs(a.high) < WIDEST, turns, np.nan)
    rest = a
    for part in PI_OVER_2:
        rest = subtract(rest, Pair(*two_product(turns, part)))
    square = multiply(rest, rest)
    signs = [(-1) ** k for k in range(SERIES)]
    sine = multiply(_series(square, [Fraction(s, factorial(2 * k + 1)) for k, s in enumerate(signs)]), rest)
    cosine = _series(square, [Fraction(s, factorial(2 * k)) for k, s in enumerate(signs)])
    quarter = np.where(np.isfinite(turns), turns, 0).astype(int) % 4
    odd = quarter % 2 == 1
    s, c = _where(odd, cosine, sine), _where(odd, sine, cosine)
    return (
        _where(quarter >= 2, negative(s), s),
        _where((quarter == 1) | (quarter == 2), negative(c), c),
    )


def angle(y: Pair, x: Pair) -> Pair:
    """atan2(y, x): the angle in double precision, turned by what is left of (x, y) in that direction."""
    near = np.arctan2(y.high, x.high)
    first = Pair(near, 0.0 * near)
    sine, cosine = sine_and_cosine(first)
    across = subtract(multiply(y, cosine), multiply(x, sine))
    along = add(multiply(x, cosine), multiply(y, sine))
    return add(first, divide(across, along))


def _series(x: Pair, coefficients: list[Fraction]) -> Pair:
    """Σ c_k x^k by Horner's scheme."""
    total = pair(coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        total = add(multiply(total, x), pair(coefficient))
    return total


def _where(condition: Any, a: Pair, b: Pair) -> Pair:
    return Pair(np.where(condition, a.high, b.high), np.where(condition, a.low, b.low))
