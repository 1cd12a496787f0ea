"""Positive throughout a region, by cases: the signs of what isn't 0 there, or the whole numbers one by one.

A region on which a real f is nowhere 0 is the union of the parts where f > 0 and where f < 0; what is positive on both
is positive. And a polynomial in one whole number k is, beyond Cauchy's bound 1 + max |aᵢ/aₙ| of its roots, of the sign
of its leading term; the finitely many whole numbers within the bound are tried.
"""

from __future__ import annotations

import math
from itertools import product
from typing import Any

import sympy as sp

from canon.budget import Budget
from canon.decide.nowhere_zero import factors
from canon.decide.positivity import positive_by_signs
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape

MOST_CASES, MOST_WHOLE_NUMBERS = 3, 2000


def positive_by_cases(tape: Tape, node: Node, region: Region, budget: Budget, *, strict: bool) -> tuple[Node, ...]:
    """The nodes whose two signs, in all combinations, show the node to be positive; none where they don't.

    They are real ones that conditions of the region keep from 0, or factors of such.
    """
    names = tape.support(node)
    asked = {f for r in region.requirements if r.kind == "nonzero" for f in factors(tape, r.nodes[0])}
    split = tuple(sorted(n for n in asked if not tape.is_complex(n) and tape.support(n) & names))
    if not 0 < len(split) <= MOST_CASES:
        return ()
    for signs in product((1, -1), repeat=len(split)):
        budget.check()
        signed = [n if sign > 0 else tape.negative(n) for n, sign in zip(split, signs, strict=True)]
        case = region.also(*(Requirement("positive", (n,), "a case") for n in signed))
        if not positive_by_signs(tape, node, case, budget, strict=strict):
            return ()
    return split


def positive_at_whole_numbers(tape: Tape, node: Node, *, strict: bool) -> bool:
    """Whether a polynomial over Q in one integer alone is positive (not negative) at all that are assumed of it."""
    names = sorted(tape.support(node))
    if len(names) != 1 or tape.functions_of([node]):
        return False
    k = tape.symbol_at(names[0])
    if not k.is_integer:
        return False
    try:
        p = sp.Poly(tape.to_sympy(node), k, domain=sp.QQ)
    except (sp.PolynomialError, sp.CoercionFailed):
        return False
    if p.degree() < 1:
        return False
    leading, *others = p.all_coeffs()
    bound = 1 + math.ceil(max(abs(c / leading) for c in others))
    if bound > MOST_WHOLE_NUMBERS:
        return False
    upwards, downwards = not k.is_nonpositive, not k.is_nonnegative
    if upwards and leading < 0:
        return False
    if downwards and leading * (-1) ** p.degree() < 0:
        return False
    tried = range(-bound if downwards else 0, bound + 1 if upwards else 1)
    values: list[Any] = [p.eval(n) for n in tried if n or k.is_zero is not False]
    return all(value > 0 or (value == 0 and not strict) for value in values)
