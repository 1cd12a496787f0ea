"""A variable that runs through a range: what is shown to hold all along it, for all values of the other names."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

import sympy as sp

from canon.budget import BudgetExceeded
from canon.claims.approach import approaching, limit_of, signs_on
from canon.claims.some_function import bare_call, some_function_has
from canon.claims.velocities import region_in_velocities
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import evaluate, precision
from canon.decide.intervals import intervals_of
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.positivity import positive_by_boxes, positive_by_signs
from canon.decide.power_series import Unexpanded
from canon.decide.region import Region, Requirement
from canon.decide.regular_on_box import is_regular
from canon.decide.tape import Node, Unsupported
from canon.errors import InputError
from canon.expression import Formula
from canon.sign import declared

if TYPE_CHECKING:
    from canon.claims.question import Question

End = Formula | str


class Unproved(Exception):
    """What a claim needs of a range isn't shown; says what."""


@dataclass(frozen=True)
class Range:
    """A variable with the ends of its range, formulas or infinities, and the region of the other names and of it."""

    x: sp.Symbol
    low: End
    high: End
    others: Region
    inside: Region
    demanded: tuple[Requirement, ...]


def range_of(question: Question, x: sp.Symbol, low: End, high: End, formulas: Sequence[Formula]) -> Range:
    """The range, with what the claim's formulas demand of x inside of it. **Raises:** `InputError`, `Unproved`."""
    tape, node = question.tape, question.tape.symbol(x)
    for word, end in (("from", low), ("to", high)):
        if isinstance(end, Formula) and x in end.symbols:
            raise InputError(f"{x} is the variable of integration: it can't be in an end of its range", f"key {word!r}")
        if isinstance(end, Formula) and tape.is_complex(question.load(end)):
            raise InputError(f"{end} is complex: a range is one of real numbers", f"key {word!r}")
    whole = region_in_velocities(question, *formulas, *(e for e in (low, high) if isinstance(e, Formula)))
    demanded = tuple(r for r in whole.requirements if any(node in tape.support(n) for n in r.nodes))
    if any(node in tape.support(n) for n in whole.surface):
        raise InputError(f"the surface of the domain contains {x}", "[domain], key 'on'")
    kept = tuple(r for r in whole.requirements if r not in demanded)
    others = Region(kept, whole.surface, tuple(n for n in whole.symbols if n != node))
    walls = []
    if isinstance(low, Formula):
        walls.append(Requirement("positive", (tape.minus(node, question.load(low)),), f"{x} > {low}"))
    if isinstance(high, Formula):
        walls.append(Requirement("positive", (tape.minus(question.load(high), node),), f"{x} < {high}"))
    found = Range(x, low, high, others, Region((*kept, *walls), whole.surface, ()), demanded)
    _ordered(question, found)
    _assumed(question, found)
    stays_in_domain(question, found, found.demanded, formulas)
    functions_exist(question, found, found.demanded)
    return found


def stays_in_domain(
    question: Question, span: Range, demanded: Sequence[Requirement], formulas: Sequence[Formula]
) -> None:
    """What the file demands besides the claim's formulas must hold all along the range. **Raises:** `Unproved`."""
    domain = question.subject.domain
    own = [Region.of(question.tape, replace(domain, conditions=f.conditions, surface=())) for f in formulas]
    known = {(r.kind, r.nodes) for region in own for r in region.requirements}
    for requirement in demanded:
        if (requirement.kind, requirement.nodes) not in known and not holds(question, requirement, span.inside, span):
            raise Unproved(f"it isn't shown that {requirement.text} all along the range, as the file demands")


def functions_exist(question: Question, span: Range, demanded: Sequence[Requirement]) -> None:
    """There must be functions with the values that are demanded along the range. **Raises:** `Unproved`."""

    def shown(requirement: Requirement) -> bool:
        return holds(question, requirement, span.inside)

    if not some_function_has(question.tape, demanded, span.others.requirements, shown):
        raise Unproved("no function was found that has all the values demanded of it along the range")


def _ordered(question: Question, span: Range) -> None:
    low, high = span.low, span.high
    if low == "infinity" or high == "-infinity":
        raise InputError("the range runs upwards: exchange 'from' and 'to', and change the sign", "key 'from'")
    if isinstance(low, Formula) and isinstance(high, Formula):
        width = question.tape.minus(question.load(high), question.load(low))
        if not is_positive(question, width, span.others):
            raise Unproved(f"it isn't shown that {low} < {high}: say so under [domain]")


def _assumed(question: Question, span: Range) -> None:
    """What is assumed of the variable must hold all along the range."""
    facts = declared(span.x)
    if facts.get("integer") or not facts.get("real"):
        raise InputError(f"{span.x} is no real variable", "key 'variable'")
    sides = [word for word in ("nonnegative", "nonpositive") if facts.get(word)]
    if not sides and facts.get("zero") is not False:
        return
    sign_of = signs_on(question, span.others)

    def beyond(end: End, wanted: str) -> bool:
        return isinstance(end, Formula) and sign_of(question.load(end)) in ("zero", wanted)

    up, down = beyond(span.low, "pos"), beyond(span.high, "neg")
    if not ((up and sides != ["nonpositive"]) or (down and sides != ["nonnegative"])):
        raise InputError(f"{span.x} leaves what is assumed of it, from {span.low} to {span.high}", "key 'variable'")


def is_positive(question: Question, node: Node, region: Region, *, strict: bool = True) -> bool:
    """Whether a node is shown to be positive (not negative) throughout a region."""
    tape, budget = question.tape, question.budget
    if tape.is_complex(node):
        return False
    if not tape.support(node) and not tape.functions_of([node]):
        with precision(64):
            ball = evaluate(tape, tape.reach([node]), {})[node]
        return bool(ball > 0 or (not strict and ball >= 0))
    if positive_by_signs(tape, node, region, budget.share(0.3), strict=strict):
        return True
    with contextlib.suppress(InputError):  # a denominator that is 0 where the wave is
        if _affine_in_wave(question, node, region, strict=strict):
            return True
    with contextlib.suppress(BudgetExceeded):
        return positive_by_boxes(tape, node, region, budget.share(0.2), strict=strict) is not None
    return False


def _affine_in_wave(question: Question, node: Node, region: Region, *, strict: bool) -> bool:
    """Whether a node that is affine in one sine or cosine is positive where this is 1 and where it is −1; or one that
    is affine in the squares of both, where the one and where the other is 0."""
    tape = question.tape
    waves = [i for i in tape.reach([node]) if tape.ops[i][:2] in (("f", "sin"), ("f", "cos"))]
    if not 0 < len(waves) <= 2 or len({tape.ops[i][2] for i in waves}) > 1:
        return False
    places = [tape.symbol(sp.Dummy(real=True)) for _ in waves]
    plain = substitute(tape, node, dict(zip(waves, places, strict=True)))
    slopes = [derivative(tape, plain, x) for x in places]
    if len(waves) == 1:
        bent, corners = slopes, [(1,), (-1,)]
    else:
        flat = [substitute(tape, slope, dict.fromkeys(places, tape.zero)) for slope in slopes]
        if any(tape.value(slope) != 0 for slope in (*flat, derivative(tape, slopes[0], places[1]))):
            return False
        bent, corners = [derivative(tape, slope, x) for slope, x in zip(slopes, places, strict=True)], [(1, 0), (0, 1)]
    if any(tape.support(slope) & {*places} for slope in bent):
        return False
    ends = (
        substitute(tape, plain, {x: tape.number(v) for x, v in zip(places, corner, strict=True)}) for corner in corners
    )
    return all(positive_by_signs(tape, end, region, question.budget.share(0.3), strict=strict) for end in ends)


def holds(question: Question, requirement: Requirement, region: Region, span: Range | None = None) -> bool:
    """Whether a condition is shown to hold throughout a region, that inside of a range where one is given."""
    tape, first = question.tape, requirement.nodes[0]
    if requirement.kind in ("positive", "nonzero") and bare_call(tape, first) is not None:
        return True  # the claim is one of functions with such values: `functions_exist`

    def positive(node: Node) -> bool:
        if tape.is_complex(node):
            return False
        if is_positive(question, node, region):
            return True
        return span is not None and (_above_its_ends(question, node, span) or _half_wave(question, node, span))

    if requirement.kind in ("positive", "slit"):
        return positive(first)
    if requirement.kind == "uncut" and positive(requirement.nodes[1]):
        return True
    if requirement.kind in ("nonzero", "uncut"):
        free = has_no_zero(tape, first, region, question.budget)
        return free or positive(first) or positive(tape.negative(first))
    return requirement.kind == "regular" and is_regular(tape, first, intervals_of(tape, region), question.budget)


def _at_ends(question: Question, node: Node, span: Range) -> list[Node | None]:
    """The finite limits of a node at the ends of a range; None at an infinite end, or where there is none."""
    found: list[Node | None] = []
    for end, side in ((span.low, 1), (span.high, -1)):
        if isinstance(end, str):
            found.append(None)
            continue
        near = replace(approaching(question, span.x, end, side, ()), region=span.others, near=())
        try:
            found.append(limit_of(question, near, node, (node,)).value)
        except (Unexpanded, Unsupported, InputError):
            found.append(None)
    return found


def _half_wave(question: Question, node: Node, span: Range) -> bool:
    """Whether a multiple of a sine or cosine is positive since its argument runs within half a turn."""
    tape, op = question.tape, question.tape.ops[node]
    if op[0] == "+" and not op[1] and len(op[2]) == 1 and op[2][0][1] > 0:
        return _half_wave(question, op[2][0][0], span)
    if op[:2] not in (("f", "sin"), ("f", "cos")):
        return False
    (phase,) = op[2]
    slope = derivative(tape, phase, tape.symbol(span.x))
    ends = _at_ends(question, phase, span)
    if is_positive(question, tape.negative(slope), span.inside):
        ends.reverse()
    elif not is_positive(question, slope, span.inside):
        return False
    half = tape.scaled(tape.constant("pi"), Fraction(1, 2))
    first, last = (tape.zero, tape.constant("pi")) if op[1] == "sin" else (tape.negative(half), half)
    if ends[0] is None or ends[1] is None:
        return False
    above, below = tape.minus(ends[0], first), tape.minus(last, ends[1])
    return all(tape.value(n) == 0 or is_positive(question, n, span.others, strict=False) for n in (above, below))


def _above_its_ends(question: Question, node: Node, span: Range) -> bool:
    """Whether a function is positive inside the range since it is strictly concave, or monotone, and isn't below 0
    where it is least, at an end."""
    tape, x = question.tape, question.tape.symbol(span.x)
    slope, values = derivative(tape, node, x), _at_ends(question, node, span)
    sign_of = signs_on(question, span.others)
    low, high = (value is not None and sign_of(value) in ("zero", "pos") for value in values)
    if low and high and is_positive(question, tape.negative(derivative(tape, slope, x)), span.inside):
        return True
    return (low and is_positive(question, slope, span.inside)) or (
        high and is_positive(question, tape.negative(slope), span.inside)
    )
