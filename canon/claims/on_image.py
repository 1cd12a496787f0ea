"""Claims in old variables alone, beside a map given backward or by a generating function: they are about its image.

What the map demands is said in new or mixed variables: with q = exp(Q) a claim is one about q > 0. Local claims are
decided in the old variables all over, so that what holds everywhere holds on the image, and what fails has to fail
there too. Limits, ranges, paths and orbits may leave the image, and then there is nothing to claim.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from canon.claims.outcome import Outcome
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

LOCAL: Final = frozenset({"constraint", "euler_lagrange", "hamilton_jacobi", "legendre", "noether"})
"""Kinds that say something at each point, which is looked for in the old variables."""
VARYING: Final = frozenset({"integral", "limit"})
"""Kinds that vary one name, which need not be one of the phase space."""
ALONG: Final = frozenset({"action", "average", "frequency", "stationary"})
"""Kinds about paths and orbits in phase space."""
DETERMINED: Final = frozenset({"euler_lagrange", "hamilton_jacobi", "legendre"})
"""Kinds that are refuted without a residual where a determinant is 0 identically: so it is on the image."""
SHARE: Final = 0.3
"""Of the budget, to see that a claim fails on the image, too."""
NOTE: Final = (
    "the file's map has only its image for a domain in the old variables, and it isn't seen that this claim is one "
    "about points of it. Leave the map out of this claim's file"
)


def on_image(question: Question, outcome: Outcome) -> Outcome:
    """The outcome; undecided where it isn't seen to be one about the image of the file's map."""
    kind = question.claim.kind
    if (
        outcome.status not in ("proved", "refuted")
        or kind not in LOCAL | VARYING | ALONG
        or question.chart.direction not in ("backward", "implicit")
    ):
        return outcome
    if kind in LOCAL and outcome.status == "proved":
        return outcome
    if kind in ALONG or (kind in VARYING and _is_of_the_map(question)):
        return Outcome("undecided", note=NOTE)
    return outcome if outcome.status == "proved" or _fails_there(question, outcome) else Outcome("undecided", note=NOTE)


def _is_of_the_map(question: Question) -> bool:
    """Whether the name that varies is an old variable, or occurs in what all claims of the file share."""
    shared = {*question.space.old}
    for formula in question.sections():
        shared |= formula.expr.free_symbols
        shared |= {name for c in formula.conditions for term in c.terms for name in term.free_symbols}
    shared |= {name for c in question.subject.domain.conditions for term in c.terms for name in term.free_symbols}
    return question.key("variable") in shared


def _fails_there(question: Question, outcome: Outcome) -> bool:
    """Whether the residual that refutes isn't 0 at a point of the claim's domain, pulled back by the map."""
    if outcome.failed is None:
        return question.claim.kind in DETERMINED
    exactly = replace(question, budget=question.budget.share(SHARE), method="symbolic")
    region = exactly.region(*(value for value in question.claim.keys.values() if isinstance(value, Formula)))
    residual = exactly.chart.pull(outcome.failed.residual.node)
    return exactly.not_identically_zero(residual, region).status == "proved"
