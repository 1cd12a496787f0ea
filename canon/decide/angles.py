"""Cosines and sines as generators: a pair (c, s) with c² + s² = 1 for each angle of a Q-basis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from flint import arb, arb_poly, fmpz_poly

from canon.decide.enclosure import precision
from canon.decide.fraction_field import Element
from canon.decide.intervals import Edge, Interval
from canon.decide.linear import divided_basis
from canon.decide.radicals import power
from canon.decide.tape import ONE, Unsupported

if TYPE_CHECKING:
    from canon.decide.tower import Generator, Tower

Pair = tuple[Element, Element]
HALF = Fraction(1, 2)
MOST_TURNS = 400
PEELED = ("atan", "asin", "acos", "atan2", "pi")


def cosines_and_sines(tower: Tower, arguments: Sequence[Element]) -> list[Pair]:
    """(cos x, sin x) of each argument; multiples of inverse functions and of π are peeled off first."""
    field = tower.field
    results: list[Pair] = [(field.constant(1), field.constant(0)) for _ in arguments]
    taken, rest = [], []
    for x in arguments:
        peeled, left = take_out(tower, x, PEELED)
        taken.append(peeled)
        rest.append(left)
    parts: dict[int, int] = {}
    for peeled in taken:
        for k, q in peeled.items():
            parts[k] = math.lcm(parts.get(k, 1), q.denominator)
    for n, peeled in enumerate(taken):
        for k, q in peeled.items():
            results[n] = added(tower, results[n], _peeled_pair(tower, tower.generators[k], q, parts[k]))
    where = [n for n, x in enumerate(rest) if x[0]]
    if where:
        for n, pair in zip(where, _over_a_basis(tower, [rest[n] for n in where]), strict=True):
            results[n] = added(tower, results[n], pair)
    return results


def added(tower: Tower, a: Pair, b: Pair) -> Pair:
    """The addition theorem."""
    field = tower.field
    cosine = field.combine([(ONE, field.product([a[0], b[0]])), (-ONE, field.product([a[1], b[1]]))])
    sine = field.combine([(ONE, field.product([a[1], b[0]])), (ONE, field.product([a[0], b[1]]))])
    return (field.normal(cosine[0]), cosine[1]), (field.normal(sine[0]), sine[1])


def multiple(tower: Tower, pair: Pair, n: int) -> Pair:
    """(cos n·x, sin n·x) from (cos x, sin x)."""
    field = tower.field
    if n < 0:
        c, s = multiple(tower, pair, -n)
        return c, field.negative(s)
    if n == 0:
        return field.constant(1), field.constant(0)
    if n == 1:
        return pair
    lower = multiple(tower, pair, n // 2)
    upper = lower if n % 2 == 0 else multiple(tower, pair, n - n // 2)
    return added(tower, lower, upper)


def _over_a_basis(tower: Tower, new: list[Element]) -> list[Pair]:
    field = tower.field
    table: list[tuple[Element, Pair]] = tower.memory.setdefault("angles", [])
    old = [b for b, _ in table]
    combinations, parts = divided_basis(tower, old, new, MOST_TURNS)
    pairs = {k: _angle(tower, field.combine([(Fraction(1, parts[k]), [*old, *new][k])])) for k in parts}
    out = []
    for position, combination in enumerate(combinations):
        if any(k not in parts and q.denominator != 1 for k, q in combination.items()):
            out.append(_angle(tower, new[position]))
            continue
        pair = (field.constant(1), field.constant(0))
        for k, q in combination.items():
            base = pairs[k] if k in parts else table[k][1]
            pair = added(tower, pair, multiple(tower, base, int(q * parts.get(k, 1))))
        out.append(pair)
    return out


def _angle(tower: Tower, b: Element) -> Pair:
    """The pair of a basic angle, with the signs that the angle's interval gives."""
    table = tower.memory["angles"]
    for known, pair in table:
        if tower.field.equal(b, known):
            return pair
    constant = tower.is_constant(b)
    if _is_whole_turn(tower, b):
        c = tower.generator("cos", "real", b, relation=(2, tower.ring.one))
        pair = tower.element(c), tower.field.constant(0)
        table.append((b, pair))
        return pair
    if tower.is_complex(b):
        c_sign = s_sign = "cplx"
    else:
        interval = _interval(tower, b)
        c_sign, s_sign = interval.cosine_sign() or "real", interval.sine_sign() or "real"
    c = tower.generator("cos", c_sign, b, constant=constant)
    lower = tower.ring.one - tower.ring.generators[c.index] ** 2
    s = tower.generator("sin", s_sign, b, relation=(2, lower), constant=constant)
    pair = tower.element(c), tower.element(s)
    table.append((b, pair))
    return pair


def _is_whole_turn(tower: Tower, b: Element) -> bool:
    """True for π times a polynomial with whole coefficients in integer names: its sine is 0, its cosine ±1."""
    if b[1] or not b[0]:
        return False
    for monomial, coefficient in tower.ring.terms(b[0]).items():
        made = [(tower.generators[k], e) for k, e in enumerate(monomial) if e]
        turns = [e for g, e in made if g.kind == "pi"]
        names = [g.data for g, _ in made if g.kind == "symbol"]
        if turns != [1] or len(names) + 1 != len(made) or coefficient.denominator != 1:
            return False
        if not names or not all(tower.tape.symbol_at(n).is_integer for n in names):
            return False
    return True


def _interval(tower: Tower, b: Element) -> Interval:
    """The exact interval of an angle a·x + c, with one bounded symbol x, and a in Q or in Q·π, c in Q + Q·π."""
    if b[1]:
        return Interval()
    slope, shift, symbol, turns = Fraction(1), Edge(), None, False
    for monomial, coefficient in tower.ring.terms(b[0]).items():
        made = [tower.generators[k] for k, e in enumerate(monomial) for _ in range(e)]
        names = [g.data for g in made if g.kind == "symbol"]
        halves = sum(g.kind == "pi" for g in made)
        if halves > 1 or len(names) + halves < len(made) or len(names) > 1 or (names and symbol is not None):
            return Interval()
        if names:
            symbol, slope, turns = names[0], coefficient, bool(halves)
        else:
            shift = shift.plus(Edge(Fraction(0), coefficient) if halves else Edge(coefficient))
    if symbol is None:
        return Interval(shift, shift)
    if symbol not in tower.intervals:
        return Interval()
    interval = tower.intervals[symbol]
    if not turns:
        return interval.affine(slope, shift)
    ends = [interval.low, interval.high]
    if any(end is not None and end.pi for end in ends):
        return Interval()
    low, high = (None if end is None else Edge(Fraction(0), slope * end.rational).plus(shift) for end in ends)
    return Interval(low, high) if slope > 0 else Interval(high, low)


def take_out(tower: Tower, x: Element, kinds: tuple[str, ...]) -> tuple[dict[int, Fraction], Element]:
    """x = Σ q · generator + rest, with rational q, over the generators of these kinds that x contains linearly."""
    n, den = x
    ring, field = tower.ring, tower.field
    if not n:
        return {}, x
    degrees = ring.degrees(n)
    candidates = [g.index for g in tower.generators if g.kind in kinds and degrees[g.index] == 1]
    if not candidates:
        return {}, x
    under = ring.one
    for k, e in den.items():
        under = field.normal(ring.times(under, field.factor_power(k, e)))
    below, terms = ring.terms(under), ring.terms(n)
    first = next(iter(below))
    taken: dict[int, Fraction] = {}
    for k in candidates:
        part = {(*m[:k], 0, *m[k + 1 :]): c for m, c in terms.items() if m[k] == 1}
        if first not in part:
            continue
        q = part[first] / below[first]
        if any(part.get(m) != q * c for m, c in below.items()):
            continue
        taken[k] = q
        for m in below:
            terms.pop((*m[:k], 1, *m[k + 1 :]))
    if not taken:
        return {}, x
    return taken, (ring.polynomial(terms), dict(den)) if terms else (ring.zero, {})


def _peeled_pair(tower: Tower, made: Generator, q: Fraction, parts: int) -> Pair:
    """(cos, sin) of q times an inverse function or π, through the function's (1/parts)-th."""
    if made.kind == "pi":
        return _of_pi(tower, q)
    table = tower.memory.setdefault("peeled", [])
    for index, order, pair in table:
        if index == made.index and order == parts:
            return multiple(tower, pair, int(q * parts))
    pair = _inverse_pair(tower, made)
    if parts == 2:
        pair = _halved(tower, pair)
    elif parts != 1:
        raise Unsupported("a fraction of an inverse trigonometric function")
    table.append((made.index, parts, pair))
    return multiple(tower, pair, int(q * parts))


def _inverse_pair(tower: Tower, made: Generator) -> Pair:
    """(cos, sin) of the principal values: atan and asin in (−π/2, π/2), acos in (0, π), atan2 in (−π, π)."""
    field = tower.field
    u = made.data[0]
    square = field.power(u, 2)
    if made.kind == "atan":
        inverse = field.inverse(power(tower, field.combine([(ONE, square)], ONE), HALF))
        return inverse, field.product([u, inverse])
    if made.kind == "atan2":
        x = made.data[1]
        radius = power(tower, field.combine([(ONE, field.power(x, 2)), (ONE, square)]), HALF)
        inverse = field.inverse(radius)
        return field.product([x, inverse]), field.product([u, inverse])
    other = power(tower, field.combine([(-ONE, square)], ONE), HALF)
    return (other, u) if made.kind == "asin" else (u, other)


def _halved(tower: Tower, pair: Pair) -> Pair:
    """The half angle of an angle in (−π, π), whose cosine is positive."""
    field = tower.field
    c = power(tower, field.combine([(HALF, pair[0])], HALF), HALF)
    return c, field.product([field.constant(HALF), pair[1], field.inverse(c)])


def _of_pi(tower: Tower, q: Fraction) -> Pair:
    """(cos qπ, sin qπ): by radicals for the twelfths, else by the minimal polynomial of cos(π/n)."""
    field, n = tower.field, q.denominator
    if n in (1, 2, 3, 4, 6, 12):
        return multiple(tower, _twelfth(tower), int(q * 12) % 24)
    if n > 60:
        raise Unsupported("a small fraction of pi")
    table = tower.memory.setdefault("fractions of pi", [])
    for order, pair in table:
        if order % n == 0:
            return multiple(tower, pair, int(q * order) % (2 * order))
    degree, coefficients = _cosine_polynomial(n)
    index = len(tower.generators)
    if index >= tower.ring.size:
        tower.generator("full", "real", None)
    g = tower.ring.generators[index]
    lower = tower.ring.zero
    for k, c in enumerate(coefficients):
        lower = lower + g**k * tower.ring.constant(c)
    c = tower.generator("cos of pi/n", "pos", n, relation=(degree, lower), constant=True)
    square = field.normal(tower.ring.one - g**2)
    s = tower.generator("sin of pi/n", "pos", n, relation=(2, square), constant=True)
    pair = tower.element(c), tower.element(s)
    table.append((n, pair))
    return multiple(tower, pair, int(q * n) % (2 * n))


def _twelfth(tower: Tower) -> Pair:
    """cos(π/12) = (√6 + √2)/4, sin(π/12) = (√6 − √2)/4."""
    field = tower.field
    two, six = power(tower, field.constant(2), HALF), power(tower, field.constant(6), HALF)
    quarter = Fraction(1, 4)
    return field.combine([(quarter, six), (quarter, two)]), field.combine([(quarter, six), (-quarter, two)])


def _cosine_polynomial(n: int) -> tuple[int, list[Fraction]]:
    """(d, a) with cos(π/n)**d = Σ a_k cos(π/n)**k: the factor of T_n + 1 that vanishes there and no other."""
    before, here = fmpz_poly([1]), fmpz_poly([0, 1])
    for _ in range(n - 1):
        before, here = here, fmpz_poly([0, 2]) * here - before
    _, factors = (here + 1).factor()
    with precision(256):
        point = (arb.pi() / n).cos()
        vanishing = [f for f, _ in factors if arb_poly(f)(point).contains(0)]
    if len(vanishing) != 1:
        raise Unsupported("the cosine of a fraction of pi could not be isolated")
    f = vanishing[0]
    degree = f.degree()
    lead = Fraction(int(f[degree]))
    return degree, [-Fraction(int(f[k])) / lead for k in range(degree)]
