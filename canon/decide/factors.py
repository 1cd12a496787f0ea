"""The prime factors of numbers, where they are found quickly."""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from flint import fmpz

from canon.decide.tape import Unsupported

LONGEST: Final = 200
"""Bits of a number that is factored at all."""
HARDEST: Final = 150
"""Bits of what is left without its small factors: two primes of 75 bits take a tenth of a second, of 100 bits three."""


def prime_factors(value: Fraction) -> list[tuple[int, int]]:
    """The primes of a positive number with their exponents; **raises** `Unsupported` where they would take long."""
    if max(value.numerator.bit_length(), value.denominator.bit_length()) > LONGEST:
        raise Unsupported("a root or logarithm of a number too long to factor")
    return [
        *((p, e) for p, e in _factored(fmpz(value.numerator))),
        *((p, -e) for p, e in _factored(fmpz(value.denominator))),
    ]


def _factored(number: fmpz) -> list[tuple[int, int]]:
    found: list[tuple[int, int]] = []
    for part, exponent in number.factor_smooth(15):
        if part.is_prime():
            found.append((int(part), int(exponent)))
        elif int(part).bit_length() > HARDEST:
            raise Unsupported("a root or logarithm of a number that takes long to factor")
        else:
            found += [(int(p), int(e * exponent)) for p, e in part.factor()]
    return sorted(found)
