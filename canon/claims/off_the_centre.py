"""Does a claim come to the places that a map's image leaves out?

They are those of a pair of variables at rest in an angle-action map, q = c, p = c'. Where H is smooth there and
∂H/∂q = ∂H/∂p = 0, whatever the others are, they are invariant, and no motion that is elsewhere once comes to them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import sympy as sp

from canon.claims.along_a_range import is_positive
from canon.claims.chart import chart_of
from canon.claims.outcome import Residual
from canon.claims.whole_image import Place, holds_throughout, names_of, without_map
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.region import Region
from canon.decide.tape import Unsupported
from canon.domain import Condition, Domain
from canon.errors import BudgetExceeded, InputError
from canon.expression import Formula
from canon.substitution import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question

INSIDE: Final = (Fraction(1, 2), Fraction(1, 3), Fraction(2, 7))
"""Where it is looked, along a motion, whether it is elsewhere."""
SHARE: Final = 0.2


def stays_off(question: Question, places: Sequence[Place]) -> bool:
    """Whether what a claim speaks of is seen to have no point at the places."""
    if not places:
        return True
    kind = question.claim.kind
    exactly = replace(question, budget=question.budget.share(SHARE), method="symbolic", listen=None)
    if kind in ("stationary", "normal_form"):  # of coordinates, with other momenta; of a series, by what is beside it
        return True
    if kind in ("limit", "integral"):  # along one variable, whatever the other ones are
        values = (value for value in question.claim.keys.values() if isinstance(value, Formula))
        names = {name for formula in values for name in formula.symbols}
        return names & {*question.space.old} <= {question.key("variable")}
    try:
        if question.subject.hamiltonian is None or not all(_is_invariant(exactly, place) for place in places):
            return False
        if question.key("motion") is not None:
            return all(_is_elsewhere(exactly, place) for place in places)
        i = question.space.q.index(question.key("coordinate"))
        return all(place.pair == i and _is_at_another_energy(exactly, place) for place in places)
    except (BudgetExceeded, Unsupported, InputError, ValueError):
        return False


def _constants(question: Question) -> Region:
    """What the file demands of constants."""
    domain, moving = without_map(question).domain, {*question.space.old}
    kept = tuple(c for c in domain.conditions if not names_of(c) & moving)
    return question.region(domain=Domain(kept), chart=chart_of(question.tape, question.space, None))


def _there(question: Question, place: Place, expression: Any) -> Any:
    space = question.space
    return replaced(expression, {space.q[place.pair]: place.q, space.p[place.pair]: place.p})


def _is_invariant(question: Question, place: Place) -> bool:
    H, space = question.hamiltonian(), question.space
    if any(value.has(space.t) for value in (place.q, place.p)):
        return False
    region, pair = _constants(question), {space.q[place.pair], space.p[place.pair]}
    apart = [c for c in H.conditions if not names_of(c) & pair]
    here = [c for c in H.conditions if names_of(c) & pair]
    asked = [Condition(c.kind, tuple(_there(question, place, term) for term in c.terms)) for c in here]
    if any(_is_infinite(term) for c in asked for term in c.terms):
        return False
    region = region.also(*Region.of(question.tape, Domain(tuple(apart))).requirements)
    slopes = [_there(question, place, H.expr.diff(x)) for x in pair]
    if any(map(_is_infinite, slopes)) or not all(holds_throughout(question, c, region) for c in asked):
        return False
    residuals = [Residual(f"slope {k}", question.load(slope)) for k, slope in enumerate(slopes)]
    return question.decide(residuals, region).status == "proved"


def _is_infinite(value: Any) -> bool:
    return bool(value.has(sp.nan, sp.zoo, sp.oo, -sp.oo))


def _is_at_another_energy(question: Question, place: Place) -> bool:
    """An energy that is one value is none of the place's, as that of a separatrix may be."""
    fixed: Mapping[Any, Formula] = question.key("fixed") or {}
    energy = question.key("energy")
    if energy not in fixed:
        return True
    rules: Any = {name: formula.expr for name, formula in fixed.items()}
    gap = replaced(_there(question, place, question.hamiltonian().expr), rules) - rules[energy]
    return _has_a_sign(question, gap, _constants(question))


def _has_a_sign(question: Question, expression: Any, region: Region) -> bool:
    factored: Any = sp.factor(expression)
    tape, node = question.tape, question.load(factored)
    return (
        has_no_zero(tape, node, region, question.budget)
        or is_positive(question, node, region)
        or is_positive(question, tape.negative(node), region)
    )


def _is_elsewhere(question: Question, place: Place) -> bool:
    """Whether the motion of the claim is elsewhere at one time: by what is seen of it then, it always is."""
    low, high, u = (question.key(word) for word in ("from", "to", "parameter"))
    if not (isinstance(low, Formula) and isinstance(high, Formula)):
        return False
    region = _constants(question)
    for gap in _gaps(question, place):
        for part in INSIDE:
            where = low.expr + sp.Rational(part.numerator, part.denominator) * (high.expr - low.expr)
            value = replaced(gap, {u: where})
            if not _is_infinite(value) and _has_a_sign(question, value, region):
                return True
    return False


def _gaps(question: Question, place: Place) -> Iterator[Any]:
    """How far the motion is from the place, in coordinate and momentum, and in both."""
    space, motion = question.space, question.key("motion")
    pairs = ((space.q[place.pair], place.q), (space.p[place.pair], place.p))
    if all(x in motion for x, _ in pairs):
        q, p = (motion[x].expr - value for x, value in pairs)
        yield from (q, p, q**2 + p**2)
