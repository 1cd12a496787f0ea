"""Levi-Civita's conditions: H separates additively in the coordinates as they stand if and only if they hold.

H^i H^j H_ij + H_i H_j H^ij − H^i H_j H_i^j − H_i H^j H_j^i = 0 for all i < j, where upper indices are derivatives by
momenta and lower ones by coordinates, nothing being summed (Levi-Civita, Mathematische Annalen 59 (1904) 383). Any H
without time: orthogonal coordinates, a kinetic energy of its own, or a given form of H are not supposed.
"""

from itertools import combinations

import sympy as sp

from canon.mechanics.formulas import Expression, as_expression
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.poisson import check_functions


def levi_civita(space: PhaseSpace, H: Expression) -> dict[tuple[sp.Symbol, sp.Symbol], sp.Expr]:
    """The left-hand sides, for each pair of coordinates."""
    check_space(space)
    value = as_expression(H)
    check_functions([value], space, "H")
    found: dict[tuple[sp.Symbol, sp.Symbol], sp.Expr] = {}
    for (x, a), (y, b) in combinations(list(zip(space.q, space.p, strict=True)), 2):
        terms = (
            value.diff(a) * value.diff(b) * value.diff(x, y),
            value.diff(x) * value.diff(y) * value.diff(a, b),
            -value.diff(a) * value.diff(y) * value.diff(x, b),
            -value.diff(x) * value.diff(b) * value.diff(a, y),
        )
        found[x, y] = sp.Add(*terms)
    return found
