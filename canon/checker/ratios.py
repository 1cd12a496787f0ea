"""Rational ratios of numbers modulo a prime."""

from __future__ import annotations

from canon.checker.core import Fraction
from canon.checker.tower import Element


def ratio(x: Element, y: Element, prime: int) -> int | None:
    """The number c with x = c y; None where there is none."""
    if not x or x.keys() != y.keys():
        return None
    m = next(iter(x))
    found = x[m] * pow(y[m], -1, prime) % prime
    return found if all((found * y[k] - c) % prime == 0 for k, c in x.items()) else None


def multiple(x: Element, y: Element, prime: int) -> Fraction | None:
    """The rational number c with x = c y; None where there is none."""
    found = ratio(x, y, prime)
    return None if found is None else rational(found, prime)


def rational(x: int, prime: int) -> Fraction | None:
    """The rational number that stands for a residue, if there is one with a numerator and a denominator below 2^40."""
    a, b, u, v = prime, x, 0, 1
    while b >> 40:
        q = a // b
        a, b, u, v = b, a - q * b, v, u - q * v
    return Fraction(b, v) if v and not abs(v) >> 40 else None
