"""Polynomials in names with exact fractions, and quotients of them, for the small checkers beside this file."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker.alone import Stop
else:  # as a program, beside the other files
    from alone import Stop  # type: ignore

Polynomial = dict[tuple[tuple[str, int], ...], Fraction]
"""{((name, power), …): its coefficient}; none of these is 0."""
Quotient = tuple[Polynomial, Polynomial]
"""Numerator and denominator; the latter is positive wherever the formula has a value."""

MOST_TERMS, HIGHEST = 400, 24
ONE: Polynomial = {(): Fraction(1)}


def plus(p: Polynomial, q: Polynomial) -> Polynomial:
    found = dict(p)
    for m, c in q.items():
        found[m] = found.get(m, Fraction(0)) + c
    return {m: c for m, c in found.items() if c}


def times(p: Polynomial, q: Polynomial) -> Polynomial:
    if len(p) * len(q) > MOST_TERMS**2:
        raise Stop("not shown", "polynomials that are so long")
    found: Polynomial = {}
    for m, c in p.items():
        for n, d in q.items():
            powers = dict(m)
            for name, k in n:
                powers[name] = powers.get(name, 0) + k
            if max(powers.values(), default=0) > 4 * HIGHEST:
                raise Stop("not shown", "powers that are so high")
            key = tuple(sorted(powers.items()))
            found[key] = found.get(key, Fraction(0)) + c * d
    if len(found) > MOST_TERMS:
        raise Stop("not shown", "polynomials that are so long")
    return {m: c for m, c in found.items() if c}


def power(p: Polynomial, n: int) -> Polynomial:
    if n > HIGHEST:
        raise Stop("not shown", "powers that are so high")
    found = ONE
    for _ in range(n):
        found = times(found, p)
    return found


def minus(p: Polynomial) -> Polynomial:
    return {m: -c for m, c in p.items()}


def named(name: str, n: int = 1) -> Polynomial:
    return {((name, n),): Fraction(1)}


def number(r: Any) -> Polynomial:
    return {(): Fraction(r)} if r else {}


def by_powers(p: Polynomial, name: str) -> dict[int, Polynomial]:
    """The coefficients of the powers of a name."""
    found: dict[int, Polynomial] = {}
    for m, c in p.items():
        rest = tuple(one for one in m if one[0] != name)
        found.setdefault(dict(m).get(name, 0), {})[rest] = c
    return found


def names_in(p: Polynomial) -> list[str]:
    return sorted({name for m in p for name, _ in m})


def added(a: Quotient, b: Quotient) -> Quotient:
    return (plus(a[0], b[0]), a[1]) if a[1] == b[1] else (plus(times(a[0], b[1]), times(b[0], a[1])), times(a[1], b[1]))


def multiplied(a: Quotient, b: Quotient) -> Quotient:
    return times(a[0], b[0]), times(a[1], b[1])
