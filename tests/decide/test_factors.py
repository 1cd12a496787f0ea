"""The primes of a number, with their exponents, make it up."""

from fractions import Fraction
from math import prod

import pytest
from flint import fmpz

from canon.decide.factors import HARDEST, LONGEST, prime_factors
from canon.decide.tape import Unsupported

P, Q = 2**31 - 1, 65537
LONG, OTHER = 2**50 - 27, 2**49 + 69


@pytest.mark.parametrize(
    "value",
    [
        1,
        12,
        Fraction(9, 8),
        P,
        P**2,
        (P * Q) ** 2,
        Fraction((P * Q) ** 2 * 48, 49),
        Fraction(7, P * Q * 27),
        LONG**2 * OTHER**2,
        LONG**2 * OTHER,
    ],
)
def test_the_primes_make_up_the_number(value):
    found = prime_factors(Fraction(value))
    assert prod((Fraction(p) ** e for p, e in found), start=Fraction(1)) == value
    assert all(fmpz(p).is_prime() and e for p, e in found)
    assert len({p for p, _ in found}) == len(found)


def test_what_takes_long_is_refused():
    with pytest.raises(Unsupported):
        prime_factors(Fraction(2 ** (LONGEST + 1)))
    first, second = 2**89 - 1, 2**107 - 1
    assert HARDEST < (first * second).bit_length() <= LONGEST
    with pytest.raises(Unsupported):
        prime_factors(Fraction(first * second))
