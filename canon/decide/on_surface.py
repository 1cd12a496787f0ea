"""Vanishing on a constraint surface: the numerator lies in the ideal of the surface's equations.

The equations' numerators, without factors that have no zero on the region, generate an ideal together
with the relations of the kernels; membership (by Gröbner bases) makes the residual 0 at every point of
the surface. Not lying in the ideal says nothing.
"""

from __future__ import annotations

import sympy as sp

from canon.budget import Budget
from canon.decide.certificate import Certificate, describe
from canon.decide.intervals import intervals_of
from canon.decide.normal_form import reduce_to_zero
from canon.decide.region import Region
from canon.decide.ring import Polynomial, Ring
from canon.decide.signs import sign_of, split
from canon.decide.tape import Node, Tape
from canon.decide.tower import Tower, combine

MOST_TERMS = 600


def vanishes_on_surface(tape: Tape, node: Node, region: Region, budget: Budget) -> Certificate | None:
    """A certificate that the node is 0 on region ∩ surface, or None."""
    positive = [r.nodes[0] for r in region.requirements if r.kind == "positive" and not tape.is_complex(r.nodes[0])]
    tower = Tower(tape, [node, *region.surface], positive=positive, intervals=intervals_of(tape, region), budget=budget)
    zero, nonzero, field = reduce_to_zero(tower, [node], budget)
    if node in zero:
        return _certificate(tower, region, [])
    if node not in nonzero:
        return None
    equations = [_essential(tower, equation, region) for equation in region.surface]
    ring = tower.ring
    numerator = ring.polynomial(
        {m + (0,) * (ring.size - len(m)): c for m, c in field.ring.terms(nonzero[node][0]).items()}
    )
    if len(equations) == 1 and not tower.field.relations:
        inside = ring.quotient(numerator, equations[0]) is not None
    else:
        inside = _in_ideal(tower, numerator, equations, budget)
    return _certificate(tower, region, equations) if inside else None


def _essential(tower: Tower, equation: Node, region: Region) -> Polynomial:
    """The numerator of a surface equation, without the factors that are nonzero on the region."""
    values = dict(tower.values)
    for i in tower.tape.reach([equation]):
        if i not in values:
            values[i] = combine(tower.field, tower.tape.ops[i], values)
    nonzero = _nonzero_polynomials(tower, region)
    _, pieces = split(tower, (tower.field.normal(values[equation][0]), {}))
    p = tower.ring.one
    for f, e in pieces:
        if sign_of(tower, f) in ("pos", "neg") or any(f == g for g in nonzero):
            continue
        p = p * f**e
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
    budget.check()
    basis = sp.groebner(
        [_sympy(tower.ring, p, used, names) for p in [*equations, *relations]], *names, order="grevlex", domain=sp.QQ
    )
    budget.check()
    return basis.reduce(_sympy(tower.ring, numerator, used, names))[1] == 0


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
