"""What teaches: of a map that isn't canonical, the constant scale with which it would be, the brackets that fail, the
values of parameters at which they hold, and a simple repair. Everything offered has been proved first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from typing import TYPE_CHECKING, Any

from canon.claims.outcome import Outcome, Residual
from canon.claims.scale import Brackets, constant_scale
from canon.claims.show import FAILURES, LONG, is_short
from canon.decide.region import Requirement
from canon.decide.tape import Node
from canon.errors import CanonError
from canon.sign import known_sign

if TYPE_CHECKING:
    from canon.claims.chart import Chart
    from canon.claims.question import Question
    from canon.decide.region import Region

MOST_BRACKETS = 6
MOST_CANDIDATES = 24
MOST_OPEN = 2
"""After so many changes that are neither proved nor refuted no more are tried. What is taught is bounded by counts, so
that it is the same on every machine; of a claim's budget it takes at most two fifths."""


def lesson(question: Question, brackets: Brackets, scale: Node, region: Region, outcome: Outcome) -> dict[str, Any]:
    """The details of a refutation of M J Mᵀ = scale · J."""
    short = replace(question, budget=question.budget.share(0.4), method="symbolic")
    found: dict[str, Any] = {"brackets": failing(short, outcome)}
    for step in (_constant, _repaired, _parameters):
        if short.budget.spent():
            break
        try:
            news = step(short, Brackets(short), scale, region, outcome)
        except (CanonError, *FAILURES):
            continue
        found.update(news)
        if step is _constant and "repair" in news:
            break
    return found


def failing(question: Question, outcome: Outcome) -> dict[str, str]:
    """The brackets that were refuted, with their values."""
    refuted = [finding for finding in outcome.findings if finding.answer.status == "refuted"]
    shown = {}
    for finding in refuted[:MOST_BRACKETS]:
        residual = finding.residual
        node = residual.node if residual.actual is None else residual.actual
        text = LONG if question.budget.spent() else question.show(node)
        witness = finding.answer.witness
        shown[residual.label] = (
            text if text != LONG or witness is None else f"{text}, off by {witness.value} at the witness"
        )
    if len(refuted) > MOST_BRACKETS:
        shown["…"] = f"and {len(refuted) - MOST_BRACKETS} more"
    return shown


def _constant(question: Question, brackets: Brackets, scale: Node, region: Region, outcome: Outcome) -> dict[str, Any]:
    """The constant with which the map is canonical, if there is one."""
    m = brackets.pairs
    diagonal = {brackets.label(i, i + m) for i in range(m)}
    failed = {f.residual.label for f in outcome.findings if f.answer.status == "refuted"}
    if not failed <= diagonal:
        return {}
    constant = constant_scale(question, region)
    if constant.outcome.status != "proved" or constant.node is None:
        return {}
    tape = question.tape
    shown = question.show(constant.node)
    if constant.node == tape.one:
        return {"scale": shown, "repair": "it is canonical with scale 1"}
    if not constant.nonzero:
        return {"scale": shown}
    target = "p" if brackets.inverted else "P"
    ratio = tape.mul([(constant.node, -1), (scale, 1)] if brackets.inverted else [(constant.node, 1), (scale, -1)])
    return {
        "scale": shown,
        "repair": f"it is canonical with scale {shown}; or divide each {target} by {question.show(ratio)}",
    }


@dataclass(frozen=True)
class Repair:
    """A changed map with the words for the change: `before`, the formula `told` if there is one, `after`."""

    before: str
    functions: tuple[Node, ...]
    divisor: Node | None = None
    told: Node | None = None
    after: str = ""

    def words(self, question: Question) -> str:
        """The change in words; formulas are put into a neat form only for the change that is offered."""
        words = self.before + ("" if self.told is None else question.show(self.told)) + self.after
        if self.divisor is None or _never_zero(question, self.divisor):
            return words
        return f"{words}, where that is not 0"


def _repaired(question: Question, brackets: Brackets, scale: Node, region: Region, outcome: Outcome) -> dict[str, Any]:
    """The first simple change that makes the map canonical with the scale claimed, proved to do so."""
    tape = question.tape
    expected = tape.power(scale, -1) if brackets.inverted else scale
    left_open = 0
    for candidate in islice(_candidates(question, brackets, expected, outcome), MOST_CANDIDATES):
        if left_open == MOST_OPEN or question.budget.spent():
            break
        changed = Brackets(question, _with_functions(brackets.chart, candidate.functions))
        try:
            regular = region if candidate.divisor is None else region.also(_nonzero(candidate.divisor))
            verdict = question.decide(changed.residuals(scale), regular)
        except CanonError:
            continue
        if verdict.status == "proved":
            return {"repair": candidate.words(question)}
        left_open += verdict.status != "refuted"
    return {}


def _never_zero(question: Question, node: Node) -> bool:
    """What is divided by is not 0 anywhere, by what is assumed of the names in it."""
    if not is_short(question.tape, node):
        return False
    return known_sign(question.tape.to_sympy(node)) in ("positive", "negative", "nonzero")


def _nonzero(node: Node) -> Requirement:
    return Requirement("nonzero", (node,), "what is divided by is not zero")


def _with_functions(chart: Chart, functions: tuple[Node, ...]) -> Chart:
    if chart.direction == "backward":
        return replace(chart, old=functions)
    return replace(chart, new=functions)


def _candidates(question: Question, brackets: Brackets, expected: Node, outcome: Outcome) -> Iterator[Repair]:
    """Changes to try, the simplest first."""
    tape, names, m = question.tape, brackets.names, brackets.pairs
    functions = brackets.functions
    failed = {f.residual.label for f in outcome.findings if f.answer.status == "refuted"}

    def changed(index: int, node: Node) -> tuple[Node, ...]:
        return (*functions[:index], node, *functions[index + 1 :])

    for i in range(m):
        if brackets.label(i, i + m) in failed:
            yield Repair(f"the sign of {names[i + m]}", changed(i + m, tape.negative(functions[i + m])))
    for i in range(2 * m):
        op = tape.ops[functions[i]]
        if op[0] != "+" or len(op[2]) > 6:
            continue
        for node, coefficient in op[2]:
            flipped = tape.add([(functions[i], 1), (node, -2 * coefficient)])
            term = tape.scaled(node, coefficient)
            yield Repair("the sign of the term ", changed(i, flipped), None, term, f" in {names[i]}")
    for i in range(m):
        for j in range(i + 1, m):
            for shift in (0, m):
                swapped = list(functions)
                swapped[i + shift], swapped[j + shift] = functions[j + shift], functions[i + shift]
                yield Repair(f"exchange {names[i + shift]} and {names[j + shift]}", tuple(swapped))
    for i in range(m):
        if brackets.label(i, i + m) not in failed:
            continue
        value = brackets.bracket(i, i + m)
        if tape.value(value) == 0:
            continue
        factor = tape.mul([(value, 1), (expected, -1)])
        for k in (i + m, i):
            quotient = tape.mul([(functions[k], 1), (factor, -1)])
            yield Repair(f"divide {names[k]} by ", changed(k, quotient), factor, factor)


def _parameters(
    question: Question, brackets: Brackets, scale: Node, region: Region, outcome: Outcome
) -> dict[str, Any]:
    """Values of parameters at which the map is canonical."""
    from canon.claims.parameters import solutions
    from canon.claims.transformation import chart_at, checked_solution
    from canon.domain import conditions_of
    from canon.expression import Formula

    failed = [f.residual for f in outcome.findings if f.answer.status == "refuted"]
    tape = question.tape
    expressions = [tape.to_sympy(residual.node) for residual in failed if is_short(tape, residual.node)]
    names = [s for s in question.space.parameters if any(s in e.free_symbols for e in expressions)]
    good = []
    for table in solutions(expressions, names):
        values = {name: Formula(value, tuple(conditions_of(value)), str(value)) for name, value in table.items()}
        try:
            checked_solution(question, values, "")
            images = {tape.symbol(name): tape.load(value.expr) for name, value in values.items()}
            there = question.region(*values.values(), images=images)
            changed = Brackets(question, chart_at(question, values))
            if question.decide(_moved(question, changed, scale, images), there).status == "proved":
                good.append({str(name): str(value.expr) for name, value in values.items()})
        except CanonError:
            continue
    return {"holds_when": good} if good else {}


def _moved(question: Question, brackets: Brackets, scale: Node, images: dict[Node, Node]) -> Iterator[Residual]:
    from canon.decide.derivative import substitute

    return brackets.residuals(substitute(question.tape, scale, images))
