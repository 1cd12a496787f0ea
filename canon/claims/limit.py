"""Limits: of a formula as one of its names tends to a value or to infinity, all others held fixed."""

from __future__ import annotations

import contextlib
import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal

import sympy as sp
from flint import arb

from canon.budget import BudgetExceeded
from canon.claims.approach import Approach, Limit, approaching, limit_of
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.show import with_value
from canon.decide import ladder
from canon.decide.derivative import substitute
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.power_series import Unexpanded
from canon.decide.sample import ball_point
from canon.decide.search import samples
from canon.decide.special_values import at_special_values
from canon.decide.tape import Node, Unsupported
from canon.errors import InputError
from canon.expression import Formula
from canon.sign import declared
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question

NEAR = (((8, 16, 24, 32), 128, 1), ((2, 4, 6, 8), 2048, 8))
"""Distances 2^−k from the limit, bits to look with, and how often a difference must be halved from each to the next.

The second where the balls of the first are wide, as of exponentials that nearly cancel: these fall fast.
"""

POINTS = 6
ROUNDING = 2.0**-90
"""Differences below this, in 128 bits, need not shrink any more."""


def limit(question: Question) -> Outcome:
    """`limit`: f tends to `equals` as `variable` tends to `to`, from above and from below, or from one `side` alone.

    With x = `to` ± s, or 1/s for an infinity, f is expanded in powers of s (also fractional ones), exactly: f tends to
    the coefficient of s⁰ where none of a lower power is left, and grows beyond all bounds otherwise.
    """
    f, to, equals = question.formula("f"), question.key("to"), question.key("equals")
    x: sp.Symbol = question.key("variable")
    if declared(x).get("integer") and not isinstance(to, str):
        raise InputError(f"{x} is an integer: it can tend to an infinity alone", "key 'to'")
    for word, value in (("to", to), ("equals", equals)):
        if isinstance(value, Formula) and x in value.symbols:
            raise InputError(f"{x} tends to its limit: it can't be in it", f"key {word!r}")
    if isinstance(equals, str) and question.tape.is_complex(question.load(f)):
        raise InputError(f"{f} is complex: {equals} is a limit of real numbers", "key 'equals'")
    outcomes = []
    for side in _sides(question, to):
        approach = approaching(question, x, to, side, (f, *(e for e in (to, equals) if isinstance(e, Formula))))
        outcomes.append(_from_one_side(question, approach, question.load(f), equals))
    return combined(outcomes)


def _sides(question: Question, to: Formula | str) -> Sequence[int]:
    side = question.key("side")
    if isinstance(to, str):
        if side is not None:
            raise InputError("an infinity is reached from one side only: leave 'side' out", "key 'side'")
        return (1,) if to == "infinity" else (-1,)
    return {"+": (1,), "-": (-1,), None: (1, -1)}[side]


def _from_one_side(question: Question, approach: Approach, node: Node, equals: Formula | str) -> Outcome:
    if question.method == "numeric":
        return _near(question, approach, node, equals)
    try:
        also = () if isinstance(equals, str) else (question.load(equals),)
        found = limit_of(question, approach, node, also)
    except (Unexpanded, Unsupported, BudgetExceeded) as reason:
        refuted = _at_points(question, approach, node, equals)
        return refuted or _near(question, approach, node, equals).with_detail(
            approach=approach.words, reason=str(reason)
        )
    theorem = f"the asymptotic expansion in powers of s for {approach.words}, coefficient by coefficient"
    if found.value is None:
        if isinstance(equals, str) and not found.infinite:  # its sign depends on the other names
            refuted = _at_points(question, approach, node, equals)
            if refuted is not None:
                return refuted
        return _infinite(question, approach, found, equals, theorem)
    value = question.show(found.value)
    if isinstance(equals, str):
        return question.refuted_exactly(approach.region, theorem, approach=approach.words, limit=value)
    residual = question.tape.minus(found.value, question.load(equals))
    outcome = question.decide([Residual(f"limit for {approach.words}", residual, found.value)], approach.region)
    steps = (*outcome.arguments, {"theorem": theorem, "limit": value})
    outcome = replace(outcome, arguments=steps) if outcome.status == "proved" else outcome
    return with_value(question, outcome).with_detail(limit=value)


def _at_points(question: Question, approach: Approach, node: Node, equals: Formula | str) -> Outcome | None:
    """A refutation by the limit at a point of the other names, where they have no signs of their own."""
    tape, places = question.tape, []
    other = tape.zero if isinstance(equals, str) else question.load(equals)
    names = sorted((tape.support(node) | tape.support(other)) - {approach.x})
    with contextlib.suppress(Unsupported, BudgetExceeded):
        rng, budget = random.Random(question.seed), question.budget.share(0.3)
        places += at_special_values(tape, names, names, approach.region, random.Random(question.seed), budget)
        places += samples(tape, names, approach.region, rng, count=POINTS, tries=20, budget=budget)
    for place in places:
        fixed = {n: tape.number(v) for n, v in place.point.items() if isinstance(v, Fraction)}
        if place.functions or not set(names) <= {*fixed}:
            continue
        moved = approach.at(tape, fixed)
        try:
            found = limit_of(question, moved, substitute(tape, node, fixed))
        except (Unexpanded, Unsupported, BudgetExceeded, InputError):
            continue
        if found.value is None and not found.infinite:
            continue  # a number that may be 0 is the leading coefficient
        claimed = equals if isinstance(equals, str) else substitute(tape, other, fixed)
        wrong = (
            found.infinite != (1 if equals == "infinity" else -1) if isinstance(equals, str) else found.value is None
        )
        if found.value is not None and not isinstance(claimed, str):
            residual = tape.minus(found.value, claimed)
            (answer,) = ladder.vanish(tape, [residual], moved.region, budget=question.budget, seed=question.seed)
            wrong = answer.status == "refuted"
        if wrong:
            value = "infinite" if found.value is None else question.show(found.value)
            table = {str(tape.symbol_at(n)): str(tape.value(v)) for n, v in fixed.items()}
            return Outcome("refuted", "expansion at a point", witness=table, detail={"limit": value})
    return None


def _infinite(question: Question, approach: Approach, found: Limit, equals: Formula | str, theorem: str) -> Outcome:
    assert found.leading is not None
    said = "infinity" if found.infinite > 0 else "-infinity"
    growth = f"{question.show(found.leading)} * s**({found.order})"
    if not found.infinite:
        answer = question.not_identically_zero(found.leading, approach.region)
        if isinstance(equals, str) or answer.status != "proved" or answer.witness is None:
            return Outcome("undecided", note=f"the leading term {growth} has no sign")
        detail = {"approach": approach.words, "limit": "none", "leading": growth}
        return Outcome(
            "refuted", "leading term", witness=answer.witness.as_table(), numeric=answer.numeric, detail=detail
        )
    if equals != said:
        return question.refuted_exactly(approach.region, theorem, approach=approach.words, limit=said, leading=growth)
    (point,) = ladder.vanish(
        question.tape, [question.tape.zero], approach.region, budget=question.budget, seed=question.seed
    )
    step = {"theorem": theorem, "leading": growth, "limit": said}
    return Outcome("proved", "leading term", numeric=point.numeric, arguments=(step,), detail={"leading": growth})


def _near(question: Question, approach: Approach, node: Node, equals: Formula | str) -> Outcome:
    """Numbers ever nearer to the limit: supported where they approach it, else undecided."""
    found = Outcome("undecided", note="no value near the limit could be evaluated")
    for exponents, bits, halvings in NEAR:
        rows = _rows(question, approach, node, equals, exponents, bits)
        if not rows or not all(ball.is_finite() for row in rows for ball in row):
            continue
        if isinstance(equals, str):
            settled = all(_grows([ball if equals == "infinity" else -ball for ball in row]) for row in rows)
            evidence = Evidence(len(rows), 0.0, 0.0, bits)
        else:
            settled = all(_shrinks(row, halvings) for row in rows)
            last = max((row[-1] for row in rows), key=lambda ball: float(abs(ball.mid())))
            evidence = Evidence(len(rows), float(abs(last.mid())), float(last.rad()), bits)
        note = "no expansion was found; the values near the limit " + ("approach it" if settled else "don't settle it")
        status: Literal["supported", "undecided"] = "supported" if settled else "undecided"
        found = Outcome(status, "values near the limit", numeric=evidence, note=note)
        if all(ball.rad() <= max(ball.abs_lower(), ROUNDING) for row in rows for ball in row):
            break
    return found


def _rows(
    question: Question, approach: Approach, node: Node, equals: Formula | str, exponents: Sequence[int], bits: int
) -> list[list[Any]]:
    """At a few points, the differences from the limit (from 0, of an infinite one) at the distances 2^−k."""
    tape = question.tape
    target = substitute(tape, node, {approach.x: approach.image})
    other = tape.zero if isinstance(equals, str) else question.load(equals)
    near = [n for r in approach.near for n in r.nodes]
    order = tape.reach([target, other, *near])
    names = sorted(set().union(*(tape.support(n) for n in (target, *near))) - {approach.s})
    rows = []
    try:
        for place in samples(
            tape, [other, *names], approach.region, random.Random(question.seed), count=POINTS, tries=20,
            budget=question.budget.share(0.5),
        ):  # fmt: skip
            with precision(bits):
                at = ball_point(place.point, place.solved)
                row = []
                for k in exponents:
                    balls = evaluate(tape, order, {**at, approach.s: arb(2) ** -k}, place.functions)
                    row.append(balls[target] - balls[other])
            rows.append(row)
    except (Unsupported, OutOfDomain, ZeroDivisionError, OverflowError, BudgetExceeded):
        return []
    return rows


def _shrinks(row: Sequence[Any], halvings: int) -> bool:
    """Whether differences fall at each step, by their upper bounds: a ball that holds any value says nothing."""
    return all(b.abs_upper() <= max(a.abs_upper() / 2**halvings, ROUNDING) for a, b in pairwise(row))


def _grows(row: Sequence[Any]) -> bool:
    """Whether values grow, each time by half of what they grew before at least, as logarithms of logarithms do."""
    gained = [b.lower() - a.upper() for a, b in pairwise(row)]
    return all(gain > 0 for gain in gained) and all(later > first / 2 for first, later in pairwise(gained))


KINDS = {"limit": limit}
