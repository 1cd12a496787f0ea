"""Polynomials of the core, taken apart: common monomials, quotients, coefficients of one name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction

from canon.checker import core
from canon.checker.core import Polynomial, combined

MOST = 120
"""Terms of a polynomial, beyond which it is given up."""
ONE = core.ONE


class Undetermined(ValueError):
    """A formula that isn't one of real quantities, or is too large."""


def name_of(name: str, exponent: int = 1) -> Polynomial:
    """A power of a name."""
    return {((name, exponent),): Fraction(1)}


def times(*factors: Polynomial) -> Polynomial:
    """Their product. Raises Undetermined for one that is too large."""
    total = ONE
    for factor in factors:
        if len(total) * len(factor) > MOST**2:
            raise Undetermined
        total = combined({}, total, factor)
    if len(total) > MOST:
        raise Undetermined
    return total


def minus(p: Polynomial) -> Polynomial:
    """-p."""
    return {m: -c for m, c in p.items()}


def plus(p: Polynomial) -> Polynomial:
    """p."""
    return p


def parted(p: Polynomial) -> tuple[Polynomial, Polynomial]:
    """The monomial that is common to its terms, and the rest."""
    common = dict(min(p, key=len, default=()))
    for m in p:
        powers = dict(m)
        common = {n: min(e, powers[n]) for n, e in common.items() if n in powers}
    rest = {tuple((n, e - common.get(n, 0)) for n, e in m if e > common.get(n, 0)): c for m, c in p.items()}
    return {tuple(sorted(common.items())): Fraction(1)}, rest


def divided(p: Polynomial, q: Polynomial) -> Polynomial | None:
    """The quotient, where it is a polynomial; None where there is a rest."""
    order = sorted(core.names(p) | core.names(q))

    def leading(x: Polynomial) -> tuple[tuple[int, ...], Fraction]:
        return max((tuple(dict(m).get(n, 0) for n in order), c) for m, c in x.items())

    (powers, c), found = leading(q), Polynomial()
    while p and len(found) < MOST:
        high, d = leading(p)
        rest = [a - b for a, b in zip(high, powers, strict=True)]
        if min(rest, default=0) < 0:
            return None
        factor = {tuple((n, e) for n, e in zip(order, rest, strict=True) if e): d / c}
        found |= factor
        p = combined(p, q, {m: -x for m, x in factor.items()})
    return None if p else found


def is_multiple(p: Polynomial, other: Polynomial) -> bool:
    """Whether p is a positive number times another polynomial."""
    if p.keys() != other.keys():
        return False
    ratios = {c / other[m] for m, c in p.items()}
    return len(ratios) == 1 and ratios.pop() > 0


def coefficients(p: Polynomial, name: str) -> list[Polynomial]:
    """Those of the powers of a name, from the 0th on."""
    parts: list[Polynomial] = [{} for _ in range(1 + max(dict(m).get(name, 0) for m in p))]
    for m, c in p.items():
        parts[dict(m).get(name, 0)][tuple((n, e) for n, e in m if n != name)] = c
    return parts


def shifts_of(p: Polynomial, above: str) -> Iterator[tuple[str, int, Polynomial]]:
    """What p = d says of a name u, or of its square: with k u + rest = d it is (d - rest)/k; d is called `above`."""
    for m, k in p.items():
        if len(m) != 1 or m[0][1] not in (1, 2):
            continue
        name, exponent = m[0]
        rest = {n: c for n, c in p.items() if n != m}
        if name not in core.names(rest):
            yield name, exponent, {n: c / k for n, c in combined(name_of(above), rest, {(): Fraction(-1)}).items()}


def is_below_one(p: Polynomial) -> str:
    """The name of c in a multiple of 1 - c²; "" for any other polynomial."""
    names = core.names(p)
    name = min(names, default="")
    return name if len(names) == 1 and is_multiple(p, {(): Fraction(1), ((name, 2),): Fraction(-1)}) else ""


def reduced(p: Polynomial, rules: Mapping[str, tuple[int, Polynomial]]) -> Polynomial:
    """Without powers of names that are, from the n-th on, polynomials in others. Raises Undetermined."""
    for _ in range(40):
        step: Polynomial = {}
        for m, c in p.items():
            name = next((n for n, e in m if n in rules and e >= rules[n][0]), None)
            value = ONE if name is None else rules[name][1]
            rest = tuple((n, e - rules[n][0] if n == name else e) for n, e in m if n != name or e > rules[n][0])
            step = combined(step, {rest: c}, value)
        if step == p:
            return p
        p = step
        if len(p) > MOST:
            raise Undetermined
    raise Undetermined
