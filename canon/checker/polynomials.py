"""The checker's polynomials: {"g1^2 x": "3/2"} as exact sums of monomials."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

from canon.checker.functions import Unreadable

Polynomial = dict[tuple[tuple[str, int], ...], Fraction]
MOST = 3_000_000
HIGHEST = 10_000


def read(data: Any) -> Polynomial:
    """The polynomial of a table monomial = coefficient, such as {"g1^2": "1", "x^2": "-1", "": "1/2"}."""
    if not isinstance(data, Mapping):
        raise Unreadable("a polynomial is a table of monomials with their coefficients")
    found: Polynomial = {}
    for monomial, coefficient in data.items():
        powers: dict[str, int] = {}
        for factor in str(monomial).split():
            name, _, exponent = factor.partition("^")
            if not (exponent or "1").isdecimal() or len(exponent) > 5 or int(exponent or 1) > HIGHEST:
                raise Unreadable(f"no power: {factor[:40]!r}")
            powers[name] = powers.get(name, 0) + int(exponent or 1)
        key = tuple(sorted(powers.items()))
        found[key] = found.get(key, Fraction(0)) + number(coefficient)
    return {key: c for key, c in found.items() if c}


def number(text: Any) -> Fraction:
    """A rational number, such as "-3/2" or "0.25"."""
    try:
        if not isinstance(text, (str, int)) or len(str(text)) > 20_000 or "e" in str(text).lower():
            raise ValueError
        return Fraction(str(text))
    except (ValueError, ZeroDivisionError):
        raise Unreadable(f"no rational number: {str(text)[:40]!r}") from None


def combined(a: Polynomial, b: Polynomial, factor: Polynomial) -> Polynomial:
    """a + factor · b, multiplied out."""
    if len(b) * len(factor) > MOST:
        raise Unreadable("a product of polynomials that is too large")
    found = dict(a)
    for m, c in b.items():
        for n, d in factor.items():
            powers = dict(m)
            for name, e in n:
                powers[name] = powers.get(name, 0) + e
            key = tuple(sorted(powers.items()))
            found[key] = found.get(key, Fraction(0)) + c * d
    return {key: c for key, c in found.items() if c}


def names(a: Polynomial) -> set[str]:
    """The names in it."""
    return {name for monomial in a for name, _ in monomial}


def value(a: Polynomial, of: Mapping[str, Any], number_of: Callable[[Fraction], Any]) -> tuple[Any, Any]:
    """Its value, and the sum of the moduli of its terms: what its rounding errors are to be measured against."""
    total = size = number_of(Fraction(0))
    for monomial, c in a.items():
        term = number_of(c)
        for name, e in monomial:
            if name not in of:
                raise Unreadable(f"{name[:40]!r} is neither a name of the claim nor a kernel")
            term = term * of[name] ** e
        total, size = total + term, size + abs(term)
    return total, size


def modulo(a: Polynomial, of: Mapping[str, int], prime: int) -> int:
    """Its value modulo a prime."""
    total = 0
    for monomial, c in a.items():
        term = c.numerator * pow(c.denominator, -1, prime)
        for name, e in monomial:
            term = term * pow(of[name], e, prime) % prime
        total += term
    return total % prime
