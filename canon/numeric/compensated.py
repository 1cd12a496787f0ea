"""Arithmetic whose rounding is kept: exact errors of sums and products, and increments that lose nothing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

Constant = tuple[float, float]
"""The sum of two doubles."""

SPLITTER: Final = 134217729.0
"""2**27 + 1."""


def two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """(s, e) with s = fl(a + b) and s + e = a + b exactly. Knuth (1997), The Art of Computer Programming 2, 4.2.2."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def two_product(a: Any, b: Any) -> tuple[Any, Any]:
    """(p, e) with p = fl(ab) and p + e = ab exactly, barring overflow. Dekker (1971), Numer. Math. 18, 224."""
    product = a * b
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def _halves(a: Any) -> tuple[Any, Any]:
    c = SPLITTER * a
    high = c - (c - a)
    return high, a - high


def sum_of_products(pairs: Any) -> tuple[Any, Any]:
    """Σ a·b as (high, low), as accurate as in twice the working precision.

    Ogita, Rump and Oishi (2005), SIAM J. Sci. Comput. 26, 1955.
    """
    high, low = None, 0.0
    for a, b in pairs:
        product, error = two_product(a, b)
        if high is None:
            high, low = product, error
        else:
            high, lost = two_sum(high, product)
            low = low + (lost + error)
    return two_sum(high, low)


def times_constant(h: Any, constant: Constant) -> tuple[Any, Any]:
    """h·c as (high, low), for a constant in two doubles."""
    product, beyond = two_product(h, constant[0])
    return two_sum(product, beyond + h * constant[1])


def weighed_sum(weights: Sequence[tuple[Any, Any]], values: Sequence[Any]) -> tuple[Any, Any]:
    """Σ w·v as (high, low), the weights in two doubles: neither their rounding nor that of the products is lost."""
    high, low = sum_of_products((w, v) for (w, _), v in zip(weights, values, strict=True))
    return two_sum(high, low + sum(beyond * v for (_, beyond), v in zip(weights, values, strict=True)))


def in_two_doubles(value: Any) -> Constant:
    """A number of more digits (of mpmath, or a `Fraction`) as the sum of two doubles."""
    high = float(value)
    return high, float(value - high)


def add_increment(value: Any, lost: Any, increment: Any) -> tuple[Any, Any]:
    """value + lost + increment, as a new value and what its rounding lost. Neumaier (1974), ZAMM 54, 39."""
    return two_sum(value, lost + increment)


def add_pair(value: Any, lost: Any, increment: tuple[Any, Any]) -> tuple[Any, Any]:
    """value + lost + (high + low) likewise."""
    total, rounded = two_sum(value, increment[0])
    return two_sum(total, lost + (rounded + increment[1]))


def add_product(value: Any, lost: Any, a: Any, b: Any) -> tuple[Any, Any]:
    """value + lost + a·b likewise, with what rounding took from the product, too.

    Products with one factor are rounded with a bias where its digits repeat, as those of 1/20 do: what is lost adds up
    to more than a random walk. The increment a·b + lost is rounded first, and added as a whole: what comes next waits
    for one addition after it, and native code makes the increment by one operation.
    """
    product, beyond = two_product(a, b)
    rest = beyond + lost
    increment = product + rest
    total, rounded = two_sum(value, increment)
    return total, rounded + (rest - (increment - product))


def add_small_product(value: Any, lost: Any, a: Any, b: Any) -> tuple[Any, Any]:
    """value + lost + a·b likewise, for increments that are small beside the value most of the time: four operations
    where a product and a sum are one, in place of a dozen. Kahan (1965), Commun. ACM 8, 40.

    The increment's own rounding isn't kept, nor is the sum's exact where the increment is the larger one: both are
    errors of a rounding of the increment.
    """
    increment = a * b + lost
    total = value + increment
    return total, increment - (total - value)
