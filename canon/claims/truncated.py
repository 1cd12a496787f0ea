"""Claims about germs at a parameter's zero: coefficients of a Taylor series on the tape, and where they live.

A truncated map is canonical up to O(eps^(n+1)) when the Taylor coefficients of M J Mᵀ − scale·J in eps vanish
up to the n-th; each coefficient is a derivative at eps = 0, an exact expression of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.scale import Brackets
from canon.decide.derivative import derivative, substitute
from canon.decide.tape import Node, Tape
from canon.domain import Condition, Domain, conditions_of
from canon.errors import InputError
from canon.granted import freed_conditions

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region
    from canon.expression import Formula

HIGHEST_ORDER = 40


def truncated(question: Question, scale: Formula | None, order: Any) -> Outcome:
    """M J Mᵀ − scale · J = O(eps^(n+1)) for `order` = (eps, n); a refutation names the order at which it fails."""
    eps, highest = checked_order(question, order)
    tape = question.tape
    region = region_at_zero(question, eps, *((scale,) if scale else ()))
    node = question.load(scale) if scale else tape.one
    if question.map.direction == "implicit":
        return _implicit(question, eps, highest, node, region)
    brackets = Brackets(question)
    series = {pair: taylor(tape, residual.node, tape.symbol(eps)) for pair, residual in zip(
        brackets.order(), brackets.residuals(node), strict=True)}  # fmt: skip
    outcomes: list[Outcome] = []
    for k in range(highest + 1):

        def coefficients(k: int = k) -> Iterator[Residual]:
            for pair, coefficient in series.items():
                value = next(coefficient)
                yield Residual(f"coefficient of {eps}**{k} of {brackets.label(*pair)}", value, value)

        outcome = question.decide(coefficients(), region)
        outcomes.append(outcome)
        if outcome.status == "refuted":
            return combined(outcomes).with_detail(fails_at_order=k, value=_value(question, outcome))
        if any(f.answer.status != "proved" for f in outcome.findings) and question.budget.spent():
            break
    return combined(outcomes).with_detail(order=highest)


def _value(question: Question, outcome: Outcome) -> str | None:
    failed = outcome.failed
    return None if failed is None else question.show(failed.residual.node)


def _implicit(question: Question, eps: sp.Symbol, highest: int, scale: Node, region: Region) -> Outcome:
    from canon.claims.generating_function import hessian_outcome_of

    tape = question.tape
    hessian = question.chart.hessian
    assert hessian is not None
    regular = hessian_outcome_of(question, substitute(tape, hessian, {tape.symbol(eps): tape.zero}), region)
    rest = taylor(tape, tape.minus(scale, tape.one), tape.symbol(eps))
    residuals = (Residual(f"coefficient of {eps}**{k} of scale - 1", next(rest)) for k in range(highest + 1))
    return combined([regular, question.decide(residuals, region)])


def checked_order(question: Question, order: Any) -> tuple[sp.Symbol, int]:
    """(eps, n) of `order`; **raises** `InputError` for what is none."""
    where = "key 'order'"
    if not isinstance(order, (tuple, list)) or len(order) != 2:
        raise InputError('a name and a number are expected, as in order = ["eps", 2]', where)
    eps, highest = order
    if not isinstance(eps, sp.Symbol) or isinstance(highest, bool) or not isinstance(highest, int):
        raise InputError('a name and a number are expected, as in order = ["eps", 2]', where)
    if eps in (*question.space.old, *question.space.new):
        raise InputError(f"{eps} is a variable, not a small parameter", where)
    if eps.is_integer:
        raise InputError(f"{eps} is an integer, not a small parameter", where)
    if not 0 <= highest <= HIGHEST_ORDER:
        raise InputError(f"an order from 0 to {HIGHEST_ORDER} is expected, not {highest}", where)
    return eps, highest


def taylor(tape: Tape, node: Node, parameter: Node) -> Iterator[Node]:
    """The Taylor coefficients of a node at parameter = 0, in order, each built when it is asked for.

    **Raises:** `InputError` if the node isn't defined there.
    """
    factorial = 1
    k = 0
    while True:
        try:
            value = substitute(tape, node, {parameter: tape.zero})
        except InputError as error:
            name = tape.symbol_at(parameter)
            raise InputError(f"not analytic at {name} = 0, where the claim is made: {error.message}") from error
        yield tape.scaled(value, Fraction(1, factorial))
        k += 1
        factorial *= k
        node = derivative(tape, node, parameter)


def region_at_zero(question: Question, parameter: sp.Symbol, *formulas: Formula) -> Region:
    """The claim's domain at parameter = 0.

    A `where` that only bounds the parameter (0 < eps < 1/10) leaves the germ at 0 alone and is dropped.

    **Raises:** `InputError` if the domain doesn't come near parameter = 0, or a formula isn't analytic there.
    """
    asked = question.subject.domain
    kept = Domain(tuple(c for c in asked.conditions if not _bounds_only(c, parameter)), asked.surface)
    for formula in (*question.sections(), *formulas):
        kept = kept & Domain(conditions=formula.conditions)
    kept = kept & Domain(tuple(_granted(parameter, *question.sections(), *formulas)))
    for condition in kept.conditions:
        if _fails_at_zero(condition, parameter):
            raise InputError(f"not analytic at {parameter} = 0, where the claim is made: {condition} fails there")
    tape = question.tape
    return question.region(images={tape.symbol(parameter): tape.zero}, domain=kept, assumed=False, regular=False)


def _granted(parameter: sp.Symbol, *formulas: Formula) -> Iterator[Condition]:
    """What the formulas require and the parameter's assumed sign grants, though not at 0: eps > 0 in √eps.

    Also what doesn't show in a formula's value any more: eps ≠ 0 in 0/eps.
    """
    if parameter.is_nonnegative or parameter.is_nonpositive or parameter.is_zero is False:
        plain = sp.Symbol(parameter.name, real=True)
        for formula in formulas:
            for condition in conditions_of(formula.expr.xreplace({parameter: plain})):
                yield condition.substitute({plain: parameter})
            for operation in formula.granted:
                if any(argument.has(parameter) for argument in operation[1]):
                    yield from freed_conditions(operation, {parameter})


def _bounds_only(condition: Condition, parameter: sp.Symbol) -> bool:
    """A bound on the parameter alone that 0 satisfies or borders on; **raises** `InputError` if 0 is outside of it."""
    names: set[Any] = set().union(*(term.free_symbols for term in condition.terms))
    if names != {parameter} or condition.kind not in ("positive", "nonzero"):
        return False
    (term,) = condition.terms
    at_zero = term.xreplace({parameter: sp.S.Zero})
    if at_zero.is_number and at_zero.is_zero is False:
        if condition.kind == "positive" and at_zero.is_positive is not True:
            raise InputError(f"the claim is made at {parameter} = 0, which {condition} excludes")
        return True
    slope = term.diff(parameter).xreplace({parameter: sp.S.Zero})
    if not (at_zero.is_number and at_zero.is_zero and slope.is_number):
        return False
    if slope.is_zero is False:
        if (parameter.is_nonnegative and slope.is_negative) or (parameter.is_nonpositive and slope.is_positive):
            raise InputError(f"the claim is made at {parameter} = 0, which {condition} excludes")
        return True
    return condition.kind == "nonzero"


def _fails_at_zero(condition: Condition, parameter: sp.Symbol) -> bool:
    """A condition of a formula that is violated at parameter = 0 whatever the other names are."""
    values = [term.xreplace({parameter: sp.S.Zero}) for term in condition.terms]
    first = values[0]
    if any(value.has(sp.zoo, sp.nan) for value in values):
        return True
    if condition.kind in ("positive", "slit"):
        return bool(first.is_zero or (first.is_number and first.is_nonpositive))
    return condition.kind == "nonzero" and bool(first.is_zero)
