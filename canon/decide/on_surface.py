"""Vanishing on a constraint surface: the numerator lies in the ideal of the surface's equations.

The equations' numerators, without repeated factors and those that have no zero on the region, generate an
ideal together with the relations of the kernels; membership in it or in its radical (by Gröbner bases) makes
the residual 0 at every point of the surface. Not lying there says nothing.
"""

from __future__ import annotations

import sympy as sp

from canon.budget import Budget
from canon.deadline import within
from canon.decide.certificate import Certificate, describe
from canon.decide.components import without_powers
from canon.decide.fraction_field import Element, FractionField
from canon.decide.intervals import with_zeros
from canon.decide.jacobi_kernels import JACOBI
from canon.decide.normal_form import reduce_to_zero
from canon.decide.region import Region
from canon.decide.ring import Polynomial, Ring
from canon.decide.signs import classify, sign_of, split
from canon.decide.tape import Node, Tape
from canon.decide.tower import Generator, Tower, combine

MOST_TERMS, MOST_TERMS_OF_RADICAL = 600, 60
SPECIAL = ("elliptic_k", "elliptic_e", "elliptic_f", "elliptic_ei", "elliptic_pi", "elliptic_pii", "lambertw",
           "gamma", "integer_power", *JACOBI)  # fmt: skip


def vanishes_on_surface(tape: Tape, node: Node, region: Region, budget: Budget) -> Certificate | None:
    """A certificate that the node is 0 on region ∩ surface, or None."""
    positive = [r.nodes[0] for r in region.requirements if r.kind == "positive" and not tape.is_complex(r.nodes[0])]
    surface = without_powers(tape, region.surface)
    symbols = set().union(*(tape.support(n) for n in [node, *surface]))
    box = with_zeros(tape, region, symbols)
    tower = Tower(tape, [node, *surface], positive=positive, intervals=box, budget=budget)
    zero, nonzero, field = reduce_to_zero(tower, [node], budget)
    if node in zero:
        return _certificate(tower, region, [])
    if node not in nonzero:
        return None
    equations = [_essential(tower, equation, region) for equation in surface]
    ring = tower.ring
    numerator = ring.polynomial(
        {m + (0,) * (ring.size - len(m)): c for m, c in field.ring.terms(nonzero[node][0]).items()}
    )
    if len(equations) == 1 and not tower.field.relations:
        inside = ring.quotient(numerator, equations[0]) is not None
    else:
        inside = (
            _in_ideal(tower, numerator, equations, budget)
            or _by_conjugate(tower, numerator, equations, budget)
            or _in_radical(tower, numerator, equations, budget)
        )
    if not inside or not _defined(tower, node, nonzero[node], field, equations, budget):
        return None
    return _certificate(tower, region, equations)


def _defined(
    tower: Tower, node: Node, value: Element, field: FractionField, equations: list[Polynomial], budget: Budget
) -> bool:
    """True when no denominator vanishes on the surface, and no gamma function is infinite there.

    What a formula divides by, and what its derivatives do, isn't 0 in the region, but for the removable singularities
    that the derivatives of special functions have, as of K(m) at m = 0. Their own values are finite, but what the tower
    puts in their place need not be: Γ(x + 2) is (x + 1) Γ(x + 1), which is 0·∞ at x = −1.
    """
    tape, ring = tower.tape, tower.ring
    if not any(tape.ops[i][0] == "f" and tape.ops[i][1] in SPECIAL for i in tape.reach([node])):
        return True
    if not all(_is_finite(tower, g, node) for g in tower.generators if g.kind == "gamma"):
        return False
    for k in value[1]:
        f = ring.polynomial({m + (0,) * (ring.size - len(m)): c for m, c in field.ring.terms(field.factors[k]).items()})
        if sign_of(tower, f) not in ("pos", "neg") and not _in_ideal(tower, ring.one, [f, *equations], budget):
            return False
    return True


def _is_finite(tower: Tower, made: Generator, node: Node) -> bool:
    """Whether a gamma function is one of those that are written, or its argument is positive."""
    (y,), tape = made.data, tower.tape
    written = [op[2][0] for i in tape.reach([node]) if (op := tape.ops[i])[:2] == ("f", "gamma")]
    if any(tower.field.equal(y, tower.values[argument]) for argument in written):
        return True
    sign, _, known, unknown = classify(tower, y)
    return sign > 0 and not unknown and all(sign_of(tower, f) in ("pos", "neg") for f, _ in known)


def _essential(tower: Tower, equation: Node, region: Region) -> Polynomial:
    """The numerator of a surface equation, without the factors that are nonzero on the region."""
    values = dict(tower.values)
    for i in tower.tape.reach([equation]):
        if i not in values:
            values[i] = combine(tower.field, tower.tape.ops[i], values)
    nonzero = _nonzero_polynomials(tower, region)
    _, pieces = split(tower, (tower.field.normal(values[equation][0]), {}))
    p = tower.ring.one
    for f, _ in pieces:
        if sign_of(tower, f) in ("pos", "neg") or any(f == g for g in nonzero):
            continue
        p = p * f
    return p


def _nonzero_polynomials(tower: Tower, region: Region) -> list[Polynomial]:
    out = []
    for requirement in region.requirements:
        node = requirement.nodes[0]
        if requirement.kind in ("nonzero", "positive") and node in tower.values:
            out += [f for f, _ in split(tower, tower.values[node])[1]]
    return out


def _in_ideal(tower: Tower, numerator: Polynomial, equations: list[Polynomial], budget: Budget) -> bool:
    relations = [relation for *_, relation in tower.field.relations]
    polynomials = [numerator, *equations, *relations]
    if sum(len(p) for p in polynomials) > MOST_TERMS:
        return False
    used = sorted({k for p in polynomials for k, e in enumerate(tower.ring.degrees(p)) if e > 0})
    names = sp.symbols([f"g{k}" for k in used])
    given = [_sympy(tower.ring, p, used, names) for p in [*equations, *relations]]

    def is_in() -> bool:
        basis = sp.groebner(given, *names, order="grevlex", domain=sp.QQ)
        return basis.reduce(_sympy(tower.ring, numerator, used, names))[1] == 0

    return within(budget, is_in)


def _by_conjugate(tower: Tower, numerator: Polynomial, equations: list[Polynomial], budget: Budget) -> bool:
    """a + b·g times a − b·g lies in the ideal, for a square root g, and a − b·g has a sign on the region."""
    ring, field = tower.ring, tower.field
    for generator, degree, lower, _ in reversed(field.relations):
        if degree != 2 or ring.degrees(numerator)[generator] != 1 or ring.degrees(lower)[generator] > 0:
            continue
        terms = ring.terms(numerator)
        conjugate = ring.polynomial({m: -c if m[generator] else c for m, c in terms.items()})
        if sign_of(tower, conjugate) in ("pos", "neg"):
            product = field.normal(ring.times(numerator, conjugate))
            if not product or _in_ideal(tower, product, equations, budget):
                return True
    return False


def _in_radical(tower: Tower, numerator: Polynomial, equations: list[Polynomial], budget: Budget) -> bool:
    """A power of the numerator lies in the ideal (Rabinowitsch: 1 does, with 1 − t·numerator for a new t)."""
    relations = [relation for *_, relation in tower.field.relations]
    polynomials = [numerator, *equations, *relations]
    if sum(len(p) for p in polynomials) > MOST_TERMS_OF_RADICAL or len(equations) + len(relations) < 2:
        return False
    used = sorted({k for p in polynomials for k, e in enumerate(tower.ring.degrees(p)) if e > 0})
    names = sp.symbols([f"g{k}" for k in used])
    inverse = sp.Symbol("t")
    given = [_sympy(tower.ring, p, used, names) for p in [*equations, *relations]]
    given.append(1 - inverse * _sympy(tower.ring, numerator, used, names))
    return within(budget, lambda: sp.groebner(given, inverse, *names, order="grevlex", domain=sp.QQ).exprs == [1])


def _sympy(ring: Ring, p: Polynomial, used: list[int], names: list[sp.Symbol]) -> sp.Expr:
    terms = []
    for monomial, c in ring.terms(p).items():
        factors = [name ** monomial[k] for k, name in zip(used, names, strict=True) if monomial[k]]
        terms.append(sp.Rational(c.numerator, c.denominator) * sp.Mul(*factors))
    return sp.Add(*terms)


def _certificate(tower: Tower, region: Region, equations: list[Polynomial]) -> Certificate:
    return Certificate(
        lambda: {
            "argument": "the numerator lies in the ideal of the surface and of the kernels' relations",
            "surface": [str(p) for p in equations],
            "domain": [requirement.text for requirement in region.requirements],
            "kernels": [describe(tower, g) for g in tower.generators],
        }
    )
