"""Definite integrals: by an antiderivative that is verified, or enclosed at points of the other names."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from itertools import chain
from typing import TYPE_CHECKING, Any

from canon.budget import Budget, BudgetExceeded
from canon.claims.along_a_range import Range, Unproved, holds
from canon.claims.approach import Limit, approaching, limit_of
from canon.claims.outcome import Outcome, Residual
from canon.claims.to_infinity import over_infinity
from canon.decide.answer import Witness
from canon.decide.ball_quadrature import BITS, FAILURES, enclosed
from canon.decide.derivative import derivative
from canon.decide.enclosure import evaluate, excludes_zero, precision
from canon.decide.power_series import Unexpanded
from canon.decide.region import Region, Requirement
from canon.decide.sample import ball_point
from canon.decide.search import samples
from canon.decide.special_values import at_special_values
from canon.decide.tape import Node, Tape, Unsupported
from canon.domain import Domain, conditions_of
from canon.errors import InputError
from canon.expression import Formula
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question

POINTS = 8
COARSEST = 1e-6
"""The relative error above which an enclosure supports nothing."""


def exact_value(question: Question, span: Range, f: Node, F: Formula) -> tuple[Limit, Limit, Outcome]:
    """F's limits at both ends of the range, and that its derivative is f all along it.

    **Raises:** `Unproved` where F isn't shown to be smooth inside the range or has no known limit; `InputError` where
    its derivative is another function.
    """
    tape, x = question.tape, question.tape.symbol(span.x)
    own = Region.of(tape, replace(question.subject.domain, conditions=F.conditions, surface=()))
    moving = [r for r in own.requirements if any(x in tape.support(n) for n in r.nodes)]
    for requirement in (*span.demanded, *moving):
        if not holds(question, requirement, span.inside, span):
            raise Unproved(f"it isn't shown that {requirement.text} all along the range")
    still = [r for r in own.requirements if r not in moving]
    for requirement in still:
        if not holds(question, requirement, span.others):
            raise Unproved(f"the antiderivative needs {requirement.text}")
    node = question.load(F)
    rest = Residual("derivative of the antiderivative", tape.minus(derivative(tape, node, x), f))
    outcome = question.decide([rest], span.inside)
    if outcome.status == "refuted":
        raise InputError(
            f"the derivative of {F} is another function: {outcome.detail.get('residual', '')} off",
            "key 'antiderivative'",
        )
    if outcome.status != "proved":
        raise Unproved("the antiderivative's derivative was not shown to be the integrand")
    ends = []
    for end, side in ((span.low, 1), (span.high, -1)):
        place = 1 if end == "infinity" else -1 if end == "-infinity" else side
        try:
            near = approaching(question, span.x, end, place, (F,))
            near = replace(near, region=near.region.also(*span.others.requirements))
            ends.append(limit_of(question, near, node, (node, f)))
        except (Unexpanded, Unsupported, InputError) as reason:
            raise Unproved(f"the antiderivative's limit at {end} was not found: {reason}") from None
    return ends[0], ends[1], outcome


def _unseen(question: Question, span: Range, f: Node) -> Requirement | None:
    """What is demanded along the range, isn't shown there, and has gone from the integrand, as u > 0 from √u².

    At points of the other names where it fails there is no integral; a quadrature of what is left has a value all the
    same.
    """
    tape = question.tape
    met = {_unscaled(tape, r) for r in Region.of(tape, Domain(conditions_of(tape.to_sympy(f)))).requirements}
    for requirement in span.demanded:
        if _unscaled(tape, requirement) not in met and not holds(question, requirement, span.inside, span):
            return requirement
    return None


def _unscaled(tape: Tape, r: Requirement) -> tuple[str, tuple[Node, ...]]:
    """The condition's kind and nodes, sums without a common factor: 4 − 4u² > 0 says what 1 − u² > 0 does."""
    nodes = []
    for node in r.nodes:
        kind, *parts = tape.ops[node]
        if kind == "+" and parts[1]:
            first = Fraction(parts[1][0][1])
            factor = first if r.kind == "nonzero" else abs(first)
            node = tape.add([(inner, c / factor) for inner, c in parts[1]], parts[0] / factor)
        nodes.append(node)
    return r.kind, tuple(nodes)


def at_points(question: Question, span: Range, f: Node, equals: Node, budget: Budget) -> Outcome:
    """The integral enclosed at points of the other names: refuted by one of them, else supported."""
    tape = question.tape
    if tape.functions_of([f, equals]):
        return Outcome("undecided", note="arbitrary functions have no quadrature")
    unseen = _unseen(question, span, f)
    if unseen is not None:
        return Outcome("undecided", note=f"it isn't shown that {unseen.text}, and no quadrature meets it")
    ends = [question.load(end) for end in (span.low, span.high) if not isinstance(end, str)]
    x = tape.symbol(span.x)
    names = sorted(set().union(*(tape.support(n) for n in (f, equals, *ends))) - {x})
    order = tape.reach([equals, *ends])
    infinite = isinstance(span.low, str) or isinstance(span.high, str)
    worst: list[Any] = []
    rng, open_places = random.Random(question.seed), 0
    targets = [*names, equals]
    special = at_special_values(tape, names, targets, span.others, random.Random(question.seed), budget)
    usual = samples(tape, targets, span.others, rng, count=POINTS, tries=20, budget=budget, nice=True)
    try:
        for place in chain(special, usual):
            with precision(BITS):
                at = ball_point(place.point, place.solved)
                balls = evaluate(tape, order, at, place.functions)
                if infinite:
                    value = over_infinity(question, span, f, at, place.point)
                else:
                    value = enclosed(tape, f, x, (balls[ends[0]], balls[ends[1]]), at, place.functions)
                if value is None:
                    open_places += 1
                    continue
                gap = value - balls[equals]
            if excludes_zero(gap):
                table = Witness.of(tape, place, gap).as_table()
                evidence = Evidence(1, float(abs(gap.mid())), float(gap.rad()), BITS)
                detail = {"value": value.str(15, radius=False), "residual": gap.str(12, radius=False)}
                return Outcome("refuted", "certified quadrature", witness=table, numeric=evidence, detail=detail)
            if gap.rad() < COARSEST * (1 + abs(value)):
                worst.append(gap)
            if not names:
                break
    except (*FAILURES, BudgetExceeded):
        pass
    if not worst:
        return Outcome("undecided", note="the integral could not be enclosed at any point")
    if open_places:  # it may diverge there
        return Outcome("undecided", note=f"at {open_places} points the integral could not be enclosed")
    gap = max(worst, key=lambda ball: float(abs(ball.mid()) + ball.rad()))
    evidence = Evidence(len(worst), float(abs(gap.mid())), float(gap.rad()), BITS)
    return Outcome("supported", "certified quadrature", numeric=evidence)
