"""Definite integrals with a closed form."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.budget import BudgetExceeded
from canon.claims.along_a_range import Range, Unproved, range_of
from canon.claims.antiderivatives import antiderivatives
from canon.claims.approach import Limit
from canon.claims.definite import at_points, exact_value
from canon.claims.gaussian import gauss
from canon.claims.outcome import Outcome, Residual
from canon.claims.show import with_value
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

THEOREM = "an antiderivative, continuous inside the range, and its limits at the ends"


def integral(question: Question) -> Outcome:
    """`integral`: ∫ f dx from `from` to `to` is `equals`, x the `variable`, improper where f or the range is unbounded.

    Exact by an antiderivative F, given or found: F' = f and F is smooth throughout the open range, and the limits of F
    at the ends differ by `equals`. Refuted by that value, or by a certified quadrature at a point of the other names.
    """
    f, equals = question.formula("f"), question.formula("equals")
    x: sp.Symbol = question.key("variable")
    given = question.key("antiderivative")
    if x in equals.symbols:
        raise InputError(f"{x} is the variable of integration: the integral doesn't depend on it", "key 'equals'")
    try:
        span = range_of(question, x, question.key("from"), question.key("to"), (f, equals))
    except Unproved as reason:
        return Outcome("undecided", note=str(reason))
    return integral_is(question, span, f, question.load(f), question.load(equals), given)


def integral_is(
    question: Question, span: Range, f: Formula, node: Node, claimed: Node, given: Formula | None
) -> Outcome:
    """Is the integral of a node, that of the formula f, what is claimed?"""
    note = ""
    if question.method != "numeric":
        try:
            known = gauss(question, span, f, node, claimed) if given is None else None
            if known is not None and known.status in ("proved", "refuted"):
                return with_value(question, known)
            if given is not None:
                return _by_ends(question, span, claimed, given, *exact_value(question, span, node, given))
            return _by_one_found(question, span, f, node, claimed)
        except Unproved as reason:
            note = str(reason)
        except BudgetExceeded:
            note = "no argument was found in time"
    found = at_points(question, span, node, claimed, question.budget.share(0.8))
    return replace(found, note="; ".join(part for part in (note, found.note) if part))


def _by_one_found(question: Question, span: Range, f: Formula, node: Node, claimed: Node) -> Outcome:
    """By the first antiderivative, of those that rules find, that tells. **Raises:** `Unproved`."""
    reason, left = "no antiderivative was given or found", None
    for F in antiderivatives(question, f, span.x):
        try:
            found = _by_ends(question, span, claimed, F, *exact_value(question, span, node, F))
        except Unproved as unproved:
            reason = str(unproved)
            continue
        except InputError:  # the rule was wrong
            continue
        if found.status in ("proved", "refuted"):
            return found
        left = left or found
    if left is None:
        raise Unproved(reason)
    return left


def _by_ends(
    question: Question, span: Range, claimed: Node, F: Formula, low: Limit, high: Limit, shown: Outcome
) -> Outcome:
    tape = question.tape
    if low.value is None or high.value is None:
        if low.value is None and high.value is None:
            raise Unproved("both limits of the antiderivative are infinite")
        end, beyond = (span.high, high) if high.value is None else (span.low, low)
        return _divergent(question, span, beyond, {"diverges": f"at {end}", "antiderivative": str(F)})
    value = tape.minus(high.value, low.value)
    residual = Residual("value of the integral", tape.minus(value, claimed), value)
    outcome = question.decide([residual], span.others)
    detail = {"antiderivative": str(F)}
    if outcome.status == "proved":
        steps = (*shown.arguments, {"theorem": THEOREM, **detail}, *outcome.arguments)
        outcome = replace(outcome, method=f"antiderivative, {outcome.method}", arguments=steps)
    elif outcome.status == "refuted":
        outcome = replace(outcome, method=f"antiderivative, {outcome.method}")
    return with_value(question, outcome).with_detail(**detail)


def _divergent(question: Question, span: Range, beyond: Limit, detail: dict[str, Any]) -> Outcome:
    """The antiderivative is finite at one end and grows beyond all bounds at the other.

    It does for all values of the other names, or where the leading coefficient isn't 0, if its sign is not known.
    """
    said = "the antiderivative grows beyond all bounds at one end"
    if beyond.infinite:
        return question.refuted_exactly(span.others, said, **detail)
    assert beyond.leading is not None
    answer = question.not_identically_zero(beyond.leading, span.others)
    if answer.status != "proved" or answer.witness is None:
        raise Unproved(f"the antiderivative's leading term {question.show(beyond.leading)} has no sign")
    table = answer.witness.as_table()
    return Outcome("refuted", "leading term", witness=table, numeric=answer.numeric, detail={**detail, "fails": said})


KINDS = {"integral": integral}
