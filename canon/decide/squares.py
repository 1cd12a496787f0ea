"""Radicands that are squares, though not as they are written.

By cos² + sin² = 1: 1 − c² = s² and 1 − 2sc = (c − s)². By a radical that is there already: with g² = x − 1,
x − 2g = (g − 1)². By Jacobi's functions: 1 − m sn² = dn². Each is an identity modulo the relations; the root is then
an absolute value.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING

from canon.decide.fraction_field import Element
from canon.decide.ring import Polynomial

if TYPE_CHECKING:
    from canon.decide.tower import Tower

MOST_TERMS, MOST_DEGREE = 40, 8


def hidden_square(tower: Tower, x: Element) -> tuple[Fraction, Element] | None:
    """(c, b) with x = c · b² by the relations and c > 0, or None where no such form is seen."""
    if x[1] or not 1 < len(x[0]) <= MOST_TERMS:
        return None
    field = tower.field
    elliptic = _by_jacobi(tower, x[0])
    if elliptic is not None:
        return elliptic
    for form in (*_by_pythagoras(tower, x[0]), *_by_radicals(tower, x[0])):
        content, pieces = tower.ring.factor(form)
        if content > 0 and all(e % 2 == 0 for _, e in pieces):
            return content, field.product([field.constant(1), *(field.power((f, {}), e // 2) for f, e in pieces)])
    return None


def _by_pythagoras(tower: Tower, p: Polynomial) -> Iterator[Polynomial]:
    """p made homogeneous in a pair (c, s) by powers of c² + s²."""
    ring = tower.ring
    terms = ring.terms(p)
    for _, (cosine, sine) in tower.memory.get("angles", []):
        c, s = cosine[0], sine[0]
        if not s:  # an angle of whole turns
            continue
        k, m = ring.degrees(c).index(1), ring.degrees(s).index(1)
        degrees = {e[k] + e[m] for e in terms}
        top = max(degrees)
        if not 0 < top <= MOST_DEGREE or any((top - d) % 2 for d in degrees):
            continue
        total = ring.zero
        for e, coefficient in terms.items():
            total = total + ring.polynomial({e: coefficient}) * (c**2 + s**2) ** ((top - e[k] - e[m]) // 2)
        yield total


def _by_radicals(tower: Tower, p: Polynomial) -> Iterator[Polynomial]:
    """p with a symbol x written through a radical g with g² = a + b·x, b a number."""
    ring = tower.ring
    degrees = ring.degrees(p)
    for radicand, prime, height, made in tower.memory.get("roots", []):
        if (prime, height) != (2, 1) or not degrees[made.index]:
            continue
        for k, degree in enumerate(ring.degrees(radicand)):
            if degree != 1 or not 0 < degrees[k] <= MOST_DEGREE or tower.generators[k].kind != "symbol":
                continue
            linear = {m: c for m, c in ring.terms(radicand).items() if m[k]}
            if len(linear) != 1 or sum(next(iter(linear))) != 1:
                continue
            x, slope = ring.generators[k], next(iter(linear.values()))
            rest = radicand - x * ring.constant(slope)
            value = (ring.generators[made.index] ** 2 - rest) * ring.constant(1 / slope)
            total = ring.zero
            for monomial, coefficient in ring.terms(p).items():
                without = (*monomial[:k], 0, *monomial[k + 1 :])
                total = total + ring.polynomial({without: coefficient}) * value ** monomial[k]
            yield total


def _by_jacobi(tower: Tower, p: Polynomial) -> tuple[Fraction, Element] | None:
    """p as c · g² · q² with g one of cn, dn and g² the right-hand side of its relation."""
    ring, field = tower.ring, tower.field
    for made in tower.generators:
        if not made.kind.startswith("jacobi_") or not made.degree:
            continue
        quotient = ring.quotient(p, made.lower)
        if quotient is None:
            continue
        content, pieces = ring.factor(quotient)
        if content > 0 and all(e % 2 == 0 for _, e in pieces):
            parts = [tower.element(made), *(field.power((f, {}), e // 2) for f, e in pieces)]
            return content, field.product(parts)
    return None
