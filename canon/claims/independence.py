"""Functional independence: a minor of the Jacobian that doesn't vanish identically on any component of the domain.

One point of full rank proves independence on its own component only. But if a minor f is made of rational functions,
sin, cos and exp, it is meromorphic on the connected Cᴺ, so that vanishing on any open set would be vanishing
everywhere. Square roots and absolute values of such expressions are let in as follows: if for each choice of signs
of the radicals the minor so changed is not identically zero, then neither is the product of all of them, which is
free of radicals up to sign and divisible by f; so f vanishes on no open set, whatever its branches there.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, islice
from math import comb
from typing import TYPE_CHECKING

from canon.claims.bracket import keys_domain, tensor_of
from canon.claims.determinant import determinant
from canon.claims.outcome import Outcome, combined, merged
from canon.claims.same_points import has_the_same_points
from canon.claims.scale import never_zero
from canon.claims.show import is_short
from canon.claims.special_parameters import not_zero_for_any_parameters
from canon.decide.derivative import derivative
from canon.decide.nowhere_zero import has_no_zero, nonzero_on_every_cell
from canon.decide.tape import Node, Tape
from canon.domain import Condition

if TYPE_CHECKING:
    from canon.claims.chart import Chart
    from canon.claims.question import Question
    from canon.decide.answer import Answer
    from canon.decide.region import Region

MOST_MINORS = 400
FEW_MINORS = 70
FEW_SLOW = 8
COMPONENTS = "an analytic function that is not zero at one point of a connected set vanishes on no open part of it"
THEOREM = "a meromorphic function on a connected domain that vanishes on an open set vanishes everywhere"


def independent(question: Question) -> Outcome:
    """`independent`: the functions are functionally independent almost everywhere."""
    functions = question.formulas("functions")
    tape = question.tape
    region = keys_domain(question, *functions)
    if question.key("tensor") is not None or question.key("structure") is not None:
        variables = question.nodes(tensor_of(question)[1])
    else:
        variables = question.nodes(question.space.old)
    nodes = [question.load(f) for f in functions]
    if len(nodes) > len(variables):
        return question.refuted_exactly(region, f"{len(nodes)} functions of {len(variables)} variables are dependent")
    rows = [[derivative(tape, f, x) for x in variables] for f in nodes]
    return full_rank(question, rows, variables, region, everywhere=True)


def full_rank(
    question: Question,
    rows: Sequence[Sequence[Node]],
    variables: Sequence[Node],
    region: Region,
    *,
    everywhere: bool,
    chart: Chart | None = None,
) -> Outcome:
    """Do the rows have full rank almost everywhere (`everywhere`), or at least at some point?"""
    tape, chart = question.tape, chart or question.chart
    size, width = len(rows), len(rows[0])
    minors = (
        (columns, determinant(tape, [[row[c] for c in columns] for row in rows]))
        for columns in combinations(range(width), size)
    )
    vanishing: list[Outcome] = []
    open_questions: list[str] = []
    fallback: Outcome | None = None
    nonzero: list[tuple[Node, str, Answer, Region, Sequence[Node] | None, Chart]] = []
    for columns, minor in islice(minors, MOST_MINORS):
        name = ", ".join(str(tape.symbol_at(variables[c])) for c in columns)
        if tape.value(minor) == 0:
            continue
        pulled = chart.pull(minor)
        answer = question.not_identically_zero(pulled, region)
        if answer.status == "refuted":
            step = {"minor": name, "is": "0", "method": answer.method}
            vanishing.append(Outcome("proved", numeric=answer.numeric, arguments=(step,)))
            continue
        if answer.status != "proved":
            open_questions.append(f"is the minor {name} identically zero?")
            continue
        found = minor, name, answer, region, variables if everywhere else None, chart
        ranked = _ranked(question, *found, quick=True)
        if ranked.status == "proved" or question.method == "numeric":
            return ranked
        nonzero.append(found)
    for found in nonzero[:FEW_SLOW]:
        ranked = _ranked(question, *found, quick=False)
        if ranked.status == "proved":
            return ranked
        fallback = fallback or ranked
        if question.budget.spent():
            break
    if fallback is not None:
        return _dependent_somewhere(question, rows, region, chart, variables if everywhere else None) or fallback
    if open_questions or next(minors, None) is not None:
        return Outcome("undecided", note="; ".join(open_questions[:3]) or "too many minors")
    dependent = question.refuted_exactly(region, "all maximal minors of the Jacobian vanish identically")
    return replace(
        combined([dependent, *vanishing]), numeric=merged(o.numeric for o in (*vanishing, dependent)), everywhere=True
    )


def _dependent_somewhere(
    question: Question, rows: Sequence[Sequence[Node]], region: Region, chart: Chart, everywhere: Sequence[Node] | None
) -> Outcome | None:
    """A refutation of what full rank at one point leaves open, or None."""
    from canon.claims.dependence import dependent_somewhere

    tape, size, width = question.tape, len(rows), len(rows[0])
    if question.method == "numeric" or comb(width, size) > FEW_MINORS:
        return None
    every = [
        chart.pull(determinant(tape, [[row[c] for c in columns] for row in rows]))
        for columns in combinations(range(width), size)
    ]
    minors = list(dict.fromkeys(minor for minor in every if tape.value(minor) != 0))
    parameters = _parameters(question, everywhere)
    return dependent_somewhere(question, minors, sorted(parameters), region, everywhere=everywhere is not None)


def _parameters(question: Question, variables: Sequence[Node] | None) -> set[Node]:
    return {question.tape.symbol(s) for s in question.space.parameters} - set(variables or ())


def _ranked(
    question: Question,
    minor: Node,
    name: str,
    answer: Answer,
    region: Region,
    everywhere: Sequence[Node] | None,
    chart: Chart,
    *,
    quick: bool,
) -> Outcome:
    """What a minor that doesn't vanish at one point says (`everywhere`: of the whole domain, in these variables).

    `quick`: by its values at a few points alone.
    """
    tape, witness = question.tape, answer.witness
    fixed = frozenset(tape.support(minor) & _parameters(question, everywhere))
    conditions = question.domain().conditions
    exact = question.method != "numeric" and not region.surface
    shown = exact and not_zero_for_any_parameters(tape, minor, fixed, conditions, quick=quick)
    if exact and quick and not shown:
        return Outcome("supported")
    numeric = answer.numeric if everywhere is not None else None
    point = witness.as_table() if witness is not None else {}
    detail = {"minor": f"det d(functions)/d({name})", "nonzero_at": point}
    step = {"minor": name, "value": question.show(minor), "is not 0 at": point}
    if question.method == "numeric":
        return Outcome("supported", method="witness", numeric=numeric, detail=detail, arguments=(step,))
    if region.surface and everywhere is not None:
        note = "full rank at one point of the surface; nothing is shown of its other components"
        return Outcome("supported", method="witness", numeric=numeric, detail=detail, note=note)
    arguments = ({**step, "theorem": THEOREM},)
    method = "minor, analytic continuation"
    proved = Outcome("proved", method=method, numeric=numeric, detail=detail, arguments=arguments)
    if shown:
        return proved
    pulled = chart.pull(minor)
    if has_no_zero(tape, pulled, region, question.budget):
        return replace(proved, method="minor without a zero", arguments=(step,))
    if _on_every_cell(question, pulled, region, everywhere):
        return replace(proved, method="minor, cell by cell", arguments=({**step, "theorem": COMPONENTS},))
    free = not fixed and not tape.functions_of([minor])
    free = free and has_the_same_points(tape, region, _parameters(question, everywhere))
    if everywhere is None and (free or _harmless(tape, minor, fixed, conditions)):
        return proved
    gaps = ["on other components of the domain"] if everywhere is not None else []
    gaps += ["at special values of parameters"] if fixed or everywhere is None else []
    note = f"full rank at one point; not shown {' or '.join(gaps)}"
    return Outcome("supported", method="witness", numeric=numeric, detail=detail, note=note)


def _on_every_cell(question: Question, minor: Node, region: Region, everywhere: Sequence[Node] | None) -> bool:
    """Without parameters and arbitrary functions: the minor isn't zero at a point of each cell of the region."""
    tape, nodes = question.tape, [minor, *region.nodes()]
    if tape.functions_of(nodes) or any(tape.support(node) & _parameters(question, everywhere) for node in nodes):
        return False
    return nonzero_on_every_cell(tape, minor, region, random.Random(question.seed), question.budget)


def _harmless(tape: Tape, minor: Node, fixed: frozenset[Node], conditions: Sequence[Condition]) -> bool:
    """A minor that contains nothing but parameters and is never zero."""
    if not tape.support(minor) <= fixed or not is_short(tape, minor):
        return False
    return never_zero(tape.to_sympy(minor), conditions)


KINDS = {"independent": independent}
