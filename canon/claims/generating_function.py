"""Generating functions: the maps that they define, and the maps that they generate. Nothing is solved.

With the mixed coordinates u = (a, b), a old and b new in each degree of freedom, both (q, p) and (Q, P) are explicit
functions of u, and dF is, up to signs, the difference of the canonical one-forms. Its closedness is the equality of
mixed partial derivatives, so the map is canonical with scale 1 wherever u are coordinates of it: where the mixed
Hessian ∂²F/∂a∂b is not singular (Goldstein, Poole and Safko 2002, section 9.1; Arnold 1989, section 48).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from canon.claims.outcome import Outcome, Residual, combined, exact
from canon.decide.derivative import derivative
from canon.decide.region import Region
from canon.decide.tape import Node
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.expression import Formula
    from canon.mechanics import GeneratingFunction

BY_THEOREM = "theorem on generating functions"
THEOREM = "the map of a generating function is canonical with scale 1 where the mixed Hessian is not singular"


def hessian_outcome(question: Question, *formulas: Formula, solving: bool = True) -> Outcome:
    """The mixed Hessian is not singular everywhere; if it is: refuted by an exact argument.

    Numerically the map's equations are solved besides (unless `solving` is False), and its Jacobian looked at.
    """
    node = question.chart.hessian
    assert node is not None
    outcome = hessian_outcome_of(question, node, question.region(*formulas, regular=False))
    if question.method == "numeric" and outcome.status == "supported" and solving:
        return _solved(question, outcome)
    return outcome


def _solved(question: Question, outcome: Outcome) -> Outcome:
    """The outcome with the evidence on the map as it is solved for; an alarm where that denies the theorem."""
    from canon.claims.agreement import ALARM
    from canon.claims.implicit_evidence import solved_numerically

    found = solved_numerically(question)
    if found is None:
        return outcome
    outcome = replace(outcome, numeric=found.evidence).with_detail(solved=found.words)
    return outcome if found.holds else outcome.with_status("undecided").with_detail(alarm=ALARM)


def hessian_outcome_of(question: Question, node: Node, region: Region) -> Outcome:
    """The same of a determinant already built."""
    answer = question.not_identically_zero(node, region)
    shown = question.show(node, shorten=False)
    if answer.status == "proved":
        point = answer.witness.as_table() if answer.witness else {}
        step = {"theorem": THEOREM, "mixed Hessian": shown, "is not 0 at": point}
        detail = {"mixed_hessian": shown, "scale": "1"}
        status = "supported" if question.method == "numeric" else "proved"
        return Outcome(status, method=BY_THEOREM, arguments=(step,), detail=detail)
    if answer.status == "refuted":
        singular = exact("refuted", "the mixed Hessian is identically zero: F defines no map", mixed_hessian="0")
        return replace(singular, numeric=answer.numeric, everywhere=True)
    note = f"is the mixed Hessian {shown} identically zero? {answer.note}"
    return Outcome("undecided", method=answer.method, note=note)


def canonical_of_generating_function(question: Question, scale: Formula | None) -> Outcome:
    """`canonical` where a generating function alone is given: its map has scale 1 where it is defined."""
    question.square_map()
    formulas = (scale,) if scale else ()
    outcome = hessian_outcome(question, *formulas)
    if outcome.status == "refuted" or scale is None:
        return outcome
    residual = Residual("scale - 1", question.tape.minus(question.load(scale), question.tape.one))
    return combined([outcome, question.decide([residual], question.region(*formulas))]).with_detail(scale="1")


def generates(question: Question) -> Outcome:
    """`generates`: the file's generating function generates the explicit transformation."""
    generating = question.subject.generating_function
    if generating is None:
        raise InputError("a claim of kind 'generates' needs a generating function")
    if question.subject.transformation is None:
        raise InputError("a claim of kind 'generates' needs an explicit transformation")
    question.square_map()
    return generated(question, generating)


def generating_function(question: Question) -> Outcome:
    """`generating_function`: F is a generating function of the transformation, up to a function of time."""
    from canon.mechanics import GeneratingFunction

    kind = question.key("type")
    if kind is None:
        raise InputError("a claim of kind 'generating_function' needs the key 'type'")
    question.square_map()
    kind = kind if isinstance(kind, int) else tuple(kind)
    try:
        claimed = GeneratingFunction(question.space, kind, question.formula("F", "both"))
    except InputError as error:
        place = "key 'F'" if error.where.endswith("F") else "key 'type'"
        raise InputError(error.message, place) from error
    return generated(question, claimed)


def generated(question: Question, generating: GeneratingFunction) -> Outcome:
    """Do the equations of a generating function hold along the map?

    They make the map's graph the one that F defines: on an open set of it the mixed variables are then
    coordinates, so that the mixed Hessian can't be singular.
    """
    region = question.region(generating.F)
    return question.decide(equations(question, generating), region).with_detail(type=generating.type)


def equations(question: Question, generating: GeneratingFunction) -> Iterator[Residual]:
    """Each equation of F, such as p − ∂F/∂q, along the map."""
    tape, chart = question.tape, question.chart
    F = question.load(generating.F)
    old_signs, new_signs = generating.signs()
    names = (*generating.old_conjugates, *generating.new_conjugates)
    for name, variable, sign in zip(names, generating.mixed, (*old_signs, *new_signs), strict=True):
        slope = tape.scaled(derivative(tape, F, tape.symbol(variable)), sign)
        along = chart.pull(slope)
        value = chart.pull(tape.symbol(name))
        word = "" if sign == 1 else "-"
        yield Residual(f"{name} = {word}dF/d{variable}", tape.minus(value, along), along)


KINDS = {"generates": generates, "generating_function": generating_function}
