"""Signs that need more than the signs of generators: boxes, bounded trigonometric pairs, roots and exponentials."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from canon.decide.generator_values import constant_sign
from canon.decide.ring import Polynomial
from canon.decide.sign_intervals import affine_sign, interval_of, sign_by_real_roots, sign_on_orthant
from canon.decide.sign_sums import by_even_powers, by_known_forms

if TYPE_CHECKING:
    from canon.decide.tower import Generator, Tower

MOST_TERMS, MOST_QUADRATIC = 30, 6


def sign_by_rules(tower: Tower, p: Polynomial) -> str | None:
    """The sign of p on the region by the first rule that shows it, else None."""
    if len(p) > MOST_TERMS or any(g.sign == "cplx" for g in tower.used(p)):
        return None
    if len(p) == 1 and _says_nothing(tower, p):
        return None
    for rule in (
        constant_sign,
        affine_sign,
        _bounded_pair,
        _against_wave,
        _against_one,
        sign_on_orthant,
        sign_by_real_roots,
        _quadratic,
        _against_root,
        by_even_powers,
        by_known_forms,
    ):
        sign = rule(tower, p)
        if sign is not None:
            return sign
    return None


def _says_nothing(tower: Tower, p: Polynomial) -> bool:
    """True for a product of symbols that no interval bounds: their own signs are all there is."""
    return all(made.kind == "symbol" and made.data not in tower.intervals for made in tower.used(p))


def _bounded_pair(tower: Tower, p: Polynomial) -> str | None:
    """a + b·c with a real cosine or sine c: |c| ≤ 1, and |c| < 1 where its partner isn't 0."""
    constant, slope, made = Fraction(0), Fraction(0), None
    for monomial, coefficient in tower.ring.terms(p).items():
        if not any(monomial):
            constant = coefficient
        elif sum(monomial) == 1 and made is None:
            slope, made = coefficient, tower.generators[monomial.index(1)]
        else:
            return None
    if made is None or made.kind not in ("cos", "sin") or made.sign == "cplx" or abs(slope) > abs(constant):
        return None
    strict = abs(slope) < abs(constant) or _partner_has_a_sign(tower, made)
    return ("pos" if strict else "nonneg") if constant > 0 else ("neg" if strict else "nonpos")


def _against_wave(tower: Tower, p: Polynomial) -> str | None:
    """a + b·c with a real cosine or sine c, a and b free of it and of its partner: a's sign where b² < a²."""
    from canon.decide.signs import sign_of

    ring = tower.ring
    if len(p) > MOST_QUADRATIC:
        return None
    for k, degree in enumerate(ring.degrees(p)):
        made = tower.generators[k] if degree == 1 else None
        if made is None or made.kind not in ("cos", "sin") or made.sign == "cplx":
            continue
        parts = [ring.zero, ring.zero]
        for monomial, c in ring.terms(p).items():
            parts[monomial[k]] = parts[monomial[k]] + ring.polynomial({(*monomial[:k], 0, *monomial[k + 1 :]): c})
        side = sign_of(tower, parts[0]) if parts[0] else None
        if side not in ("pos", "neg"):
            continue
        difference = tower.field.normal(parts[0] * parts[0] - parts[1] * parts[1])
        if difference and len(difference) <= MOST_TERMS and sign_of_product(tower, difference) == "pos":
            return side
    return None


def _partner_has_a_sign(tower: Tower, made: Generator) -> bool:
    """Whether the sine of a cosine, or the cosine of a sine, is nowhere 0; a cosine of whole turns of pi has none."""
    k, kind = (made.index + 1, "sin") if made.kind == "cos" else (made.index - 1, "cos")
    if k >= len(tower.generators) or tower.generators[k].kind != kind or tower.generators[k].data is not made.data:
        return False
    return tower.generators[k].sign in ("pos", "neg")


def _against_one(tower: Tower, p: Polynomial) -> str | None:
    """exp(b) − 1 has the sign of b, and f**(1/n) − q that of f − q**n, for q > 0."""
    from canon.decide.signs import DOWN, UP, classify, sign_of

    terms = tower.ring.terms(p)
    if len(terms) != 2:
        return None
    constant = terms.pop((0,) * tower.ring.size, None)
    ((monomial, slope),) = list(terms.items())[:1]
    if constant is None or sum(monomial) != 1 or constant * slope > 0:
        return None
    made, level = tower.generators[monomial.index(1)], -constant / slope
    if made.kind == "exp" and made.sign == "pos" and level == 1 and made.data[0]:
        sign, _, known, unknown = classify(tower, made.data)
        strict = all(sign_of(tower, f) in ("pos", "neg") for f, _ in known)
        inner = None if unknown or not strict else ("pos" if sign > 0 else "neg")
    elif made.kind == "root" and made.data[0] == "chain":
        _, radicand, prime, height = made.data
        inner = sign_of(tower, radicand - tower.ring.constant(level ** (prime**height)))
    else:
        return None
    if inner is None:
        return None
    flip = {"pos": "neg", "neg": "pos", "nonneg": "nonpos", "nonpos": "nonneg"}
    assert inner in UP + DOWN
    return inner if slope > 0 else flip[inner]


def _quadratic(tower: Tower, p: Polynomial) -> str | None:
    """a·x² + b·x + c keeps the sign of a where b² ≤ 4ac (strictly where b² < 4ac)."""
    from canon.decide.signs import sign_of

    ring = tower.ring
    if len(p) > MOST_QUADRATIC:
        return None
    for k, degree in enumerate(ring.degrees(p)):
        if degree != 2 or tower.generators[k].sign == "cplx" or tower.generators[k].degree:
            continue
        parts = [ring.zero, ring.zero, ring.zero]
        for monomial, c in ring.terms(p).items():
            without = (*monomial[:k], 0, *monomial[k + 1 :])
            parts[monomial[k]] = parts[monomial[k]] + ring.polynomial({without: c})
        leading = sign_of(tower, parts[2])
        if leading not in ("pos", "neg"):
            continue
        if not parts[1] and parts[0]:
            rest = sign_of_product(tower, parts[0])
            if rest == leading:
                return leading
            if rest == ("nonneg" if leading == "pos" else "nonpos"):
                return rest
            continue
        discriminant = parts[1] * parts[1] - ring.constant(4) * parts[2] * parts[0]
        if len(discriminant) >= len(p) * len(p):
            continue
        bound = sign_of_product(tower, discriminant) if discriminant else "nonpos"
        if bound == "neg":
            return leading
        if bound == "nonpos":
            return "nonneg" if leading == "pos" else "nonpos"
    return None


def _against_root(tower: Tower, p: Polynomial) -> str | None:
    """a + b·g with a positive square root g: b's sign where a² ≤ b²g², a's where a² ≥ b²g²."""
    from canon.decide.signs import sign_of

    ring = tower.ring
    if len(p) > MOST_QUADRATIC:
        return None
    for k, degree in enumerate(ring.degrees(p)):
        made = tower.generators[k] if degree else None
        if made is None or degree != 1 or made.degree != 2 or made.kind != "root" or made.sign != "pos":
            continue
        a, b = ring.zero, ring.zero
        for monomial, c in ring.terms(p).items():
            if monomial[k]:
                b = b + ring.polynomial({(*monomial[:k], 0, *monomial[k + 1 :]): c})
            else:
                a = a + ring.polynomial({monomial: c})
        if not a or _undecidable(tower, (a, sign_of(tower, a)), (b, sign_of(tower, b)), made.lower):
            continue
        difference = tower.field.normal(a * a - b * b * made.lower)
        if not difference or len(difference) > MOST_TERMS:
            continue
        larger = sign_of_product(tower, difference)
        side = None if larger is None else sign_of(tower, b if larger in ("neg", "nonpos") else a)
        if side is not None:
            strict = larger in ("pos", "neg") and side in ("pos", "neg")
            positive = side in ("pos", "nonneg")
            return ("pos" if strict else "nonneg") if positive else ("neg" if strict else "nonpos")
    return None


def _undecidable(
    tower: Tower, a: tuple[Polynomial, str | None], b: tuple[Polynomial, str | None], lower: Polynomial
) -> bool:
    """True where a + b·g takes both signs: the part whose sign would have to win is bounded, the other isn't."""
    if a[1] is None and b[1] is None:
        return True
    opposite = a[1] is not None and b[1] is not None and a[1][:3] != b[1][:3]
    if b[1] is None or (opposite and _grows(tower, a[0], (b[0], lower))):
        return _grows(tower, b[0], (a[0],))
    return a[1] is None and _grows(tower, a[0], (b[0], lower))


def _grows(tower: Tower, f: Polynomial, others: tuple[Polynomial, ...]) -> bool:
    """True when f contains an unbounded symbol that the others don't."""
    elsewhere = {made.index for p in others for made in tower.used(p)}
    for made in tower.used(f):
        if made.kind == "symbol" and made.index not in elsewhere:
            interval = interval_of(tower, made)
            if interval is None or interval.low is None or interval.high is None:
                return True
    return False


def sign_of_product(tower: Tower, p: Polynomial) -> str | None:
    """The sign of a polynomial from those of its factors; even powers of others aren't negative."""
    from canon.decide.signs import OPPOSITE, classify, sign_of, sign_of_rest

    sign, _, known, unknown = classify(tower, (p, {}))
    rest = sign_of_rest(tower, unknown)
    if rest is None:
        return None
    strict = rest in ("pos", "neg") and all(sign_of(tower, f) in ("pos", "neg") for f, _ in known)
    total = ("pos" if strict else "nonneg") if (sign > 0) == (rest in ("pos", "nonneg")) else None
    return total or OPPOSITE["pos" if strict else "nonneg"]
