"""Claims about functions of the old variables, beside a map that is given backward.

They are decided in the new variables, where the map's formulas are explicit, and so on its image alone. Of a map whose
Jacobian determinant vanishes identically the image has no interior: what holds, or fails, there says nothing of phase
space.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from canon.claims.determinant import determinant
from canon.claims.outcome import Outcome
from canon.decide import ladder

if TYPE_CHECKING:
    from canon.claims.question import Question

OF_OLD_VARIABLES: Final = frozenset(
    {"bracket", "jacobi", "conserved", "involution", "independent", "algebra", "casimir"}
)
SHARE: Final = 0.2
"""Of the budget, to see that the map isn't singular everywhere."""
LARGEST: Final = 10
"""Variables beyond which the determinant isn't written down: the map is taken for one by its claim."""
NOTE: Final = (
    "the map, old variables in new ones, is singular everywhere: its image has no interior, and this was looked at "
    "there alone. Leave the map out of this claim's file"
)


def unconfined(question: Question, outcome: Outcome) -> Outcome:
    """The outcome; undecided where all of it was seen on the image of a map that is singular everywhere."""
    chart = question.chart
    if (
        outcome.status == "undecided"
        or question.claim.kind not in OF_OLD_VARIABLES
        or chart.direction != "backward"
        or not 0 < len(chart.old) == len(chart.coordinates) <= LARGEST
    ):
        return outcome
    exactly = replace(question, budget=question.budget.share(SHARE), method="symbolic")
    det = determinant(exactly.tape, exactly.chart.jacobian(exactly.chart.old))
    regular = ladder.nonvanishing(exactly.tape, det, exactly.region(), budget=exactly.budget, seed=question.seed)
    return Outcome("undecided", note=NOTE) if regular.status == "refuted" else outcome
