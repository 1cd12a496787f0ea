"""Signs of sums: of even powers with coefficients of one sign, and of linear forms that known ones add up to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from canon.decide.ring import Monomial, Polynomial

if TYPE_CHECKING:
    from canon.decide.tower import Tower

MOST_SQUARES, MOST_LINEAR, MOST_FACTS, DEEPEST = 12, 6, 8, 3


def by_even_powers(tower: Tower, p: Polynomial) -> str | None:
    """Σ c_k · m_k² with real m_k of unknown sign: the sign that all c_k have; strict if that of 1 is among them."""
    from canon.decide.sign_rules import sign_of_product

    free = {made.index for made in tower.used(p) if made.sign == "real"}
    if not free:
        return None
    groups: dict[Monomial, dict[Monomial, object]] = {}
    for monomial, coefficient in tower.ring.terms(p).items():
        square = tuple(e if k in free else 0 for k, e in enumerate(monomial))
        if any(e % 2 for e in square):
            return None
        rest = tuple(0 if k in free else e for k, e in enumerate(monomial))
        groups.setdefault(square, {})[rest] = coefficient
    if not 1 < len(groups) <= MOST_SQUARES:
        return None
    signs = {square: sign_of_product(tower, tower.ring.polynomial(terms)) for square, terms in groups.items()}  # type: ignore[arg-type]
    for up, strict in (("pos", "nonneg"), ("neg", "nonpos")):
        if all(sign in (up, strict) for sign in signs.values()):
            constant = signs.get((0,) * tower.ring.size)
            return up if constant == up else strict
    return None


def by_known_forms(tower: Tower, p: Polynomial) -> str | None:
    """A form that is a sum of multiples of some known to be positive, and of positive terms: 2c − a·b from c > a·b."""
    if len(p) > MOST_LINEAR:
        return None
    facts = [f for f, sign in tower.facts if sign == "pos" and 1 < len(f) <= MOST_LINEAR and _share(tower, f, p)]
    if not facts or len(facts) > 2 * MOST_FACTS:
        return None
    for sign, form in (("pos", p), ("neg", -p)):
        if _adds_up(tower, form, facts, DEEPEST):
            return sign
    return None


def _share(tower: Tower, fact: Polynomial, p: Polynomial) -> bool:
    """Whether some term of p, not its constant, occurs in the fact too."""
    return any(any(monomial) for monomial in tower.ring.terms(fact).keys() & tower.ring.terms(p).keys())


def _adds_up(tower: Tower, form: Polynomial, facts: list[Polynomial], depth: int) -> bool:
    """Whether the form, less positive multiples of some of the facts, is a sum of what isn't negative."""
    from canon.decide.signs import sign_at_sight

    terms = tower.ring.terms(form)
    for fact in facts:
        shared = [(c, terms[m]) for m, c in tower.ring.terms(fact).items() if m in terms]
        for factor in dict.fromkeys(own / c for c, own in shared if own / c > 0):
            rest = form - tower.ring.scaled(fact, factor)
            if not rest or sign_at_sight(tower, rest) in ("pos", "nonneg"):
                return True
            if depth > 1 and len(rest) < len(form) + 1 and _adds_up(tower, rest, facts, depth - 1):
                return True
    return False
