"""The core of the checker: what decides that a residual is 0, from a program for it and what a certificate shows.

Polynomials are exact sums of monomials, {"g1^2 x": "3/2"} as data. Nothing here knows of mechanics, of functions or of
the text of a claim: a residual is a program of sums, products and powers, of which each leaf (a name, a function) has a
value in the kernels, a fraction of polynomials.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from canon.checker.functions import Rejected, Unreadable

Polynomial = dict[tuple[tuple[str, int], ...], Fraction]
ONE: Polynomial = {(): Fraction(1)}
MOST = 3_000_000
HIGHEST = 10_000
PRIME = 2**127 - 1
FREE_POINTS = 2


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


def modulo(a: Polynomial, of: Mapping[str, int]) -> int:
    """Its value modulo the prime."""
    total = 0
    for monomial, c in a.items():
        term = c.numerator * pow(c.denominator, -1, PRIME)
        for name, e in monomial:
            term = term * pow(of[name], e, PRIME) % PRIME
        total += term
    return total % PRIME


# -- a residual is a fraction of polynomials in the kernels -----------------------------------------


def is_triangular(relation: Polynomial, name: str, later: Sequence[str]) -> bool:
    """Whether it is name^n + lower powers of name, with none of the kernels after it.

    No polynomial in the kernels before it, other than 0, is a consequence of such relations: each defines its kernel.
    """
    degree = max((e for monomial in relation for n, e in monomial if n == name), default=0)
    top = [m for m in relation if (name, degree) in m]
    return (
        degree > 0
        and top == [((name, degree),)]
        and relation[top[0]] == 1
        and not (names(relation) & {*later} - {name})
    )


def identity(program: Program, entry: Mapping[str, Any], relations: Mapping[str, Polynomial]) -> None:
    """residual = numerator / denominator, and numerator = Σ cofactor · relation: so the residual is 0. Raises Rejected.

    **Arguments:** `program`, the residual as it follows from the claim; `entry`, what the certificate shows of it;
    `relations`, polynomials that are known to be 0.
    """
    rest = {m: -c for m, c in fraction(program, entry).items()}
    for name, cofactor in entry["cofactors"].items():
        rest = combined(rest, relations[name], read(cofactor))
    if rest:
        raise Rejected("a numerator isn't the sum of cofactors times relations")


def fraction(program: Program, entry: Mapping[str, Any]) -> Polynomial:
    """The numerator of a formula that is numerator / denominator, as rational functions of free kernels."""
    over, under = (read(entry[word]) for word in ("numerator", "denominator"))
    if not over and under != ONE:
        raise Rejected("0 is written as 0/1")
    compared(program, over, under)
    return over


def compared(program: Program, over: Polynomial, under: Polynomial) -> None:
    """A formula is over / under, as rational functions of free kernels. Raises Rejected.

    The two are compared at random values modulo a prime of 127 bits: an error goes unseen with a probability of about
    degree / 2^127.
    """
    rng, done, leaves = random.SystemRandom(), 0, [p for pair in program.leaves.values() for p in pair]
    free = {name for p in (*leaves, over, under) for name in names(p)}
    for _ in range(5 * FREE_POINTS):
        of = {name: rng.randrange(PRIME) for name in free}
        try:
            value = _run(program, of)
        except ZeroDivisionError:
            continue
        if (value * modulo(under, of) - modulo(over, of)) % PRIME:
            raise Rejected("a formula of the claim isn't the numerator over the denominator that is stated")
        done += 1
    if done < FREE_POINTS:
        raise Rejected("a formula of the claim has no value in the kernels")


def _run(program: Program, of: Mapping[str, int]) -> int:
    """The value of a program at free values of the kernels, modulo the prime."""
    out = {a: modulo(over, of) * _inverse(modulo(under, of)) % PRIME for a, (over, under) in program.leaves.items()}
    for a, op, parts in program.steps:
        x = [out[b] for b in parts]
        if op[0] == "n":
            out[a] = op[1].numerator * _inverse(op[1].denominator) % PRIME
        elif op[0] == "^":
            out[a] = pow(x[0] if op[2] > 0 else _inverse(x[0]), abs(op[2]), PRIME)
        else:
            out[a] = (x[0] + x[1] if op[0] == "+" else x[0] * x[1]) % PRIME
    return out[program.target]


def _inverse(x: int) -> int:
    if x % PRIME == 0:
        raise ZeroDivisionError
    return pow(x, -1, PRIME)
