"""When is a closed one-form exact on the region?  With a potential smooth throughout it, or where all loops contract.

A closed form is the differential of a potential near every point; around a hole it need not be one, as
(x dy − y dx)/(x² + y²) shows. Claims of exactness are proved where one of these arguments holds, and refuted by a loop
in the region round which the form's integral certainly isn't 0.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import sympy as sp

from canon.budget import BudgetExceeded
from canon.claims.outcome import Outcome, exact
from canon.claims.potential import verified_potential
from canon.decide.cells import cells_of
from canon.decide.contractible import is_sum_of_squares, loops_contract
from canon.decide.intervals import intervals_of
from canon.decide.loops import circulation
from canon.decide.region import Region
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Node
from canon.domain import conditions_of
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question

FEW_LOOPS, MANY_LOOPS = 6, 60
STOKES = "the integral of an exact form round a closed loop is 0"


def exact_throughout(question: Question, closed: Outcome, slopes: Mapping[Node, Node], region: Region) -> Outcome:
    """What is known of the form Σ slope · d(coordinate), which was shown to be `closed`.

    A few loops are looked at before a potential is searched for, which may take long and be found on part of the domain
    only; many more after it.
    """
    theorem = _theorem(question, slopes, region)
    if theorem is None:
        refuted = _by_a_loop(question, slopes, region, FEW_LOOPS)
        if refuted is not None:
            return refuted
    potential = verified_potential(question, list(slopes.values()), list(slopes), region)
    outcome = closed.with_detail(potential=None if potential is None else str(potential))
    if potential is not None and smooth_throughout(question, potential, region):
        return outcome
    if theorem is not None:
        return _by_theorem(outcome, theorem)
    refuted = _by_a_loop(question, slopes, region, MANY_LOOPS)
    return refuted or outcome.with_status(
        "supported", "the form is closed; that it is exact on all of the domain isn't shown"
    )


def _theorem(question: Question, slopes: Mapping[Node, Node], region: Region) -> str | None:
    """Why every closed form on the region is exact, if that is shown."""
    if loops_contract(question.tape, region, list(slopes), question.budget):
        return "every loop in the domain can be contracted"
    return "Poincare's lemma on convex pieces" if in_convex_pieces(question, region) else None


def _by_a_loop(question: Question, slopes: Mapping[Node, Node], region: Region, most: int) -> Outcome | None:
    """A refutation by a loop with a period, among so many."""
    budget, rng = question.budget.share(0.5), random.Random(question.seed)
    try:
        found = circulation(question.tape, slopes, region, rng, budget, most)
    except BudgetExceeded:
        return None
    if found is None:
        return None
    loop, value = found.loop.describe(question.tape), found.value.str(12, radius=False)
    return exact("refuted", STOKES, loop=loop, loop_integral=value)


def _by_theorem(outcome: Outcome, theorem: str) -> Outcome:
    return replace(outcome, arguments=(*outcome.arguments, {"theorem": theorem})).with_detail(exact_by=theorem)


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
        if condition.kind == "positive" and ("nonzero", nodes) in known and is_sum_of_squares(tape, nodes[0]):
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
