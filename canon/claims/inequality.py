"""Inequalities that hold throughout the domain."""

from __future__ import annotations

import contextlib
import random
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from canon.budget import BudgetExceeded
from canon.claims.outcome import Outcome, Residual
from canon.decide.answer import Witness
from canon.decide.positive_by_cases import positive_at_whole_numbers, positive_by_cases
from canon.decide.positive_by_slopes import positive_by_slopes
from canon.decide.positivity import first_points, is_below, point_below, positive_by_boxes, positive_by_signs
from canon.decide.sample import Sample
from canon.decide.tape import Node, Unsupported
from canon.errors import InputError
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region


def inequality(question: Question) -> Outcome:
    """`inequality`: lhs < rhs, <=, > or >= at every point of the domain."""
    sign = question.key("relation")
    lhs, rhs = question.formula("lhs", side="both"), question.formula("rhs", side="both")
    tape, chart = question.tape, question.chart
    small, large = (lhs, rhs) if sign in ("<", "<=") else (rhs, lhs)
    gap = chart.pull(tape.minus(question.load(large), question.load(small)))
    if tape.is_complex(gap):
        raise InputError("complex values can't be compared", "key 'relation'")
    region = question.region(lhs, rhs)
    return _decided(question, gap, region, strict=sign in ("<", ">"))


def _decided(question: Question, gap: Node, region: Region, *, strict: bool) -> Outcome:
    """Is the gap positive (or, not `strict`, nowhere negative)?"""
    tape, budget = question.tape, question.budget
    rng = random.Random(question.seed)
    question.decide([Residual("0", tape.zero)], region)  # raises where the domain is empty
    try:
        seen = first_points(tape, gap, region, rng, budget.share(0.3))
    except Unsupported as reason:
        return Outcome("undecided", note=str(reason))
    if not seen:
        return Outcome("undecided", note="no point of the domain could be evaluated")
    below = next((sample for sample in seen if is_below(tape, gap, sample, strict=strict)), None)
    if below is None and question.method != "numeric":
        proved = _proved(question, gap, region, strict=strict)
        if proved is not None:
            return replace(proved, numeric=_evidence(gap, seen))
    if below is None:
        with contextlib.suppress(BudgetExceeded):
            below = point_below(tape, gap, region, seen, rng, budget.share(0.5), strict=strict)
    if below is not None:
        witness = Witness.of(tape, below, below.balls[gap])
        value = witness.value if below.balls[gap] < 0 else "0"
        return Outcome(
            "refuted",
            "ball at 64 bits",
            numeric=_evidence(gap, [below]),
            witness=witness.as_table(),
            detail={"difference": value},
        )
    method = "sampling" if question.method == "numeric" else "balls at points"
    return Outcome("supported", method, numeric=_evidence(gap, seen), note="no sign was found for the difference")


def _proved(question: Question, gap: Node, region: Region, *, strict: bool) -> Outcome | None:
    tape, budget = question.tape, question.budget
    if positive_by_signs(tape, gap, region, budget, strict=strict):
        step = {"positive": question.show(gap), "argument": "the signs of the factors of its normal form"}
        return Outcome("proved", "signs of factors", arguments=(step,))
    if positive_at_whole_numbers(tape, gap, strict=strict):
        argument = "a polynomial in a whole number, tried within the bound of its roots; its leading term beyond"
        return Outcome("proved", "whole numbers", arguments=({"positive": question.show(gap), "argument": argument},))
    split: Sequence[Node] = ()
    with contextlib.suppress(BudgetExceeded):
        split = positive_by_cases(tape, gap, region, budget.share(0.2), strict=strict)
    if split:
        named = ", ".join(question.show(n) for n in split)
        argument = f"the signs of the factors of its normal form, in each case of the signs of {named}"
        return Outcome(
            "proved", "signs of factors", arguments=({"positive": question.show(gap), "argument": argument},)
        )
    along = None
    with contextlib.suppress(BudgetExceeded, Unsupported):
        along = positive_by_slopes(tape, gap, region, budget.share(0.3), strict=strict)
    if along is not None:
        step = {
            "positive": question.show(gap),
            "argument": f"its slope along {tape.symbol_at(along)}, from a place where it isn't negative",
        }
        return Outcome("proved", "signs of slopes", arguments=(step,))
    boxes = None
    with contextlib.suppress(BudgetExceeded):
        boxes = positive_by_boxes(tape, gap, region, budget.share(0.4), strict=strict)
    if boxes is None:
        return None
    argument = "its ball is positive on each box of a cover"
    step = {"positive": question.show(gap), "argument": argument, "boxes": boxes}
    return Outcome("proved", f"cover by {boxes} boxes", arguments=(step,))


def _evidence(gap: Node, seen: Sequence[Sample]) -> Evidence:
    """The smallest difference that was seen, with its rounding bound."""
    ball = min((sample.balls[gap] for sample in seen), key=lambda ball: float(ball.mid()))
    return Evidence(len(seen), float(ball.mid()), float(ball.rad()), 64)


KINDS = {"inequality": inequality}
