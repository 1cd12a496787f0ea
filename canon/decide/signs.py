"""Signs of polynomials in the generators, from assumptions, from the region and from what is written.

On the region every radicand and every argument of a logarithm is positive, because the claim speaks of
nothing else; that is where most facts come from.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from canon.decide.fraction_field import Element
from canon.decide.ring import Polynomial
from canon.decide.sign_rules import sign_by_rules

if TYPE_CHECKING:
    from canon.decide.tower import Tower

OPPOSITE = {"pos": "neg", "neg": "pos", "nonneg": "nonpos", "nonpos": "nonneg"}
UP = ("pos", "nonneg")
DOWN = ("neg", "nonpos")


def sign_of(tower: Tower, p: Polynomial) -> str | None:
    """ "pos", "neg", "nonneg" or "nonpos" where known on the whole region, else None."""
    state = len(tower.facts)
    remembered = tower.signs.setdefault(len(p), [])
    for entry in remembered:
        if entry[0] == p:
            if entry[1] not in ("pos", "neg") and entry[2] != state:
                entry[1:] = _sign_anew(tower, p), state
            return entry[1]
    sign = _sign_anew(tower, p)
    remembered.append([p, sign, state])
    return sign


def _sign_anew(tower: Tower, p: Polynomial) -> str | None:
    sign = sign_at_sight(tower, p)
    if sign in ("pos", "neg") or any(g.sign == "cplx" for g in tower.used(p)):
        return sign
    return sign_by_rules(tower, p) or sign


def sign_at_sight(tower: Tower, p: Polynomial) -> str | None:
    """The sign of p where it is a known fact, or follows from its generators' signs term by term, else None."""
    for known, sign in tower.facts:
        if known == p:
            return sign
    total, strict = 0, False
    for monomial, coefficient in tower.ring.terms(p).items():
        term, certain = (1 if coefficient.numerator > 0 else -1), True
        for k, e in enumerate(monomial):
            if not e:
                continue
            sign = tower.generators[k].sign
            if sign == "pos":
                continue
            if sign == "neg":
                term = -term if e % 2 else term
                continue
            if e % 2 == 0 and _is_nonzero(tower, k):
                continue
            certain = False
            if sign == "nonneg" or (e % 2 == 0 and sign != "cplx"):
                continue
            if sign != "nonpos":
                return None
            term = -term
        if total and term != total:
            return None
        total = term
        strict = strict or certain
    if not total:
        return None
    return ("pos" if strict else "nonneg") if total > 0 else ("neg" if strict else "nonpos")


def _is_nonzero(tower: Tower, k: int) -> bool:
    """Whether a generator is a real symbol that is declared not to be 0."""
    made = tower.generators[k]
    if made.kind != "symbol" or made.sign == "cplx":
        return False
    symbol = tower.tape.symbol_at(made.data)
    return bool(symbol.is_real) and symbol.is_zero is False


def add_fact(tower: Tower, p: Polynomial, sign: str) -> None:
    """Remember the sign of p (and of −p); a bare generator keeps it as its own sign."""
    if any(known == p for known, _ in tower.facts):
        return
    tower.facts.append((p, sign))
    tower.facts.append((-p, OPPOSITE[sign]))
    for q, s in ((p, sign), (-p, OPPOSITE[sign])):
        made = tower.bare(q)
        if made is not None and made.sign in ("real", "nonneg", "nonpos"):
            made.sign = s


def split(tower: Tower, x: Element) -> tuple[Fraction, list[tuple[Polynomial, int]]]:
    """x as constant · Π factor ** exponent with factors irreducible over Q."""
    field = tower.field
    content, pieces = field.split_denominator(x[0])
    powers = dict(pieces)
    for k, e in x[1].items():
        powers[k] = powers.get(k, 0) - e
    return content, [(field.factors[k], e) for k, e in powers.items() if e]


Classified = tuple[int, Fraction, list[tuple[Polynomial, int]], list[tuple[Polynomial, int]]]


def classify(tower: Tower, x: Element) -> Classified:
    """(sign, |constant|, positive factors, factors of unknown sign) of a real element."""
    content, pieces = split(tower, x)
    sign, known, unknown = (1 if content > 0 else -1), [], []
    for f, e in pieces:
        s = sign_of(tower, f)
        if s in UP:
            known.append((f, e))
        elif s in DOWN:
            known.append((-f, e))
            sign = -sign if e % 2 else sign
        else:
            unknown.append((f, e))
    return sign, abs(content), known, unknown


def learn_positive(tower: Tower, elements: Sequence[Element]) -> None:
    """Draw what follows from these elements being positive: the sign of the factors of unknown sign, multiplied."""
    for _ in range(3):
        before = len(tower.facts)
        for x in elements:
            if not x[0] or tower.is_complex(x):
                continue
            left = _left_over(tower, x)
            if left is not None:
                add_fact(tower, left, "pos")
        if len(tower.facts) == before:
            return


def _left_over(tower: Tower, x: Element) -> Polynomial | None:
    """The product of the few factors of a positive x whose sign must be learned from it, made positive, else None.

    Signs at sight first: what is said to be positive need not be shown to be, which may be much more work.
    """
    content, pieces = split(tower, x)
    sign, unknown = (1 if content > 0 else -1), []
    for f, e in pieces:
        if e % 2:
            s = sign_at_sight(tower, f)
            if s is None:
                unknown.append(f)
            sign = -sign if s in DOWN else sign
    if len(unknown) > 1:
        sign, _, _, rest = classify(tower, x)
        unknown = [f for f, e in rest if e % 2]
    product = _product(unknown)
    return None if product is None else (product if sign > 0 else -product)


def sign_of_rest(tower: Tower, unknown: Sequence[tuple[Polynomial, int]]) -> str | None:
    """The sign of the product of factors of unknown sign: of even powers, and of factors whose product is known."""
    odd = [f for f, e in unknown if e % 2]
    known = "pos" if not odd else None
    if odd and (product := _product(odd)) is not None:
        known = sign_at_sight(tower, product)
    if known is None:
        return None
    strict = known in ("pos", "neg") and all(e % 2 or e < 0 or _vanishes_nowhere(tower, f) for f, e in unknown)
    return known if strict else ("nonneg" if known in UP else "nonpos")


def _vanishes_nowhere(tower: Tower, f: Polynomial) -> bool:
    made = tower.bare(f) or tower.bare(-f)
    return made is not None and _is_nonzero(tower, made.index)


def _product(factors: Sequence[Polynomial]) -> Polynomial | None:
    """The product of a few short factors, None of many or long ones."""
    if not 0 < len(factors) <= 3 or any(len(f) > 6 for f in factors):
        return factors[0] if len(factors) == 1 else None
    product = factors[0]
    for f in factors[1:]:
        product = product * f
    return product
