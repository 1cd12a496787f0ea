"""Exponentials and logarithms as generators of the tower."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from sympy import factorint

from canon.decide.factors import prime_factors
from canon.decide.fraction_field import Element
from canon.decide.linear import divided_basis
from canon.decide.radicals import absolute, factor_power, power, root_generator
from canon.decide.ring import Polynomial
from canon.decide.signs import add_fact, classify
from canon.decide.tape import ONE, Unsupported

if TYPE_CHECKING:
    from canon.decide.tower import Generator, Tower

STEEPEST = 400


def logarithm(tower: Tower, x: Element) -> Element:
    """log x: split into the logarithms of positive factors, for x positive on the region (or complex, whole)."""
    field = tower.field
    if tower.is_complex(x):
        return tower.element(_whole_logarithm(tower, x, "cplx"))
    sign, constant, known, unknown = classify(tower, x)
    terms = [(Fraction(e), log_of_factor(tower, f)) for f, e in known]
    terms += [(Fraction(e), log_of_factor(tower, tower.ring.constant(p))) for p, e in prime_factors(constant)]
    if unknown:
        terms += _log_of_unknown(tower, sign, unknown)
    elif sign < 0:
        raise Unsupported("the logarithm of something negative")
    return field.combine(terms)


def _log_of_unknown(tower: Tower, sign: int, unknown: list[tuple[Polynomial, int]]) -> list[tuple[Fraction, Element]]:
    field = tower.field
    common = math.gcd(*(e for _, e in unknown))
    if common % 2 == 0:
        if sign < 0:
            raise Unsupported("the logarithm of minus a square")
        # of each factor by itself: |f|² in a product would be f² by its relation, without a sign
        return [(Fraction(e), log_of_factor(tower, absolute(tower, (f, {}))[0])) for f, e in unknown]
    if len(unknown) == 1:
        f, e = unknown[0]
        f = f if sign > 0 else -f
        add_fact(tower, f, "pos")
        return [(Fraction(e), log_of_factor(tower, f))]
    whole = field.product([field.constant(sign)] + [field.power((f, {}), e // common) for f, e in unknown])
    return [(Fraction(common), tower.element(_whole_logarithm(tower, whole, "real")))]


def log_of_factor(tower: Tower, f: Polynomial) -> Element:
    """log f for a positive polynomial (or prime): roots and exponentials give their argument back."""
    made = tower.bare(f)
    if made is not None and made.kind == "root" and made.data[0] == "chain":
        _, radicand, prime, height = made.data
        return tower.field.combine([(Fraction(1, prime**height), log_of_factor(tower, radicand))])
    if made is not None and made.kind == "exp" and made.sign == "pos":
        return made.data
    for known, generator in tower.memory.setdefault("logs", []):
        if known == f:
            return tower.element(generator)
    generator = tower.generator("log", "real", ("factor", f), constant=tower.is_constant((f, {})))
    tower.memory["logs"].append((f, generator))
    return tower.element(generator)


def _whole_logarithm(tower: Tower, x: Element, sign: str) -> Generator:
    """The logarithm of N/D as one generator: no branch assumed, nothing split."""
    ring, field = tower.ring, tower.field
    under = ring.one
    for k, e in x[1].items():
        under = field.normal(ring.times(under, field.factor_power(k, e)))
    for numerator, denominator, made in tower.memory.setdefault("whole logs", []):
        if numerator == x[0] and denominator == under:
            return made
    made = tower.generator("log", sign, ("whole", x[0], under), constant=tower.is_constant(x))
    tower.memory["whole logs"].append((x[0], under, made))
    return made


def exponential(tower: Tower, arguments: Sequence[Element]) -> list[Element]:
    """exp of each argument: logarithms come back as powers, I·b as cos b + I sin b, the rest over a Q-basis."""
    from canon.decide.angles import cosines_and_sines, take_out

    field = tower.field
    results = [field.constant(1) for _ in arguments]
    rest: list[Element] = []
    turned: list[tuple[int, Element]] = []
    for n, x in enumerate(arguments):
        real, imaginary = _by_imaginary_unit(tower, x)
        if imaginary is not None:
            turned.append((n, imaginary))
        taken, left = take_out(tower, real, ("log", "lambertw"))
        for k, q in taken.items():
            results[n] = field.product([results[n], _power_of_log(tower, tower.generators[k], q)])
        rest.append(left)
    if turned:
        unit = tower.element(tower.imaginary())
        for (n, _), (c, s) in zip(turned, cosines_and_sines(tower, [b for _, b in turned]), strict=True):
            results[n] = field.product([results[n], field.combine([(ONE, c), (ONE, field.product([unit, s]))])])
    where = [n for n, x in enumerate(rest) if x[0]]
    if where:
        for n, value in zip(where, _over_a_basis(tower, [rest[n] for n in where]), strict=True):
            results[n] = field.product([results[n], value])
    return results


def _over_a_basis(tower: Tower, new: list[Element]) -> list[Element]:
    field = tower.field
    table: list[tuple[Element, Generator]] = tower.memory.setdefault("exponentials", [])
    old = [b for b, _ in table]
    combinations, parts = divided_basis(tower, old, new, STEEPEST)
    made: dict[int, Generator] = {}
    for k in parts:
        b = field.combine([(Fraction(1, parts[k]), [*old, *new][k])])
        sign = "cplx" if tower.is_complex(b) else "pos"
        made[k] = tower.generator("exp", sign, b, constant=tower.is_constant(b))
        table.append((b, made[k]))
    out = []
    for combination in combinations:
        value = field.constant(1)
        for k, q in combination.items():
            if k in parts:
                factor = field.power(tower.element(made[k]), int(q * parts[k]))
            else:
                factor = _power_of_exponential(tower, table[k][1], q)
            value = field.product([value, factor])
        out.append(value)
    return out


def _power_of_exponential(tower: Tower, made: Generator, q: Fraction) -> Element:
    """exp(b) ** q for an exponential that is there already, through roots of it where q isn't an integer."""
    field = tower.field
    if q.denominator == 1:
        return field.power(tower.element(made), int(q))
    if made.sign != "pos":
        raise Unsupported("a root of a complex exponential")
    f, parts, rest = tower.ring.generators[made.index], [field.constant(1)], q
    for prime, height in factorint(q.denominator).items():
        order = prime**height
        share = q.numerator * pow(q.denominator // order, -1, order) % order
        rest -= Fraction(share, order)
        parts.append(field.power(tower.element(root_generator(tower, f, prime, height)), share))
    parts.append(field.power((f, {}), int(rest)))
    return field.product(parts)


def _power_of_log(tower: Tower, made: Generator, q: Fraction) -> Element:
    """exp(q · log x) = x ** q, and exp(q · W(x)) = (x / W(x)) ** q for Lambert's W and integers q."""
    if made.kind == "lambertw":
        if q.denominator != 1:
            raise Unsupported("a fraction of Lambert's function in an exponent")
        ratio = tower.field.product([made.data[0], tower.field.inverse(tower.element(made))])
        return tower.field.power(ratio, q.numerator)
    if made.data[0] == "factor":
        return factor_power(tower, made.data[1], q)
    x = tower.field.product([(made.data[1], {}), tower.field.inverse((made.data[2], {}))])
    return power(tower, x, q)


def _by_imaginary_unit(tower: Tower, x: Element) -> tuple[Element, Element | None]:
    """(a, b) with x = a + I·b, by the numerator's terms in I; b is None where I doesn't occur in it."""
    ring = tower.ring
    unit = next((g.index for g in tower.generators if g.kind == "I"), None)
    if unit is None or not x[0] or ring.degrees(x[0])[unit] <= 0:
        return x, None
    terms = ring.terms(x[0])
    real = {m: c for m, c in terms.items() if not m[unit]}
    imaginary = {(*m[:unit], 0, *m[unit + 1 :]): c for m, c in terms.items() if m[unit]}
    a = (ring.polynomial(real), dict(x[1])) if real else (ring.zero, {})
    return a, (ring.polynomial(imaginary), dict(x[1]))
