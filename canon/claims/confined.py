"""Claims beside a map that is given backward, or by a generating function, and is singular everywhere.

They are decided in the variables in which the map's formulas are explicit, and so on its image alone. Of a map whose
Jacobian determinant vanishes identically the image has no interior: what holds, or fails, there says nothing of phase
space.
"""

from __future__ import annotations

import random
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from flint import acb, acb_mat

from canon.budget import BudgetExceeded
from canon.claims.determinant import determinant
from canon.claims.outcome import Outcome
from canon.decide import ladder
from canon.decide.enclosure import OutOfDomain
from canon.decide.region import Region
from canon.decide.sample import evaluate_again
from canon.decide.search import samples
from canon.decide.tape import Unsupported
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question

OF_THE_MAP: Final = frozenset(
    {
        "canonical", "canonical_when", "fundamental_brackets", "bracket_invariance", "volume", "integral_invariant",
        "cartan_invariant", "generates", "generating_function", "new_hamiltonian", "symmetry", "action_angle",
    }
)  # fmt: skip
"""The kinds that ask themselves whether the map is singular: none of them holds of one that is."""
SHARE: Final = 0.2
"""Of the budget, to see that the map isn't singular everywhere."""
LARGEST: Final = 10
"""Variables beyond which the determinant isn't written down: it is looked at in points alone."""
POINTS: Final = 6
NOTE: Final = (
    "the map, old variables in new ones, is singular everywhere: its image has no interior, and this was looked at "
    "there alone. Leave the map out of this claim's file"
)
UNSEEN: Final = "no point was found at which the file's map is regular, and this was looked at on its image alone"


def unconfined(question: Question, outcome: Outcome) -> Outcome:
    """The outcome; undecided where all of it was seen on the image of a map that is singular everywhere."""
    chart = question.chart
    if (
        outcome.status == "undecided"
        or question.claim.kind in OF_THE_MAP
        or chart.direction not in ("backward", "implicit")
        or not 0 < len(chart.old) == len(chart.coordinates)
    ):
        return outcome
    exactly = replace(question, budget=question.budget.share(SHARE), method="symbolic")
    region = replace(exactly.region(regular=False), surface=())
    if _is_regular_somewhere(exactly, region):
        return outcome
    if len(chart.coordinates) > LARGEST:
        return Outcome("undecided", note=UNSEEN)
    det = determinant(exactly.tape, exactly.chart.jacobian(exactly.chart.old))
    regular = ladder.nonvanishing(exactly.tape, det, region, budget=exactly.budget, seed=question.seed)
    return Outcome("undecided", note=NOTE) if regular.status == "refuted" else outcome


def _is_regular_somewhere(question: Question, region: Region) -> bool:
    """Whether a point is found at which the determinant's ball is without 0."""
    tape, rows = question.tape, question.chart.jacobian(question.chart.old)
    entries = [node for row in rows for node in row]
    try:
        rng = random.Random(question.seed)
        for place in samples(tape, entries, region, rng, count=POINTS, tries=10, budget=question.budget):
            balls = evaluate_again(tape, entries, place, 128)
            if not acb_mat([[acb(balls[node]) for node in row] for row in rows]).det().contains(0):
                return True
    except (BudgetExceeded, Unsupported, OutOfDomain, ZeroDivisionError, OverflowError, InputError):
        return False
    return False
