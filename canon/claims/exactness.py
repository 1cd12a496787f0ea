"""When is a closed one-form exact on the region?  With a potential smooth throughout it, or on convex pieces.

A closed form is the differential of a potential near every point; around a hole it need not be one, as
(x dy − y dx)/(x² + y²) shows. Claims of exactness are proved only where one of two arguments holds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import sympy as sp

from canon.decide.cells import cells_of, definite_sign
from canon.decide.intervals import intervals_of
from canon.decide.region import Region
from canon.domain import conditions_of
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question


def smooth_throughout(question: Question, potential: sp.Expr, region: Region) -> bool:
    """True when every condition of the potential is one of the region's, or holds on all of its box."""
    tape = question.tape
    try:
        conditions = conditions_of(potential)
    except InputError:
        return False
    known = {(r.kind, r.nodes) for r in region.requirements}
    intervals = intervals_of(tape, region)
    for condition in conditions:
        nodes = tuple(tape.load(term) for term in condition.terms)
        if (condition.kind, nodes) in known or (condition.kind == "nonzero" and ("positive", nodes) in known):
            continue
        signs = [definite_sign(tape, node, intervals, question.budget) for node in nodes]
        if condition.kind == "positive" and signs[0] == "pos":
            continue
        if condition.kind == "nonzero" and signs[0] is not None:
            continue
        if condition.kind == "uncut" and (signs[0] is not None or signs[1] == "pos"):
            continue
        return False
    return True


def in_convex_pieces(question: Question, region: Region) -> bool:
    """True when the region is a union of separate open boxes, so that every closed form on it is exact (Poincaré)."""
    if any(requirement.kind not in ("positive", "nonzero") for requirement in region.requirements):
        return False
    cells = cells_of(question.tape, region, [], question.budget)
    return bool(cells) and all(cell.connected for cell in cells)
