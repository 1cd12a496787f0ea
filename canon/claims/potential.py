"""Potentials of closed forms, by guessing and checking: one is reported only once the decider has proved it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.budget import BudgetExceeded
from canon.claims.outcome import Residual
from canon.claims.show import FAILURES, is_short, is_steep, neat
from canon.deadline import within
from canon.decide.derivative import derivative
from canon.decide.tape import Node, Unsupported
from canon.mechanics.formulas import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

LONGEST = 100
MOST_GUESSES = 200
"""How many antiderivatives are tried for one potential: work is counted, not timed, so that every machine finds the
same."""

Late = Callable[[], bool]


def tired_after(guesses: int) -> Late:
    """True from the `guesses`-th call on."""
    left = iter(range(guesses))
    return lambda: next(left, None) is None


def verified_potential(
    question: Question, slopes: Sequence[Node], variables: Sequence[Node], region: Region
) -> sp.Expr | None:
    """A function with these derivatives, proved to have them; None where none was found."""
    tape = question.tape
    budget = question.budget.share(0.3)
    pulled = question.chart.pull
    symbols = [tape.symbol_at(x) for x in variables]
    if not all(is_short(tape, slope, 4 * LONGEST) for slope in slopes):
        return None
    try:
        plain = [tape.to_sympy(slope) for slope in slopes]
        found = within(budget, lambda: _integrated(plain, symbols, tired_after(MOST_GUESSES)))
    except (*FAILURES, BudgetExceeded):
        return None
    if found is None or found.has(sp.zoo, sp.nan, sp.oo) or budget.spent():
        return None
    try:
        node = tape.load(found)
    except Unsupported:
        return None
    residuals = (
        Residual(f"dF/d{x}", pulled(tape.minus(derivative(tape, node, tape.symbol(x)), slope)))
        for x, slope in zip(symbols, slopes, strict=True)
    )
    outcome = question.decide(residuals, region, budget=budget)
    return neat(found) if outcome.status == "proved" else None


def cartan_slopes(question: Question, H: Node, K: Node) -> dict[Node, Node]:
    """p dq − H dt − (P dQ − K dt): what stands before the differential of each of the chart's coordinates and time."""
    tape, chart = question.tape, question.chart
    half = len(chart.old) // 2
    slopes = {}
    for u in (*chart.coordinates, chart.time):
        terms = []
        for i in range(half):
            terms.append((tape.times(chart.old[i + half], derivative(tape, chart.old[i], u)), 1))
            terms.append((tape.times(chart.new[i + half], derivative(tape, chart.new[i], u)), -1))
        if u == chart.time:
            terms += [(chart.pull(H), -1), (chart.pull(K), 1)]
        slopes[u] = tape.add(terms)
    return slopes


def _integrated(slopes: Sequence[sp.Expr], symbols: Sequence[sp.Symbol], late: Late) -> sp.Expr | None:
    found: sp.Expr = sp.S.Zero
    for slope, x in zip(slopes, symbols, strict=True):
        if sp.count_ops(slope) > 4 * LONGEST or late():
            return None
        rest = _without(sp.expand(slope - sp.diff(found, x)), symbols[: symbols.index(x)])
        part = antiderivative(rest, x, late)
        if part is None:
            return None
        found = found + part
    return found


def _without(rest: sp.Expr, earlier: Sequence[sp.Symbol]) -> sp.Expr:
    """What is left for the later variables: it can't depend on the earlier ones, so any value of these will do."""
    if not any(rest.has(past) for past in earlier):
        return rest
    there = replaced(rest, dict.fromkeys(earlier, sp.S.Zero))
    return neat(rest) if there.has(sp.zoo, sp.nan, sp.oo) else there


def antiderivative(expression: sp.Expr, x: sp.Symbol, late: Late = lambda: False) -> sp.Expr | None:
    """A function whose derivative by x is the expression, term by term; None where no guess fits, or it is `late`."""
    total: sp.Expr = sp.S.Zero
    if sp.count_ops(expression) > LONGEST or is_steep(expression):
        return None
    whole = _guessed(expression, x, late)
    if whole is not None:
        return whole
    for term in sp.Add.make_args(sp.expand(expression)):
        part = _guessed(term, x, late)
        if part is None:
            return None
        total = total + part
    return total


def _guessed(term: sp.Expr, x: sp.Symbol, late: Late) -> sp.Expr | None:
    if not term.has(x):
        return term * x
    if sp.expand(term).is_polynomial(x):
        return sp.integrate(sp.expand(term), x)
    if term.is_rational_function(x) and not term.atoms(sp.Function):
        found: Any = sp.integrate(term, x) if sp.Poly(sp.fraction(sp.together(term))[1], x).degree() <= 2 else None
        if found is not None and not found.has(sp.Integral, sp.Piecewise, sp.RootSum, sp.I):
            return found
    for candidate in _candidates(term, x):
        if late():
            return None
        slope = sp.diff(candidate, x)
        if slope == 0:
            continue
        ratio = sp.cancel(term / slope) if not term.has(sp.sin, sp.cos) else neat(sp.cancel(term / slope))
        if not ratio.has(x):
            return ratio * candidate
    return _by_parts(term, x, late)


def _candidates(term: sp.Expr, x: sp.Symbol) -> Iterator[sp.Expr]:
    """Guesses at an antiderivative up to a constant factor, from the parts of the term."""
    for factor in sp.Mul.make_args(term):
        if not factor.has(x):
            continue
        if isinstance(factor, sp.Derivative) and x in factor.variables:
            left = list(factor.variables)
            left.remove(x)
            inner: Any = factor.expr
            yield sp.Derivative(inner, *left) if left else inner
        base, exponent = factor.as_base_exp()
        if not exponent.has(x) and exponent != 1:
            yield sp.log(base) if exponent == -1 else base ** (exponent + 1)
            if exponent == -2:
                yield from (sp.cot(a.args[0]) for a in base.atoms(sp.sin))
                yield from (sp.tan(a.args[0]) for a in base.atoms(sp.cos))
        yield factor
        yield factor**2
    for call in sorted(term.atoms(sp.Function), key=str):
        if call.has(x) and not isinstance(call, AppliedUndef):
            argument = call.args[0]
            yield from (
                sp.sin(argument),
                sp.cos(argument),
                sp.exp(argument),
                sp.log(sp.sin(argument)),
                sp.log(sp.cos(argument)),
            )
            yield argument - sp.sin(argument) * sp.cos(argument)
            yield argument + sp.sin(argument) * sp.cos(argument)


def _by_parts(term: sp.Expr, x: sp.Symbol, late: Late) -> sp.Expr | None:
    """∫ xᵏ g'(x) with g a sine, cosine or exponential of something linear in x."""
    power, rest = sp.S.One, sp.S.One
    for factor in sp.Mul.make_args(term):
        base, exponent = factor.as_base_exp()
        if base == x and exponent.is_Integer and exponent > 0:
            power = power * factor
        else:
            rest = rest * factor
    if power == 1:
        return None
    inner = _guessed(rest, x, late) if not rest.has(x) or rest.has(sp.sin, sp.cos, sp.exp) else None
    if inner is None:
        return None
    left = sp.expand(sp.diff(power, x) * inner)
    remaining = [_guessed(part, x, late) for part in sp.Add.make_args(left)]
    if any(part is None for part in remaining):
        return None
    return power * inner - sp.Add(*(part for part in remaining if part is not None))
