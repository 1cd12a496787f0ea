"""Canonical maps: the fundamental brackets, with a scale, to an order, at values of parameters, on a surface.

M J M^T = scale · J with M = ∂(Q,P)/∂(q,p) is decided bracket by bracket; no Jacobian matrix is built.
A map given backward is canonical with a scale exactly when the brackets of q, p in the new variables are J / scale.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.chart import Chart
from canon.claims.outcome import Finding, Outcome, combined, exact
from canon.claims.same_points import has_the_same_points
from canon.claims.scale import Brackets, scale_of
from canon.claims.shears import by_shears
from canon.claims.special_parameters import MEROMORPHIC, not_zero_for_any_parameters
from canon.claims.truncated import checked_order, truncated
from canon.decide.cells import cells_of
from canon.decide.region import Region
from canon.decide.tape import Node, Tape
from canon.domain import Condition
from canon.errors import InputError
from canon.mechanics.formulas import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.expression import Formula


def canonical(question: Question) -> Outcome:
    """`canonical`: M J Mᵀ = scale · J everywhere in the domain (with `order`: up to higher powers)."""
    direction = question.map.direction
    order = question.key("order")
    if order is not None:
        checked_order(question, order)
    scale = scale_of(question)
    if order is not None:
        return truncated(question, scale, order)
    if direction == "implicit":
        from canon.claims.generating_function import canonical_of_generating_function

        return canonical_of_generating_function(question, scale)
    extra = (scale,) if scale else ()
    region = question.region(*extra)
    node = question.load(scale) if scale else question.tape.one
    brackets = Brackets(question)
    outcome = by_shears(question, node, region) if question.method == "symbolic" else None
    if outcome is None:
        outcome = question.decide(brackets.residuals(node), region)
    if outcome.status == "proved":
        return outcome.with_detail(scale=question.show(node))
    if outcome.status == "refuted":
        return taught(question, brackets, node, region, outcome)
    return outcome


def fundamental_brackets(question: Question) -> Outcome:
    """`fundamental_brackets`: {Q_i,Q_j} = {P_i,P_j} = 0 and {Q_i,P_j} = δ_ij, bracket by bracket."""
    if question.map.direction == "implicit":
        from canon.claims.generating_function import canonical_of_generating_function

        return canonical_of_generating_function(question, None)
    region = question.region()
    brackets = Brackets(question)
    outcome = question.decide(brackets.residuals(question.tape.one), region)
    if outcome.status == "refuted":
        return taught(question, brackets, question.tape.one, region, outcome)
    return outcome.with_detail(brackets={f.residual.label: f.answer.status for f in outcome.findings} or None)


def taught(question: Question, brackets: Brackets, scale: Node, region: Any, outcome: Outcome) -> Outcome:
    """A refutation with what there is to learn from it."""
    if question.method == "numeric":
        return outcome
    from canon.claims.repair import lesson

    return outcome.with_detail(**lesson(question, brackets, scale, region, outcome))


def canonical_when(question: Question) -> Outcome:
    """`canonical_when`: canonical at each of the solutions, and not at generic values of the parameters named."""
    solutions = question.key("solutions")
    if not solutions:
        raise InputError("at least one solution is needed", "key 'solutions'")
    if question.map.direction == "implicit":
        return _generated_at_all_values(question)
    tape = question.tape
    parts: list[Outcome] = []
    for number, table in enumerate(solutions, 1):
        values = checked_solution(question, table, f"key 'solutions', table {number}")
        images = {tape.symbol(name): question.load(value) for name, value in values.items()}
        region = question.region(*values.values(), images=images)
        free = sorted({*region.symbols}.union(*(tape.support(image) for image in images.values())))
        region = replace(region, symbols=tuple(free))
        outcome = question.decide(Brackets(question, chart_at(question, values)).residuals(tape.one), region)
        if outcome.failed is not None:
            shown = {str(name): str(value.expr) for name, value in values.items()}
            return replace(outcome, witness=_completed(tape, outcome.failed, images)).with_detail(at=shown)
        parts.append(outcome)
    written = [value for table in solutions for value in dict(table).values()]
    names = {symbol for table in solutions for symbol in table}
    return combined([*parts, _fails_generically(question, names, written)])


def _completed(tape: Tape, failed: Finding, images: Mapping[Node, Node]) -> dict[str, Any] | None:
    """The witness's table with the solution's own values there, so that it names a value for every parameter."""
    witness = failed.answer.witness
    if witness is None:
        return None
    values = {str(tape.symbol_at(name)): witness.value_of(tape, image) for name, image in images.items()}
    return {**{name: value for name, value in values.items() if value is not None}, **witness.as_table()}


def _fails_generically(question: Question, names: set[sp.Symbol], written: Sequence[Formula]) -> Outcome:
    """The map isn't canonical at generic values of these parameters, where what is written of the solutions is defined.

    One failure is enough where the bracket is an analytic function of them on a connected domain: not if they occur
    in absolute values. It must not hang on special values of the other parameters, nor on the choice of a function.
    """
    tape = question.tape
    named = ", ".join(sorted(map(str, names)))
    region = question.region(*written)
    generic = question.decide(Brackets(question).residuals(tape.one), region)
    if generic.status == "proved":
        return question.refuted_exactly(region, f"the map is canonical at all values of {named}", canonical="always")
    if generic.status != "refuted" or generic.failed is None:
        return Outcome("undecided", note=f"not shown to fail at generic values of {named}")
    residual = generic.failed.residual
    shown = _shown_generically(question, residual.node, region, names, question.domain(*written).conditions)
    return Outcome(
        "proved" if shown else "supported",
        method=generic.method,
        arguments=({"fails generically": residual.label, "at": dict(generic.witness or {})},),
        detail={"generic_failure": residual.label},
        note="" if shown else f"fails at one point; that it does at almost all values of {named} is not shown",
    )


def _shown_generically(
    question: Question, node: Node, region: Region, names: set[sp.Symbol], conditions: Sequence[Condition]
) -> bool:
    """A node that isn't 0 at one point isn't 0 at almost all values of these parameters, whatever the others are.

    Of whole numbers that is seen of rational functions alone: (-1)**n - 1 is 0 at every other n. A point of the domain
    decides for all values at which it is one; where the domain hangs on parameters, and on a surface that does, the
    node must be one that vanishes on no open set, or analytic on a connected domain.
    """
    tape = question.tape
    reached = tape.reach([node])
    whole = {name for name in names if name.is_integer}
    if tape.functions_of([node]) or any(tape.symbols_of(i) & whole and not _rational(tape, i) for i in reached):
        return False
    parameters = frozenset(tape.symbol(s) for s in question.space.parameters)
    others = frozenset(tape.symbol(s) for s in question.space.parameters if s not in names) & tape.support(node)
    if not region.surface and not_zero_for_any_parameters(tape, node, others, conditions):
        return True
    if others:
        return False
    if not region.surface and all(_meromorphic(tape, i) for i in reached):
        return True
    if all(_meromorphic(tape, i) or not tape.symbols_of(i) & names for i in reached):
        return has_the_same_points(tape, region, parameters)
    if region.surface or tape.functions_of(region.nodes()):
        return False
    cells = cells_of(tape, region, [node], question.budget)
    return cells is not None and len(cells) == 1 and cells[0].connected


def _rational(tape: Tape, node: Node) -> bool:
    return tape.ops[node][0] in "nsc+*"


def _meromorphic(tape: Tape, node: Node) -> bool:
    op = tape.ops[node]
    return _rational(tape, node) or (op[0] == "f" and op[1] in MEROMORPHIC)


def _generated_at_all_values(question: Question) -> Outcome:
    """The map of a generating function is canonical at all values of parameters at which it exists."""
    from canon.claims.generating_function import hessian_outcome

    outcome = hessian_outcome(question)
    if outcome.status != "proved":
        return outcome
    return exact("refuted", "the map of a generating function is canonical at all values", canonical="always")


def checked_solution(question: Question, table: Any, where: str) -> dict[Any, Formula]:
    """A solution's values; **raises** `InputError` where a name is no parameter or its assumptions are violated."""
    values = dict(table)
    if not values:
        raise InputError("an empty table", where)
    variables = {*question.space.old, *question.space.new, question.space.t}
    for name, value in values.items():
        if name not in question.space.parameters:
            raise InputError(f"{name} is not a parameter", where)
        for symbol in sorted(value.symbols & variables, key=str):
            raise InputError(f"the value of {name} contains the variable {symbol}", where)
        for symbol in sorted(value.symbols & set(values), key=str):
            raise InputError(f"the value of {name} contains {symbol}, which the same table fixes", where)
        for word in ("real", "positive", "negative", "nonnegative", "nonpositive", "nonzero", "integer"):
            if getattr(name, f"is_{word}") and getattr(value.expr, f"is_{word}") is False:
                raise InputError(f"{name} is {word}, so {name} = {value.expr} is not allowed", where)
        if name.is_integer and not value.expr.is_integer:
            raise InputError(f"{name} is an integer, and {value.expr} is not seen to be one", where)
        # a quotient of real names is real wherever the solution is defined, and its conditions restrict the domain
        if name.is_real and not value.expr.is_real and question.tape.is_complex(question.load(value)):
            raise InputError(f"{name} is real, and {value.expr} is not seen to be", where)
    return values


def chart_at(question: Question, values: dict[Any, Formula]) -> Chart:
    """The chart of the map with parameters replaced; **raises** `InputError` where that leaves it undefined."""
    mapping = {name: value.expr for name, value in values.items()}
    nodes = []
    for formula in question.map.formulas:
        expression = replaced(formula.expr, mapping)
        if expression.has(sp.zoo, sp.nan, sp.oo):
            raise InputError(f"{formula.text or formula.expr} is undefined there", "key 'solutions'")
        nodes.append(question.load(expression))
    chart = question.chart
    images = dict(zip(chart.images, nodes, strict=True))
    forward = chart.direction == "forward"
    return replace(chart, images=images, **({"new": tuple(nodes)} if forward else {"old": tuple(nodes)}))


KINDS = {
    "canonical": canonical,
    "canonical_when": canonical_when,
    "fundamental_brackets": fundamental_brackets,
}
