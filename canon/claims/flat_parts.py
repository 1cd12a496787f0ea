"""Determinants that vanish throughout a part of the domain: what they would solve isn't determined there."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from canon.claims.determinant import determinant
from canon.claims.outcome import Outcome
from canon.decide.enclosure import excludes_zero
from canon.decide.region import Region
from canon.decide.search import samples
from canon.decide.tape import Node, Unsupported

if TYPE_CHECKING:
    from canon.claims.question import Question

POINTS, BITS = 16, 256
NOTE = "det d2L/dv2 isn't 0 everywhere; on a part of the domain it seems to be"


def seems_flat_in_parts(question: Question, node: Node, region: Region) -> bool:
    """Whether the node can't be told from 0 at some of a few points: (|a| + a) q is no complete integral for a < 0."""
    rng = random.Random(question.seed)
    try:
        found = samples(question.tape, [node], region, rng, count=POINTS, bits=BITS, tries=4, budget=question.budget)
        return any(not excludes_zero(sample.balls[node]) for sample in found)
    except Unsupported:
        return False


def regular_in_parts(question: Question, rows: Sequence[Sequence[Node]], region: Region, regular: Outcome) -> Outcome:
    """A Hessian's outcome, `supported` where it is regular on a part of the domain alone, as that of (v + |v|)²."""
    if regular.status != "proved" or not seems_flat_in_parts(question, determinant(question.tape, rows), region):
        return regular
    return replace(regular.with_status("supported", NOTE), arguments=())
