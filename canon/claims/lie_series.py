"""Lie series: exp(s {·, G}) f as a germ at s = 0, in closed form or as a polynomial to an order.

A function g(s) that is analytic at s = 0 is that series exactly when g(0) = f and dg/ds = {g, G}: the equation gives
all Taylor coefficients. It is refuted by a coefficient only, since away from s = 0 another branch may be met.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.outcome import Outcome, Residual, combined, exact
from canon.claims.special_parameters import MEROMORPHIC
from canon.claims.truncated import HIGHEST_ORDER, region_at_zero, taylor
from canon.decide.derivative import derivative, poisson_bracket, substitute
from canon.decide.region import Requirement
from canon.decide.tape import Node
from canon.domain import Domain
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

EARLY, LATE = 4, 9


def lie_series(question: Question) -> Outcome:
    """`lie_series`: exp(parameter · {·, generator}) f is `equals` (with `order` = n: up to the n-th power)."""
    generator, f, equals = (question.formula(name) for name in ("generator", "f", "equals"))
    parameter = _parameter(question, generator, f)
    order = question.key("order")
    if order is not None:
        return _to_order(question, generator, f, equals, parameter, order)
    at_zero = region_at_zero(question, parameter, generator, f, equals)
    pairs = list(islice(_coefficients(question, generator, f, equals, parameter), 1))
    start = question.decide(pairs, at_zero)
    if start.status == "refuted":
        return _failing_at(question, start, 0)
    early = _refuted_coefficient(question, generator, f, equals, parameter, range(1, EARLY))
    if early is not None:
        return early
    tape, s = question.tape, question.tape.symbol(parameter)
    rate = _bracket(question, question.load(equals), question.load(generator))
    equation = question.chart.pull(tape.minus(derivative(tape, question.load(equals), s), rate))
    domain = Domain(question.domain(generator, f, equals).conditions)
    whole = question.region(domain=domain).also(*at_zero.requirements)
    label = Residual(f"d/d{parameter} = {{., generator}}", equation)
    flow = question.decide([label], whole)
    sides = list(_same_sides(question, equation, s)) if flow.status != "proved" else []
    if sides:
        flow = question.decide([label], whole.also(*sides))
    if flow.status != "refuted":
        return combined([start, flow])
    if not at_zero.surface and _meromorphic_in(question, equation, s):
        theorem = f"meromorphic in {parameter} and not 0 at one value of it, so not 0 as a germ at 0"
        return exact("refuted", theorem, fails=label.label, nonzero_at=dict(flow.witness or {}))
    late = _refuted_coefficient(question, generator, f, equals, parameter, range(EARLY, LATE))
    if late is not None:
        return late
    note = f"the equation of the flow fails at {dict(flow.witness or {})}, but the series agree up to order {LATE - 1}"
    return Outcome("undecided", method=flow.method, note=note)


def _same_sides(question: Question, node: Node, parameter: Node) -> Iterator[Requirement]:
    """That arguments of absolute values have the sign that they have at parameter = 0: so it is near there."""
    tape = question.tape
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] == "f" and op[1] == "abs" and parameter in tape.support(op[2][0]):
            there = substitute(tape, op[2][0], {parameter: tape.zero})
            product = tape.times(op[2][0], there)
            known = tape.value(there)
            node_with_sign = product if known is None else op[2][0] if known > 0 else tape.negative(op[2][0])
            yield Requirement("positive", (node_with_sign,), f"near {tape.symbol_at(parameter)} = 0")


def _meromorphic_in(question: Question, node: Node, parameter: Node) -> bool:
    """True when whatever depends on the parameter is made of sums, products, sin, cos and exp."""
    tape = question.tape
    for i in tape.reach([node]):
        op = tape.ops[i]
        if parameter in tape.support(i) and (op[0] in "ru" or (op[0] == "f" and op[1] not in MEROMORPHIC)):
            return False
    return True


def _parameter(question: Question, *formulas: Formula) -> sp.Symbol:
    parameter = question.key("parameter")
    parameter = parameter.expr if isinstance(parameter, Formula) else parameter
    if not isinstance(parameter, sp.Symbol):
        raise InputError("a name is expected", "key 'parameter'")
    if parameter in (*question.space.old, *question.space.new):
        raise InputError(f"{parameter} is a variable, not a parameter", "key 'parameter'")
    if parameter.is_integer:
        raise InputError(f"{parameter} is an integer: a series in it has no coefficients", "key 'parameter'")
    for formula in formulas:
        if parameter in formula.symbols:
            raise InputError(
                f"generator and f must not depend on the series' own parameter {parameter}", "key 'parameter'"
            )
    return parameter


def _bracket(question: Question, f: Node, g: Node) -> Node:
    space = question.space
    return poisson_bracket(question.tape, f, g, question.nodes(space.q), question.nodes(space.p))


def _series(question: Question, generator: Formula, f: Formula) -> Iterator[Node]:
    """The coefficients f, {f, G}, {{f, G}, G}/2!, …"""
    node, G = question.load(f), question.load(generator)
    factorial = 1
    for k in range(1, HIGHEST_ORDER + 2):
        yield question.tape.scaled(node, Fraction(1, factorial))
        factorial *= k
        node = _bracket(question, node, G)


def _coefficients(
    question: Question, generator: Formula, f: Formula, equals: Formula, parameter: sp.Symbol
) -> Iterator[Residual]:
    """Differences of the Taylor coefficients of `equals` from those of the series."""
    tape, chart = question.tape, question.chart
    given = taylor(tape, question.load(equals), tape.symbol(parameter))
    for k, (actual, claimed) in enumerate(zip(_series(question, generator, f), given, strict=False)):
        label = f"coefficient of {parameter}**{k}"
        yield Residual(label, chart.pull(tape.minus(claimed, actual)), chart.pull(actual))


def _refuted_coefficient(
    question: Question, generator: Formula, f: Formula, equals: Formula, parameter: sp.Symbol, orders: range
) -> Outcome | None:
    """A refutation by one of these Taylor coefficients, found by sampling with rigorous balls."""
    at_zero = region_at_zero(question, parameter, generator, f, equals)
    coefficients = _coefficients(question, generator, f, equals, parameter)
    for k, residual in enumerate(islice(coefficients, orders.stop)):
        if k in orders:
            if len(question.tape.ops) > 200_000:
                return None
            outcome = question.sampled([residual], at_zero, 8)
            if outcome.status == "refuted":
                return _failing_at(question, outcome, k)
    return None


def _failing_at(question: Question, outcome: Outcome, order: int) -> Outcome:
    failed = outcome.failed
    value = question.show(failed.residual.actual) if failed and failed.residual.actual is not None else None
    return outcome.with_detail(fails_at_order=order, coefficient=value)


def _to_order(
    question: Question, generator: Formula, f: Formula, equals: Formula, parameter: sp.Symbol, order: object
) -> Outcome:
    """The polynomial up to the n-th power: coefficients 0 to n agree, and there are no higher ones."""
    if isinstance(order, bool) or not isinstance(order, int) or not 0 <= order <= HIGHEST_ORDER:
        raise InputError(f"an order from 0 to {HIGHEST_ORDER} is expected, not {order}", "key 'order'")
    at_zero = region_at_zero(question, parameter, generator, f, equals)
    outcomes: list[Outcome] = []
    for k, residual in enumerate(islice(_coefficients(question, generator, f, equals, parameter), order + 1)):
        outcomes.append(question.decide([residual], at_zero))
        if outcomes[-1].status == "refuted":
            return _failing_at(question, combined(outcomes), k)
    tape = question.tape
    s = tape.symbol(parameter)
    higher = list(islice(taylor(tape, question.load(equals), s), order + 4))[order + 1 :]
    for k, node in enumerate(higher, order + 1):
        outcome = question.decide([Residual(f"coefficient of {parameter}**{k}", question.chart.pull(node))], at_zero)
        if outcome.status == "refuted":
            return outcome.with_detail(note=f"`equals` has a term in {parameter}**{k}, above the order claimed")
    rest = question.load(equals)
    for _ in range(order + 1):
        rest = derivative(tape, rest, s)
    ended = question.decide(
        [Residual("terms of higher order", question.chart.pull(rest))], question.region(generator, f, equals)
    )
    if ended.status == "refuted":
        ended = Outcome("undecided", note=f"`equals` is not seen to be a polynomial in {parameter} of degree {order}")
    return combined([*outcomes, ended]).with_detail(order=order)


KINDS = {"lie_series": lie_series}
