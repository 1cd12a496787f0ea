"""Claims in old variables alone, beside a map given backward or by a generating function: they are about its image.

What the map demands is said in new or mixed variables: with q = exp(Q) a claim is one about q > 0. Local claims are
decided in the old variables all over, so that what holds everywhere holds on the image, and what fails has to fail
there too. Limits, ranges, paths and orbits may leave the image, the origin of a normal form may not lie in it, and then
there is nothing to claim. Where the image is all of the domain (`canon.claims.whole_image`), or all but places that the
claim doesn't come to, they are claims without the map.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

import sympy as sp

from canon.claims.off_the_centre import stays_off
from canon.claims.outcome import Outcome
from canon.claims.whole_image import WholeImage, whole_image, without_map
from canon.decide.tape import Tape
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

LOCAL: Final = frozenset({"constraint", "euler_lagrange", "hamilton_jacobi", "legendre", "noether"})
"""Kinds that say something at each point, which is looked for in the old variables."""
VARYING: Final = frozenset({"integral", "limit"})
"""Kinds that vary one name, which need not be one of the phase space."""
ALONG: Final = frozenset({"action", "average", "frequency", "normal_form", "stationary"})
"""Kinds about paths and orbits in phase space, or about its origin."""
DETERMINED: Final = frozenset({"euler_lagrange", "hamilton_jacobi", "legendre"})
"""Kinds that are refuted without a residual where a determinant is 0 identically: so it is on the image."""
SHARE: Final = 0.3
"""Of the budget, to see that a claim fails on the image, too."""
NOTE: Final = (
    "the file's map has only its image for a domain in the old variables, and it isn't seen that this claim is one "
    "about points of it. Leave the map out of this claim's file"
)
LEFT_OUT: Final = (
    "the image of the file's map leaves out {places}, and it isn't seen that the claim doesn't come there. Leave the "
    "map out of this claim's file"
)
WHOLE: Final = "the map's image is the whole domain in the old variables"


def without_its_map(question: Question) -> tuple[Question | None, WholeImage | None]:
    """The question without the file's map, where it is seen to be the same, and what is seen of the image.

    None for claims that say something at each point, or of new variables.
    """
    claim = question.claim
    along = claim.kind in ALONG or (claim.kind in VARYING and _is_of_the_map(question))
    if not along or question.chart.direction not in ("backward", "implicit") or question.key("virial") is not None:
        return None, None
    if _names(claim.keys) & {*question.space.new}:
        return None, None
    seen = whole_image(question)
    if seen is None or not stays_off(question, seen.left_out):
        return None, seen
    return replace(question, claim=replace(claim, subject=without_map(question)), tape=Tape()), seen


def grounds(seen: WholeImage, outcome: Outcome) -> Outcome:
    """The outcome of a claim without its map, with what that rests on."""
    if outcome.status not in ("proved", "refuted"):
        return outcome
    left = tuple(f"{place}, where the claim doesn't come" for place in seen.left_out)
    step = {"theorem": WHOLE, "inverse": seen.inverse, **({"but for": left} if left else {})}
    return replace(outcome, arguments=(*outcome.arguments, step))


def _names(value: Any) -> set[Any]:
    """The names in a key's value."""
    if isinstance(value, Mapping):
        return {name for item in (*value.keys(), *value.values()) for name in _names(item)}
    if isinstance(value, (list, tuple)):
        return {name for item in value for name in _names(item)}
    expression = value.expr if isinstance(value, Formula) else value
    return {*expression.free_symbols} if isinstance(expression, sp.Basic) else set()


def on_image(question: Question, outcome: Outcome, seen: WholeImage | None = None) -> Outcome:
    """The outcome; undecided where it isn't seen to be one about the image of the file's map, of which so much is
    `seen`."""
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
        places = () if seen is None else seen.left_out
        left_out = LEFT_OUT.format(places=" and ".join(map(str, places)))
        return Outcome("undecided", note=left_out if places else NOTE)
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
