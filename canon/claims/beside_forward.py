"""Claims about orbits and origins, beside a map that is given forward: its formulas restrict the domain, too.

With Q = log q a file is about q > 0, where an oscillator has no orbit that closes. What the map demands, and what the
file says of its new variables, has to hold all over the domain that the file has in old variables without it; else
nothing is said.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from canon.claims.chart import chart_of
from canon.claims.outcome import Outcome
from canon.claims.whole_image import holds_throughout, names_of
from canon.decide.tape import Unsupported
from canon.domain import Condition, Domain
from canon.errors import BudgetExceeded, EmptyDomain, InputError
from canon.mechanics.formulas import assumed_of

if TYPE_CHECKING:
    import sympy as sp

    from canon.claims.question import Question

ABOUT_ORBITS: Final = frozenset({"action", "average", "frequency", "normal_form"})
"""Kinds that are decided by H and the domain's conditions on old variables."""
SHARE: Final = 0.3
"""Of the budget, to see that what the map demands holds anyway."""
NOTE: Final = (
    "the file's map restricts its domain to where {condition}, and it isn't seen that the claim's orbits stay there. "
    "Leave the map out of this claim's file"
)


def on_its_domain(question: Question, outcome: Outcome) -> Outcome:
    """The outcome; undecided where the map, given forward, may leave out a part of the claim's orbits."""
    if (
        outcome.status == "undecided"
        or question.claim.kind not in ABOUT_ORBITS
        or question.chart.direction != "forward"
        or question.key("virial") is not None
        or question.key("motion") is not None
    ):
        return outcome
    for condition in dict.fromkeys(demanded(question)):
        if not _holds_anyway(question, condition):
            return Outcome("undecided", note=NOTE.format(condition=condition))
    return outcome


def demanded(question: Question, but: Collection[sp.Symbol] = ()) -> Iterator[Condition]:
    """What a forward map's formulas demand, and what is said of new variables, in old ones; `but` keep their names."""
    subject = question.subject
    assert subject.transformation is not None
    given: dict[Any, Any] = {x: f.expr for x, f in subject.transformation.mapping.items() if x not in but}
    for formula in subject.transformation.formulas:
        yield from formula.conditions
    for condition in subject.domain.conditions:
        if names_of(condition) & {*given}:
            yield condition.substitute(given)
    for x, expression in given.items():
        yield from assumed_of(x, expression)


def _holds_anyway(question: Question, condition: Condition) -> bool:
    exactly = replace(question, budget=question.budget.share(SHARE), method="symbolic", listen=None)
    plain, new, H = chart_of(question.tape, question.space, None), {*question.space.new}, question.subject.hamiltonian
    without = [c for c in question.subject.domain.conditions if not names_of(c) & new]
    without += [] if H is None else H.conditions
    without = [c for c in without if not c.kink]  # which an orbit passes, and nothing else that is asked for there
    try:
        region = exactly.region(domain=Domain(tuple(without)), chart=plain, regular=False)
        return holds_throughout(exactly, condition, region)
    except (BudgetExceeded, Unsupported, EmptyDomain, InputError, NotImplementedError, RecursionError):
        return False
