"""Extremals of a functional: by the first variation, and their kind by the second.

Of ∫ L(q, v, t) dt along q(t) + ε η(t), with η zero at the ends, the second variation is ∫ (η' P η' + η S η) dt with
P = ∂²L/∂v², S = ∂²L/∂q² − d/dt ∂²L/∂q∂v, where the last is symmetric (Gelfand & Fomin, Calculus of Variations, ch. 5).
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TYPE_CHECKING, Any

from canon.budget import BudgetExceeded
from canon.claims.along_a_range import (
    Range,
    Unproved,
    functions_exist,
    holds,
    is_positive,
    range_of,
    stays_in_domain,
)
from canon.claims.determinant import determinant
from canon.claims.idle_keys import none_idle
from canon.claims.jacobi_fields import Accessory, Fields, as_claimed, classified_by_fields
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.velocities import Motion, motion, velocity_names
from canon.decide.answer import Witness
from canon.decide.ball_quadrature import BITS, FAILURES, enclosed
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import evaluate, precision
from canon.decide.region import Region, Requirement
from canon.decide.sample import ball_point
from canon.decide.search import samples
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question

Matrix = Sequence[Sequence[Node]]
WORDS = ("minimum", "maximum", "neither")
WAVES, POINTS = 3, 6


def stationary(question: Question) -> Outcome:
    """`stationary`: `path` makes the integral of L over time, `from` to `to`, stationary, and a minimum or not.

    Lagrange's equations hold along the path. With `extremum`, the second variation is positive ("minimum") or negative
    ("maximum") for all variations but 0 that vanish near the ends, or takes both signs ("neither"). Shown by
    Legendre's condition and, where S has no sign, by Jacobi's: of `field`, a solution of −(P u')' + S u = 0, or one for
    each coordinate, the determinant has no zero inside, or one has two zeros `conjugate` (Gelfand & Fomin, §§ 25–29).
    """
    word = question.key("extremum")
    if word is not None and word not in WORDS:
        raise InputError(f"one of {', '.join(WORDS)} is expected, not {word!r}", "key 'extremum'")
    if word is None:
        none_idle(question, "an 'extremum'", "field", "conjugate")
    if question.key("field") is None:
        none_idle(question, "a 'field'", "conjugate")
    L, path = question.formula("L"), question.formulas("path", question.space.n)
    fields, jets = question.key("field"), motion(question)
    _are_of_time(question, path)
    images = _along(question, jets, path)
    try:
        span = _span(question, L, path, jets, images)
    except Unproved as reason:
        return Outcome("undecided", note=str(reason))
    left = [substitute(question.tape, jets.expression(question.load(L), i), images) for i in range(len(jets.q))]
    residuals = [Residual(f"equation of {q}", node, node) for q, node in zip(question.space.q, left, strict=True)]
    first = question.decide(residuals, Region((*span.inside.requirements, *span.demanded), span.inside.surface, ()))
    missing = [r for r in span.demanded if not holds(question, r, span.inside, span)]
    if missing and (word is not None or first.status == "refuted" or question.method != "numeric"):
        note = f"it isn't shown that {missing[0].text} all along the path"
        refuted = first.status == "refuted"  # at a point of the names for which there may be no integral
        return Outcome("undecided", first.method, note=note) if refuted else first.with_status("undecided", note)
    if word is None or first.status == "refuted":
        return first
    if any(question.tape.is_complex(node) for node in (question.load(L), *images.values())):
        raise InputError("an extremum is one of real numbers: L or its path is complex", "key 'extremum'")
    second = _second(question, span, jets, question.load(L), images)
    return combined([first, _extremum(question, span, second, word, fields)])


def _are_of_time(question: Question, path: Sequence[Formula]) -> None:
    """**Raises** `InputError` where the path, a field or an end contains what moves."""
    moving = {*question.space.old, *velocity_names(question, "velocities")}
    ends = (question.key(word) for word in ("from", "to"))
    for key, given in (
        ("path", path),
        ("field", (component for row in question.key("field") or () for component in row)),
        ("conjugate", question.key("conjugate") or ()),
        ("to", (end for end in ends if isinstance(end, Formula))),
    ):
        for symbol in sorted({s for formula in given for s in formula.symbols & moving}, key=str):
            raise InputError(f"a path is a function of {question.space.t}, not of {symbol}", f"key {key!r}")


def _along(question: Question, jets: Motion, path: Sequence[Formula]) -> dict[Node, Node]:
    """Coordinates, velocities and accelerations as functions of time."""
    tape, images = question.tape, dict[Node, Node]()
    for q, v, a, formula in zip(jets.q, jets.v, jets.a, path, strict=True):
        node = question.load(formula)
        images[q] = node
        images[v] = derivative(tape, node, jets.t)
        images[a] = derivative(tape, images[v], jets.t)
    return images


def _span(question: Question, L: Formula, path: Sequence[Formula], jets: Motion, images: Mapping[Node, Node]) -> Range:
    """Time between the ends, with what the functional demands along the path."""
    formulas = (*path, *_optional(question))
    span = range_of(question, question.space.t, question.key("from"), question.key("to"), formulas)
    moving = {*jets.q, *jets.v}
    asked = [r for r in span.others.requirements if any(moving & question.tape.support(n) for n in r.nodes)]
    others = replace(span.others, requirements=tuple(r for r in span.others.requirements if r not in asked))
    inside = replace(span.inside, requirements=tuple(r for r in span.inside.requirements if r not in asked))
    span = replace(span, others=others, inside=inside)
    there = [_on_path(question, r, images) for r in asked]
    stays_in_domain(question, span, there, formulas)
    own = Region.of(question.tape, replace(question.subject.domain, conditions=L.conditions, surface=()))
    pulled = [_on_path(question, r, images) for r in (*span.demanded, *own.requirements)]
    known = {(r.kind, r.nodes) for r in (*span.inside.requirements, *pulled, *there)}
    for r in question.region(L, images=images).requirements:  # what is assumed of the names that the path replaces
        if (r.kind, r.nodes) not in known and not holds(question, r, span.inside, span):
            raise Unproved(f"it isn't shown that {r.text} all along the path")
    functions_exist(question, span, (*pulled, *there))
    return replace(span, demanded=(*pulled, *there))


def _on_path(question: Question, r: Requirement, images: Mapping[Node, Node]) -> Requirement:
    return replace(r, nodes=tuple(substitute(question.tape, n, images) for n in r.nodes), note=" (along the path)")


def _optional(question: Question) -> tuple[Formula, ...]:
    fields, conjugate = question.key("field"), question.key("conjugate")
    return (*(component for row in fields or () for component in row), *(conjugate or ()))


@dataclass(frozen=True)
class Second:
    """P and S along the path, and the mixed and plain second derivatives of L by coordinates."""

    P: Matrix
    S: Matrix
    R: Matrix
    Q: Matrix


def _second(question: Question, span: Range, jets: Motion, L: Node, images: Mapping[Node, Node]) -> Second:
    tape = question.tape

    def slopes(first: Sequence[Node], other: Sequence[Node]) -> Matrix:
        return [[substitute(tape, derivative(tape, derivative(tape, L, x), y), images) for y in other] for x in first]

    P, R, Q = slopes(jets.v, jets.v), slopes(jets.q, jets.v), slopes(jets.q, jets.q)
    S = [
        [tape.minus(a, derivative(tape, b, jets.t)) for a, b in zip(row, mixed, strict=True)]
        for row, mixed in zip(Q, R, strict=True)
    ]
    return Second(P, S, R, Q)


def _extremum(question: Question, span: Range, second: Second, word: str, fields: Fields | None) -> Outcome:
    """The kind of the extremal."""
    tape, note = question.tape, ""
    if question.method != "numeric":
        try:
            for requirement in span.demanded:
                if not holds(question, requirement, span.inside, span):
                    raise Unproved(f"it isn't shown that {requirement.text} all along the range")
            known = (*span.inside.requirements, *span.demanded)
            span = replace(span, inside=replace(span.inside, requirements=known))
            found, steps = _classified(question, span, second, fields)
            shown = (
                {"P": question.show(second.P[0][0]), "S": question.show(second.S[0][0])} if len(second.P) == 1 else {}
            )
            if found == word:
                (point,) = (question.decide([Residual("0", tape.zero)], span.others),)
                return Outcome("proved", "second variation", numeric=point.numeric, arguments=steps, detail=shown)
            return question.refuted_exactly(span.others, "the second variation", extremum=found, **shown)
        except Unproved as reason:
            note = str(reason)
        except BudgetExceeded:
            note = "the budget is spent"
    trial = _trials(question, span, second, word)
    return replace(trial, note="; ".join(part for part in (note, trial.note) if part))


def _classified(
    question: Question, span: Range, second: Second, fields: Fields | None
) -> tuple[str, tuple[dict[str, Any], ...]]:
    """The kind of extremal for all values of the parameters. **Raises:** `Unproved`."""
    tape = question.tape
    for sign, word in ((1, "minimum"), (-1, "maximum")):
        P, S = ([[tape.scaled(x, sign) for x in row] for row in matrix] for matrix in (second.P, second.S))
        if not _definite(question, P, span, strict=True):
            continue
        legendre = {"theorem": "Legendre's condition", "positive": question.show(P[0][0])}
        R, Q = ([[tape.scaled(x, sign) for x in row] for row in matrix] for matrix in (second.R, second.Q))
        accessory = Accessory(P, R, Q)
        if _symmetric(question, second.R, span) and _definite(question, S, span, strict=False):
            if fields is not None:
                as_claimed(question, span, accessory, fields)
            return word, (
                legendre,
                {"theorem": "the second variation is a sum of squares", "S": question.show(S[0][0])},
            )
        if fields is None:
            raise Unproved("S has no sign that is known along the path: give solutions `field` of Jacobi's equation")
        definite, step = classified_by_fields(question, span, accessory, fields)
        return word if definite else "neither", (legendre, step)
    raise Unproved("∂²L/∂v² isn't shown to be definite along the path")


def _symmetric(question: Question, R: Matrix, span: Range) -> bool:
    pairs = combinations(range(len(R)), 2)
    residuals = [Residual("R", question.tape.minus(R[i][j], R[j][i])) for i, j in pairs]
    return not residuals or question.decide(residuals, span.inside).status == "proved"


def _definite(question: Question, matrix: Matrix, span: Range, *, strict: bool) -> bool:
    """Positive definite by its leading minors, or semidefinite by all principal ones, all along the range."""
    tape, n = question.tape, len(matrix)
    chosen = [tuple(range(k)) for k in range(1, n + 1)]
    if not strict:
        chosen = [c for k in range(1, n + 1) for c in combinations(range(n), k)]
    for rows in chosen:
        minor = determinant(tape, [[matrix[i][j] for j in rows] for i in rows])
        if not strict and question.decide([Residual("minor", minor)], span.inside).status == "proved":
            continue
        if not is_positive(question, minor, span.inside, strict=strict):
            return False
    return True


def _trials(question: Question, span: Range, second: Second, word: str) -> Outcome:
    """Waves between the ends as variations, at points of the parameters: a wrong sign of one of them refutes."""
    tape, t = question.tape, question.tape.symbol(span.x)
    if isinstance(span.low, str) or isinstance(span.high, str):
        return Outcome("undecided", note="no variations were tried over an infinite range")
    if tape.functions_of([node for matrix in (second.P, second.R, second.Q) for row in matrix for node in row]):
        return Outcome("undecided", note="no variations were tried with arbitrary functions")
    low, high = question.load(span.low), question.load(span.high)
    phase = tape.times(tape.constant("pi"), tape.minus(t, low), tape.power(tape.minus(high, low), -1))
    waves = [tape.call("sin", tape.scaled(phase, k)) for k in range(1, WAVES + 1)]
    forms = []
    for i in range(len(second.P)):
        for k, wave in enumerate(waves, 1):
            slope = derivative(tape, wave, t)
            terms = ((second.P[i][i], slope, slope), (second.R[i][i], wave, slope), (second.R[i][i], wave, slope))
            total = tape.plus(*(tape.times(*term) for term in terms), tape.times(second.Q[i][i], wave, wave))
            forms.append((f"{question.space.q[i]} by sin({k}*pi*(t - from)/(to - from))", total))
    names = sorted(set().union(*(tape.support(n) for n in (low, high, *(f for _, f in forms)))) - {t})
    order, least, count, signs = tape.reach([low, high]), None, 0, set[int]()
    rng = random.Random(question.seed)
    try:
        budget = question.budget.share(0.6)
        for place in samples(
            tape, names or [tape.zero], span.others, rng, count=POINTS, tries=20, budget=budget, nice=True
        ):
            with precision(BITS):
                at = ball_point(place.point, place.solved)
                balls = evaluate(tape, order, at, place.functions)
                values = [
                    (said, enclosed(tape, form, t, (balls[low], balls[high]), at, place.functions))
                    for said, form in forms
                ]
            count += 1
            here = {1 if v > 0 else -1 for _, v in values if v is not None and not v.contains(0)}
            signs |= here
            wrong = -1 if word == "minimum" else 1
            for said, value in values:
                if word != "neither" and value is not None and wrong * value > 0:
                    witness = Witness.of(tape, place, value).as_table()
                    evidence = Evidence(1, float(abs(value.mid())), float(value.rad()), BITS)
                    detail = {"variation": said, "second variation": value.str(12, radius=False)}
                    return Outcome("refuted", "a variation", witness=witness, numeric=evidence, detail=detail)
                if value is not None and (least is None or abs(value.mid()) < abs(least.mid())):
                    least = value
            if not names:
                break
    except (*FAILURES, BudgetExceeded):
        pass
    if least is None:
        return Outcome("undecided", note="no second variation could be enclosed")
    evidence = Evidence(count, float(abs(least.mid())), float(least.rad()), BITS)
    if word == "neither":
        status = "supported" if signs == {1, -1} else "undecided"
        return Outcome(status, "variations", numeric=evidence, note=f"variations of {len(signs)} sign(s) were found")
    if not signs:
        return Outcome("undecided", "variations", numeric=evidence, note="no variation that was tried has a sign")
    return Outcome("supported", "variations", numeric=evidence, note="all variations tried have the right sign")


KINDS = {"stationary": stationary}
