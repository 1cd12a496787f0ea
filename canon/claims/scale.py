"""The scale (valence) of a transformation: M J M^T = scale · J with a constant that is nowhere zero."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.claims.constant import constant_of
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.show import FAILURES, is_short, is_steep
from canon.decide.derivative import poisson_bracket
from canon.decide.tape import Node
from canon.domain import Condition
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.vanishing import vanishes
from canon.sign import known_sign

if TYPE_CHECKING:
    from canon.claims.chart import Chart
    from canon.claims.question import Question
    from canon.decide.region import Region


def never_zero(expression: sp.Expr, conditions: Iterable[Condition] = ()) -> bool:
    """True when the expression certainly has no zero where the conditions hold; False when that doesn't show.

    It looks at the factors: each must have a sign that the assumptions on names show, or be a factor of something
    that the conditions keep from zero.
    """
    if expression.is_number:
        return vanishes(expression) is False
    kept: set[sp.Expr] = set()
    for condition in conditions:
        if condition.kind in ("positive", "nonzero", "slit"):
            kept |= set(_bases(condition.terms[0], certain=True))
    return all(_base_never_zero(base, kept) for base in _bases(expression))


def _base_never_zero(base: sp.Expr, kept: set[sp.Expr]) -> bool:
    if base.is_number:
        return vanishes(base) is False
    if base in kept or -base in kept or known_sign(base) in ("positive", "negative", "nonzero"):
        return True
    return _no_real_root(base)


def _no_real_root(base: sp.Expr) -> bool:
    """A polynomial in one real name that has no root where the name's assumptions allow one (Sturm's theorem)."""
    if len(base.free_symbols) != 1:
        return False
    (name,) = base.free_symbols
    if not name.is_real or base.has(sp.Function) or sp.count_ops(base) > 200 or is_steep(base):
        return False  # such coefficients aren't rational, or to expand it may take for ever
    if not base.is_polynomial(name):
        return False
    polynomial = sp.Poly(base, name)
    if not polynomial.domain.is_QQ and not polynomial.domain.is_ZZ:
        return False
    low = 0 if name.is_nonnegative else None
    high = 0 if name.is_nonpositive else None
    return polynomial.count_roots(low, high) == 0


def _bases(expression: Any, *, certain: bool = False) -> Iterator[Any]:
    """The factors without their exponents; `certain`: those that are not 0 where the product isn't.

    A factor b of bⁿ may be 0 where n may be.
    """
    if sp.count_ops(expression) < 200 and not expression.has(AppliedUndef) and not is_steep(expression):
        try:
            expression = sp.factor(expression)
        except FAILURES:
            expression = sp.factor_terms(expression)
    for factor in sp.Mul.make_args(expression):
        base = factor
        while isinstance(base, sp.Pow) and (not certain or _is_not_zero(base.exp)):
            base = base.base
        if isinstance(base, sp.Mul):
            yield from _bases(base, certain=certain)
        else:
            yield base


def _is_not_zero(exponent: Any) -> bool:
    return known_sign(exponent) in ("positive", "negative", "nonzero")


def scale_of(question: Question) -> Formula | None:
    """The claim's `scale`, None where it is left out.

    **Raises:** `InputError` if it depends on variables, or isn't seen to be nowhere zero.
    """
    scale = question.key("scale")
    if scale is None:
        return None
    where = "key 'scale'"
    variables = {*question.space.old, *question.space.new, question.space.t}
    for symbol in sorted(scale.symbols & variables, key=str):
        raise InputError(f"the scale is an expression in parameters alone, but it contains {symbol}", where)
    if scale.expr.has(AppliedUndef):
        raise InputError("the scale is an expression in parameters alone, without arbitrary functions", where)
    if vanishes(scale.expr):
        raise InputError("the scale is zero", where)
    order = question.key("order")
    near = scale.expr if order is None else scale.expr.xreplace({order[0]: sp.S.Zero})
    if not never_zero(near, question.domain(scale).conditions):
        raise InputError(
            f"the scale {scale.text or scale.expr} must be nowhere zero: declare a sign of its parameters, "
            "or restrict the domain",
            where,
        )
    return scale


@dataclass(frozen=True)
class Brackets:
    """The fundamental brackets of a chart, each built when it is asked for.

    Of a forward map those of Q, P in the old variables; of a backward map those of q, p in the new ones, which are
    J / scale where the map is canonical with that scale.
    """

    question: Question
    given: Chart | None = None

    @property
    def chart(self) -> Chart:
        """The chart given, or that of the claim's own map."""
        return self.given or self.question.chart

    @property
    def inverted(self) -> bool:
        """True for a backward map."""
        return self.chart.direction == "backward"

    @property
    def names(self) -> tuple[sp.Symbol, ...]:
        """The variables whose brackets these are, positions first."""
        space = self.question.space
        return space.old if self.inverted else space.new

    @property
    def functions(self) -> tuple[Node, ...]:
        """Their formulas in the chart's coordinates."""
        return self.chart.old if self.inverted else self.chart.new

    @property
    def pairs(self) -> int:
        """The number of conjugate pairs among them."""
        return len(self.names) // 2

    def bracket(self, i: int, j: int) -> Node:
        """The bracket of the i-th and the j-th."""
        chart = self.chart
        half = len(chart.coordinates) // 2
        f, g = self.functions[i], self.functions[j]
        return poisson_bracket(chart.tape, f, g, chart.coordinates[:half], chart.coordinates[half:])

    def label(self, i: int, j: int) -> str:
        """A name such as `{Q, P}`."""
        return f"{{{self.names[i]}, {self.names[j]}}}"

    def order(self) -> list[tuple[int, int]]:
        """All pairs of indices, conjugate pairs first: they fail most often and show the scale."""
        m = self.pairs
        diagonal = [(i, i + m) for i in range(m)]
        rest = [(i, j) for i in range(2 * m) for j in range(i + 1, 2 * m) if j != i + m]
        return diagonal + rest

    def residuals(self, scale: Node) -> Iterator[Residual]:
        """M J M^T − scale·J, entry by entry (of a backward map, for its inverse)."""
        tape, m = self.question.tape, self.pairs
        expected = tape.power(scale, -1) if self.inverted else scale
        for i, j in self.order():
            actual = self.bracket(i, j)
            node = tape.minus(actual, expected) if j == i + m else actual
            yield Residual(self.label(i, j), node, actual)


@dataclass(frozen=True)
class ConstantScale:
    """The constant with which a map is canonical, if it is: `node` is None where it was not found.

    `outcome` says that all brackets agree with that constant, `nonzero` that it is seen to be nowhere zero. `actual` is
    what it is at each point: where the constant is only supported, nothing is refuted by it that isn't by this, too.
    """

    outcome: Outcome
    node: Node | None
    nonzero: bool = True
    actual: Node | None = None

    @property
    def status(self) -> str:
        """The status of "canonical with some constant scale"."""
        return self.outcome.status if self.nonzero or self.outcome.status != "proved" else "supported"

    @property
    def complete(self) -> Outcome:
        """The outcome of "canonical with some constant scale"."""
        if self.status == self.outcome.status:
            return self.outcome
        return self.outcome.with_status("supported", "the scale is not seen to be nowhere zero")


def constant_scale(question: Question, region: Region) -> ConstantScale:
    """Decides whether the map is canonical with some constant scale, and finds it.

    The value of the first bracket at one point of the domain (parameters left free) is the only candidate;
    that all brackets agree with it everywhere is then decided exactly.
    """
    tape = question.tape
    if question.chart.direction == "implicit":
        from canon.claims.generating_function import hessian_outcome

        return ConstantScale(hessian_outcome(question), tape.one, actual=tape.one)
    brackets = Brackets(question)
    first = brackets.bracket(0, brackets.pairs)
    candidate, outcome = _candidate(question, region, brackets, first)
    if candidate is None:
        return ConstantScale(outcome, None)
    scale, actual = (tape.power(node, -1) if brackets.inverted else node for node in (candidate, first))
    agree = question.decide(islice(brackets.residuals(scale), 1, None), region)
    if agree.status == "refuted" and outcome.status != "proved":
        agree = question.decide(islice(brackets.residuals(actual), 1, None), region)
    outcome = combined([outcome, agree]).with_detail(scale=question.show(scale))
    if is_short(tape, candidate) and never_zero(tape.to_sympy(candidate), question.domain().conditions):
        return ConstantScale(outcome, scale, actual=actual)
    vanishing = question.decide([Residual("scale", candidate)], region)
    if vanishing.status == "proved":
        return ConstantScale(combined([question.refuted_exactly(region, "a scale is not zero"), vanishing]), None)
    return ConstantScale(outcome, scale, nonzero=False, actual=actual)


def _candidate(question: Question, region: Region, brackets: Brackets, first: Node) -> tuple[Node | None, Outcome]:
    """The constant that the first bracket is, with the outcome that says so; None where it is no constant."""
    tape = question.tape
    label = brackets.label(0, brackets.pairs)
    value = tape.value(first)
    if value == 0:
        return None, question.refuted_exactly(region, "a scale is not zero", fails=label, brackets={label: "0"})
    variables = {*question.chart.coordinates, question.chart.time}
    if value is not None:
        return first, question.decide([Residual(f"{label} is constant", tape.zero)], region)
    unit = question.decide([Residual(f"{label} = 1", tape.minus(first, tape.one))], region)
    if unit.status != "refuted" or unit.failed is None or unit.failed.answer.witness is None:
        return (tape.one, unit) if unit.status in ("proved", "supported") else (None, unit)
    if not tape.support(first) & variables and not tape.functions_of([first]):
        return first, question.decide([Residual(f"{label} is constant", tape.zero)], region)
    constant, same = constant_of(question, region, first, variables, unit.failed.answer.witness, label)
    if constant is not None:
        if tape.value(constant) == 0 and same.status == "proved":
            return None, question.refuted_exactly(region, "a scale is not zero", fails=label, brackets={label: "0"})
        return constant, same
    return None, same.with_detail(fails=f"{label} is not constant") if same.status == "refuted" else same
