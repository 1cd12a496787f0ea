"""Powers with rational exponents, absolute values and fields of p-th roots as generators of the tower."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

from sympy import factorint

from canon.decide.factors import prime_factors
from canon.decide.fraction_field import Element
from canon.decide.ring import Polynomial, TooCostly
from canon.decide.signs import DOWN, UP, add_fact, classify, sign_of, split
from canon.decide.squares import hidden_square
from canon.decide.tape import Unsupported

if TYPE_CHECKING:
    from canon.decide.tower import Generator, Tower


def power(tower: Tower, x: Element, exponent: Fraction) -> Element:
    """x ** exponent, principal value, for x that is positive on the region (or complex, off its cut)."""
    field = tower.field
    if exponent.denominator == 1:
        return field.power(x, exponent.numerator)
    if tower.is_complex(x):
        return _complex_power(tower, x, exponent)
    square = hidden_square(tower, x) if exponent.denominator == 2 else None
    if square is not None:
        content, base = square
        root = field.product([power(tower, field.constant(content), Fraction(1, 2)), absolute(tower, base)])
        return field.power(root, exponent.numerator)
    sign, constant, known, unknown = classify(tower, x)
    parts = [field.constant(1)]
    parts += [factor_power(tower, f, exponent * e) for f, e in known]
    parts += [factor_power(tower, tower.ring.constant(p), exponent * e) for p, e in prime_factors(constant)]
    if unknown:
        parts.append(group_power(tower, sign, unknown, exponent))
    elif sign < 0:
        raise Unsupported("a root of something negative")
    return field.product(parts)


def factor_power(tower: Tower, f: Polynomial, exponent: Fraction) -> Element:
    """f ** exponent for a polynomial (or prime) that is positive on the region."""
    field = tower.field
    if exponent.denominator == 1:
        return field.power((f, {}), exponent.numerator)
    made = tower.bare(f)
    if made is not None and made.kind == "root" and made.data[0] == "chain":
        _, radicand, prime, height = made.data
        return factor_power(tower, radicand, exponent / prime**height)
    if made is not None and made.kind == "exp":
        from canon.decide.exponentials import exponential

        return exponential(tower, [field.product([field.constant(exponent), made.data])])[0]
    parts, rest = [field.constant(1)], exponent
    for prime, height in factorint(exponent.denominator).items():
        order = prime**height
        share = exponent.numerator * pow(exponent.denominator // order, -1, order) % order
        rest -= Fraction(share, order)
        base = _alias(tower, f, prime) if height == 1 else None
        if base is None:
            base = tower.element(root_generator(tower, f, prime, height))
        parts.append(field.power(base, share))
    parts.append(field.power((f, {}), int(rest)))
    return field.product(parts)


def root_generator(tower: Tower, f: Polynomial, prime: int, height: int) -> Generator:
    """The generator f ** (1 / prime**height), on top of the roots below it."""
    for entry in tower.memory.setdefault("roots", []):
        if entry[1:3] == (prime, height) and entry[0] == f:
            return entry[3]
    if height == 1:
        lower = f
    else:
        lower = tower.ring.generators[root_generator(tower, f, prime, height - 1).index]
    constant = tower.is_constant((f, {}))
    made = tower.generator("root", "pos", ("chain", f, prime, height), relation=(prime, lower), constant=constant)
    tower.memory["roots"].append((f, prime, height, made))
    if not f.is_constant() and tower.ring.leading(f) == 1:
        tower.field.take_root(f, made.index, prime**height)
    return made


def _alias(tower: Tower, f: Polynomial, prime: int) -> Element | None:
    """f ** (1/p) as s / g ** (1/p) where f·g = s**p by the relations for a root of g that is there already.

    For p = 2 it is |s|; for odd p, s is positive as f and g are.
    """
    if f.is_constant():
        return None
    ring, field = tower.ring, tower.field
    roots = [e for e in tower.memory.get("roots", []) if e[1:3] == (prime, 1) and not e[0].is_constant()]
    if any(entry[0] == f for entry in roots):
        return None
    for known, order, element in tower.memory.setdefault("aliases", []):
        if order == prime and known == f:
            return element
    for radicand, _, _, made in roots:
        try:
            product = field.normal(ring.times(f, radicand))
        except TooCostly:
            continue
        if not product or len(product) > 200:
            continue
        side = _exact_root(tower, product, prime)
        if side is None:
            continue
        element = field.product([side, field.inverse(tower.element(made))])
        tower.memory["aliases"].append((f, prime, element))
        return element
    return None


def _exact_root(tower: Tower, p: Polynomial, prime: int) -> Element | None:
    """The positive p-th root of a positive polynomial that is a p-th power over Q, else None."""
    ring = tower.ring
    if prime == 2:
        side = ring.square_root(p)
        return None if side is None else absolute(tower, (side, {}))
    if any(degree % prime for degree in ring.degrees(p)):
        return None
    content, pieces = ring.factor(p)
    if any(e % prime for _, e in pieces):
        return None
    parts = [factor_power(tower, ring.constant(q), Fraction(e, prime)) for q, e in prime_factors(abs(content))]
    sign = tower.field.constant(1 if content > 0 else -1)
    return tower.field.product([sign, *parts, *(((f, {})) for f, e in pieces for _ in range(e // prime))])


def group_power(tower: Tower, sign: int, factors: list[tuple[Polynomial, int]], exponent: Fraction) -> Element:
    """(sign · Π f ** e) ** exponent where only the product as a whole is known to be positive."""
    ring, field = tower.ring, tower.field
    common = math.gcd(*(e for _, e in factors))
    if common > 1:
        if common % 2 == 0 and sign < 0:
            raise Unsupported("a root of minus a square")
        if common % 2 == 0:  # of each factor by itself: |f|² in a product would be f² by its relation, without a sign
            return field.product([factor_power(tower, absolute(tower, (f, {}))[0], exponent * e) for f, e in factors])
        factors = [(f, e // common) for f, e in factors]
        exponent = exponent * common
    numerator, denominator = ring.constant(sign), ring.one
    for f, e in factors:
        if e > 0:
            numerator = field.normal(ring.times(numerator, ring.power(f, e)))
        else:
            denominator = field.normal(ring.times(denominator, ring.power(f, -e)))
    if denominator.is_constant():
        if len(factors) == 1 and factors[0][1] == 1:
            add_fact(tower, numerator, "pos")
        return factor_power(tower, numerator, exponent)
    if numerator.is_constant():
        return factor_power(tower, denominator * numerator, -exponent)
    return _whole_power(tower, numerator, denominator, exponent, "real")


def _complex_power(tower: Tower, x: Element, exponent: Fraction) -> Element:
    """The principal root of a complex element as one generator: nothing is split, no branch assumed."""
    ring, field = tower.ring, tower.field
    denominator = ring.one
    for k, e in x[1].items():
        denominator = field.normal(ring.times(denominator, field.factor_power(k, e)))
    return _whole_power(tower, x[0], denominator, exponent, "cplx")


def _whole_power(
    tower: Tower, numerator: Polynomial, denominator: Polynomial, exponent: Fraction, sign: str
) -> Element:
    """(N/D) ** (a/m) by g = D·(N/D)**(1/m), for which g**m = N·D**(m−1)."""
    ring, field = tower.ring, tower.field
    if exponent.denominator == 1:
        return field.power(field.product([(numerator, {}), field.inverse((denominator, {}))]), exponent.numerator)
    m = exponent.denominator
    roots = tower.memory.setdefault("whole roots", [])
    same = (g for known, under, degree, g in roots if degree == m and known == numerator and under == denominator)
    made = next(same, None)
    if made is None:
        below = field.power((denominator, {}), m - 1)[0]  # reduced as it grows: m may be 10⁸
        lower = field.normal(ring.times(numerator, below))
        made = tower.generator("root", sign, ("whole", numerator, denominator, m), relation=(m, lower))
        roots.append((numerator, denominator, m, made))
    root = tower.element(made)
    if denominator != ring.one:  # it may be another number: a power of 2**(1/3)
        root = field.product([root, field.inverse((denominator, {}))])
    return field.power(root, exponent.numerator)


def absolute(tower: Tower, x: Element) -> Element:
    """|x| factor by factor: a generator A with A² = f² where the sign of f is unknown, with A > 0 for complex f."""
    field = tower.field
    constant, pieces = split(tower, x)
    parts = [field.constant(abs(constant))]
    for f, e in pieces:
        made = tower.bare(f)
        if made is not None and made.kind == "I":
            continue
        sign = sign_of(tower, f)
        if sign in UP:
            parts.append(field.power((f, {}), e))
        elif sign in DOWN:
            parts.append(field.power((-f, {}), e))
        else:
            parts.append(field.power(tower.element(_absolute_generator(tower, f)), e))
    return field.product(parts)


def _absolute_generator(tower: Tower, f: Polynomial) -> Generator:
    for known, made in tower.memory.setdefault("absolutes", []):
        if known == f:
            return made
    if tower.is_complex((f, {})):
        made = tower.generator("abs", "pos", f, constant=tower.is_constant((f, {})))
    else:
        square = tower.field.normal(tower.ring.times(f, f))
        made = tower.generator("abs", "nonneg", f, relation=(2, square), constant=tower.is_constant((f, {})))
    tower.memory["absolutes"].append((f, made))
    return made


def tidy(tower: Tower, x: Element, limit: int = 300) -> Element:
    """Cancel denominator factors that divide the numerator modulo the relations, so that equal arguments look equal.

    With C the product of the conjugates of a factor f and N = f·C, n·C = r·N gives n = r·f wherever C isn't 0.
    N must be a nonzero polynomial in symbols that vary continuously: then C is nonzero on a dense part of the region.
    """
    numerator, denominator = x
    ring, field = tower.ring, tower.field
    if not denominator or not numerator or len(numerator) > limit:
        return x
    out: dict[int, int] = {}
    for k, e in denominator.items():
        conjugate = _conjugate_product(tower, field.factors[k], limit)
        while conjugate is not None and e:
            product, norm = conjugate
            quotient = ring.quotient(field.normal(ring.times(numerator, product)), norm)
            if quotient is None:
                break
            numerator, e = quotient, e - 1
        if e:
            out[k] = e
    return numerator, out


def _conjugate_product(tower: Tower, f: Polynomial, limit: int) -> tuple[Polynomial, Polynomial] | None:
    """(C, N = f·C) with N in symbols alone, by conjugation in quadratic generators; None where that fails."""
    ring, field = tower.ring, tower.field
    product, norm = ring.one, f
    for generator, degree, lower, _ in reversed(field.relations):
        if ring.degrees(norm)[generator] <= 0:
            continue
        if degree != 2 or ring.degrees(lower)[generator] > 0:
            return None
        conjugate = ring.polynomial({m: -c if m[generator] % 2 else c for m, c in ring.terms(norm).items()})
        product = field.normal(ring.times(product, conjugate))
        norm = field.normal(ring.times(norm, conjugate))
        if not norm or len(product) > limit or len(norm) > limit:
            return None
    if any(g.kind != "symbol" or tower.tape.symbol_at(g.data).is_integer for g in tower.used(norm)):
        return None
    return product, norm
