"""The core of the checker: what decides that a residual is 0, from a program for it and what a certificate shows.

Polynomials are exact sums of monomials, {"g1^2 x": "3/2"} as data. Nothing here knows of mechanics, of functions or of
the text of a claim: a residual is a program of sums, products and powers, of which each leaf (a name, a function) has a
value in the kernels, a fraction of polynomials.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from canon.checker.functions import Rejected, Unknown, Unreadable

Polynomial = dict[tuple[tuple[str, int], ...], Fraction]
ONE: Polynomial = {(): Fraction(1)}
MOST = 3_000_000
HIGHEST = 10_000
TRIES, BITS = 5, 127
STEEPEST = 2**60
"""The highest degree of a residual: at random values modulo a prime a higher one may look like 0."""


class Program(NamedTuple):
    """A formula as `steps` (number, operation, numbers of its parts) up to the `target`, and `leaves` in the kernels.

    An operation is ("n", value), ("+",), ("*",) or ("^", _, exponent); a leaf is (numerator, denominator).
    """

    target: int
    steps: Sequence[tuple[int, tuple[Any, ...], Sequence[int]]]
    leaves: Mapping[int, tuple[Polynomial, Polynomial]]


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


def combined(a: Mapping[Any, Any], b: Mapping[Any, Any], factor: Mapping[Any, Any]) -> dict[Any, Any]:
    """a + factor · b, sums of monomials, multiplied out."""
    if len(b) * len(factor) > MOST:
        raise Unreadable("a product of polynomials that is too large")
    found = dict(a)
    for m, c in b.items():
        for n, d in factor.items():
            powers = dict(m)
            for name, e in n:
                powers[name] = powers.get(name, 0) + e
            key = tuple(sorted(powers.items()))
            found[key] = found.get(key, 0) + c * d
    return {key: c for key, c in found.items() if c}


def names(a: Polynomial) -> set[str]:
    """The names in it."""
    return {name for monomial in a for name, _ in monomial}


def random_prime(rng: random.Random) -> int:
    """A prime of 127 bits, by Miller's and Rabin's test: nobody knows before which one it will be."""
    while True:
        n = rng.getrandbits(BITS) | 1 << BITS - 1 | 1
        if all(n % p for p in (3, 5, 7, 11, 13, 17, 19, 23)) and all(_passes(n, rng) for _ in range(40)):
            return n


def _passes(n: int, rng: random.Random) -> bool:
    d, twos = n - 1, 0
    while d % 2 == 0:
        d, twos = d // 2, twos + 1
    x = pow(rng.randrange(2, n - 1), d, n)
    return x == 1 or any(pow(x, 2**k, n) == n - 1 for k in range(twos))


def modulo(a: Polynomial, of: Mapping[str, int], prime: int) -> int:
    """Its value modulo a prime."""
    total = 0
    for monomial, c in a.items():
        term = c.numerator * pow(c.denominator, -1, prime)
        for name, e in monomial:
            term = term * pow(of[name], e, prime) % prime
        total += term
    return total % prime


def is_triangular(relation: Polynomial, name: str, later: Sequence[str]) -> bool:
    """Whether it is name^n + lower powers of name, with none of the kernels after it.

    No polynomial in the kernels before it, other than 0, is a consequence of such relations: each defines its kernel.
    """
    degree = max((e for monomial in relation for n, e in monomial if n == name), default=0)
    highest = {m: c for m, c in relation.items() if (name, degree) in m}
    return degree > 0 and highest == {((name, degree),): 1} and not names(relation) & ({*later} - {name})


def identity(
    program: Program, entry: Mapping[str, Any], relations: Mapping[str, Polynomial], primes: Sequence[int]
) -> None:
    """residual = numerator / denominator, and numerator = Σ cofactor · relation: so the residual is 0. Raises Rejected.

    **Arguments:** `program`, the residual as it follows from the claim; `entry`, what the certificate shows of it;
    `relations`, polynomials that are known to be 0; `primes`, taken at random. That the denominator has an inverse is
    for others to see (`canon.checker.tower`).
    """
    rest = {m: -c for m, c in fraction(program, entry, primes).items()}
    for name, cofactor in entry["cofactors"].items():
        rest = combined(rest, relations[name], read(cofactor))
    if rest:
        raise Rejected("a numerator isn't the sum of cofactors times relations")


def fraction(program: Program, entry: Mapping[str, Any], primes: Sequence[int]) -> Polynomial:
    """The numerator of a formula that is numerator / denominator, as rational functions of free kernels.

    The two are compared at random values modulo each prime: an error goes unseen with a probability of about
    degree / 2^127 for each. Raises Rejected.
    """
    over, under = (read(entry[word]) for word in ("numerator", "denominator"))
    rng, leaves = random.SystemRandom(), [p for pair in program.leaves.values() for p in pair]
    if not over and under != ONE:
        raise Rejected("0 is written as 0/1")
    if _degree(program) > STEEPEST:
        raise Unknown("a residual of too high a degree")
    free = {name for p in (*leaves, over, under) for name in names(p)}
    for prime in primes:
        for _ in range(TRIES):
            of = {name: rng.randrange(prime) for name in free}
            try:
                value = _run(program, of, prime)
                break
            except ZeroDivisionError:
                continue
        else:
            raise Rejected("a formula of the claim has no value in the kernels")
        if (value * modulo(under, of, prime) - modulo(over, of, prime)) % prime:
            raise Rejected("a formula of the claim isn't the numerator over the denominator that is stated")
    return over


def _degree(program: Program) -> int:
    """A bound for the degrees of numerator and denominator."""
    out = {a: max(sum(e for _, e in m) for p in pair for m in [*p, ()]) for a, pair in program.leaves.items()}
    for a, op, parts in program.steps:
        degrees = [out[b] for b in parts]
        out[a] = degrees[0] * abs(op[2]) if op[0] == "^" else sum(degrees)
    return out[program.target]


def _run(program: Program, of: Mapping[str, int], prime: int) -> int:
    """The value of a program at free values of the kernels, modulo a prime. Raises ZeroDivisionError."""
    out = {
        a: modulo(over, of, prime) * _power(modulo(under, of, prime), -1, prime)
        for a, (over, under) in program.leaves.items()
    }
    for a, op, parts in program.steps:
        x = [out[b] for b in parts]
        if op[0] == "n":
            out[a] = op[1].numerator * _power(op[1].denominator, -1, prime)
        elif op[0] == "^":
            out[a] = _power(x[0], op[2], prime)
        else:
            out[a] = (x[0] + x[1] if op[0] == "+" else x[0] * x[1]) % prime
    return out[program.target]


def _power(x: int, n: int, prime: int) -> int:
    if n < 0 and x % prime == 0:
        raise ZeroDivisionError
    return pow(x, n, prime)
