"""The cycles of several angles by their actions: degrees of freedom inside one another, each with its closed form.

The cycles round which one coordinate goes alone, at fixed values of the others, are a basis of those on the torus of
constant new momenta P. Round the i-th of them p dq adds up to I_i, and as p dq = dF there, the angle Q_j = ∂F/∂P_j
advances by ∂I_i/∂P_j. If these are constants they span the lattice of all advances; the curve along which Q_j alone
grows by its period closes if that is in the lattice, and is gone round once if no part of it is. Arnold (1989),
section 50; Goldstein, Poole and Safko (2002), section 10.7.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.action_region import Setting, assumed
from canon.claims.cycle_action import grounds_of
from canon.claims.cycle_data import torus
from canon.claims.outcome import Outcome, Residual, combined
from canon.decide.derivative import derivative
from canon.decide.implied import follows
from canon.decide.region import Region, Requirement
from canon.decide.search import samples
from canon.decide.tape import Node, Unsupported
from canon.domain import Condition
from canon.mechanics.action_angle import ClosedAction, NotQuadratic, linear_edge, one_degree
from canon.mechanics.closed_actions import librations
from canon.mechanics.nested_degrees import Degree, nested_degrees

if TYPE_CHECKING:
    from canon.claims.question import Question

LARGEST, CLOSE = 2000, 1e-10
THEOREM = "round a cycle of the torus the angle Q grows by the derivative of the action p dq by P"


@dataclass(frozen=True)
class _Cycle:
    """A cycle with its action, in names for the levels; of a cyclic coordinate (`degree` None) it is 2π p."""

    action: Any
    setting: Setting | None = None
    degree: Degree | None = None
    closed: ClosedAction | None = None


def by_actions(question: Question, length: Any) -> Outcome | None:
    """Whether each angle of a canonical map advances by `length` round its cycle, once; None where that isn't seen."""
    space, H = question.space, question.hamiltonian()
    if space.n < 2 or question.method == "numeric" or question.subject.domain.surface:
        return None
    nested = nested_degrees(H.expr, space.q, space.p)
    if nested is None or not nested[0]:
        return None
    degrees, cyclic = nested
    turns = [_Cycle(2 * sp.pi * p) for _, p in cyclic]
    region = question.region()
    for cycles in _choices(question, degrees):
        found = _decided(question, [*turns, *cycles], degrees, length, region)
        if found is not None:
            return found
    return None


def _choices(question: Question, degrees: tuple[Degree, ...]) -> Iterator[list[_Cycle]]:
    """The first closed form of each degree of freedom."""
    H = question.hamiltonian()
    chosen: list[_Cycle] = []
    for degree in degrees:
        q, p = degree.q, degree.p
        domain = [c for c in question.subject.domain.conditions if _bounds(c, q)]
        conditions: tuple[Condition, ...] = (*H.conditions, *domain, *assumed(q, sign=False))
        try:
            motion = one_degree(degree.H, q, p, degree.level, tuple(c for c in conditions if _bounds(c, q)))
        except NotQuadratic:
            return
        closed = next(iter(librations(motion)), None)
        if closed is None:
            return
        setting = Setting(q, p, degree.H, degree.level, sp.S.Zero, conditions, motion)
        chosen.append(_Cycle(closed.value, setting, degree, closed))
    yield chosen


def _bounds(condition: Condition, q: sp.Symbol) -> bool:
    return all(term.free_symbols & {q} for term in condition.terms) and linear_edge(q, condition) is not None


def _decided(
    question: Question, cycles: list[_Cycle], degrees: tuple[Degree, ...], length: Any, region: Region
) -> Outcome | None:
    tape, chart, n = question.tape, question.chart, question.space.n
    P = chart.new[n:]
    cycles = [replace(cycle, action=_signed(question, cycle.action, region)) for cycle in cycles]
    values: dict[Any, Any] = {degree.level: degree.value for degree in degrees}
    nodes = [chart.pull(tape.load(cycle.action.xreplace(values))) for cycle in cycles]
    advance = _proposed(question, nodes, P, region, length)
    if advance is None:
        return None
    grounds: list[Outcome] = []
    if chart.direction == "implicit":
        for k, cycle in enumerate(cycles):
            if cycle.degree is None:
                continue
            level = _level(question, cycle, advance[k], region, values)
            if level is not None:
                values[cycle.degree.level], proved = level
                grounds.append(proved)
        nodes = [chart.pull(tape.load(cycle.action.xreplace(values))) for cycle in cycles]
    for cycle in cycles:
        if cycle.setting is not None and cycle.closed is not None:
            positive = cycle.closed.exists if cycle.closed.through is None else cycle.closed.through
            found = grounds_of(question, cycle.setting, cycle.closed, region, positive, values)
            if found is None:
                return None
            grounds += found
    residuals = [
        Residual(
            f"d(action of {_name(cycle, question)})/d{tape.symbol_at(x)}",
            tape.add(
                [
                    (derivative(tape, nodes[i], x), 1),
                    *((tape.times(tape.load(advance[i][j]), derivative(tape, P[j], x)), -1) for j in range(n)),
                ]
            ),
        )
        for i, cycle in enumerate(cycles)
        for x in chart.coordinates
    ]
    constant = question.decide(residuals, region)
    if constant.status != "proved":
        return None
    return _closed(question, sp.Matrix(advance), length, region, combined([*grounds, constant]), cycles, values)


def _signed(question: Question, expression: Any, region: Region) -> Any:
    """Absolute values of what has one sign in the region, without their bars."""
    tape, chart = question.tape, question.chart
    rules: dict[Any, Any] = {}
    for size in expression.atoms(sp.Abs):
        for inner in (size.args[0], -size.args[0]):
            node = chart.pull(tape.load(inner))
            if follows(tape, Requirement("positive", (node,), inner), region, question.budget):
                rules[size] = inner
    return expression.xreplace(rules)


def _name(cycle: _Cycle, question: Question) -> str:
    return str(cycle.degree.q) if cycle.degree is not None else str(cycle.action / (2 * sp.pi))


def _proposed(
    question: Question, actions: list[Node], P: tuple[Node, ...], region: Region, length: Any
) -> list[list[Any]] | None:
    """∂I/∂P in numbers at one point, taken for rational multiples of the period or of 2π: a guess."""
    import numpy as np

    tape, coordinates, n = question.tape, question.chart.coordinates, question.space.n
    slopes = [[derivative(tape, f, x) for x in coordinates] for f in (*actions, *P)]
    targets = [node for row in slopes for node in row]
    try:
        rng = random.Random(question.seed)
        sample = next(samples(tape, targets, region, rng, count=1, bits=128, budget=question.budget), None)
        if sample is None:
            return None
        numbers = np.array([[float(sample.balls[node].mid()) for node in row] for row in slopes])
    except (Unsupported, AttributeError, TypeError, ValueError):
        return None
    matrix, *_ = np.linalg.lstsq(numbers[n:].T, numbers[:n].T, rcond=None)
    size = float(length)
    found = [[_multiple(value, length, size) for value in row] for row in matrix.T]
    return None if any(value is None for row in found for value in row) else found


def _multiple(value: float, length: Any, size: float) -> Any:
    for unit, number in ((length, size), (2 * sp.pi, 2 * math.pi)):
        ratio = Fraction(value / number).limit_denominator(LARGEST)
        if abs(value / number - float(ratio)) < CLOSE:
            return sp.Rational(ratio.numerator, ratio.denominator) * unit
    return None


def _level(
    question: Question, cycle: _Cycle, row: list[Any], region: Region, values: dict[Any, Any]
) -> tuple[Any, Outcome] | None:
    """The level as a function of the new momenta: what the action would say, if it is verified."""
    tape, chart, degree = question.tape, question.chart, cycle.degree
    assert degree is not None
    J = sp.Dummy("J", real=True)
    whole = sum(a * P for a, P in zip(row, question.space.P, strict=True))
    try:
        found: Any = sp.solve(cycle.action - J, degree.level, check=False, simplify=False)
    except (NotImplementedError, ValueError):
        return None
    here = chart.pull(tape.load(degree.value))
    for solution in found:
        guess = solution.xreplace({J: whole}).xreplace(values)
        outcome = question.decide(
            [Residual(f"the level of {degree.q}", tape.minus(here, chart.pull(tape.load(guess))))], region
        )
        if outcome.status == "proved":
            return guess, outcome
    return None


def _is_no_integer(x: Any) -> bool:
    """Whether an exact number is seen to lie between two integers."""
    if not x.is_number or not x.is_real:
        return False
    value = sp.N(x, 30)
    return value.is_Float and bool(abs(value - round(value)) > CLOSE)


def _closed(
    question: Question,
    advance: Any,
    length: Any,
    region: Region,
    proved: Outcome,
    cycles: list[_Cycle],
    values: dict[Any, Any],
) -> Outcome | None:
    """Whether the lattice that the rows of `advance` span has period · e_j in it, and no part of it."""
    if sp.cancel(advance.det()) == 0:
        return None
    back: Any = advance.inv(method="ADJ") * length
    turns = list[list[int]]()
    for j, angle in enumerate(question.space.Q):
        combination = [sp.cancel(x) for x in back.row(j)]  # exact: rational functions of π and of the period
        whole = all(x.is_Integer for x in combination)
        times = math.gcd(*(int(x) for x in combination)) if whole else 0
        if times == 1:
            turns.append([int(x) for x in combination])
            continue
        if not whole and not any(_is_no_integer(x) for x in combination):
            return None
        why = (
            f"the cycle of {angle} is closed after 1/{times} of the period already"
            if times
            else f"no cycle of the torus has {angle} alone advance by {length}"
        )
        return question.refuted_exactly(region, f"{THEOREM}: {why}").with_detail(fails=why)
    parts = [(cycle.action, cycle.degree) for cycle in cycles]
    step = {"theorem": THEOREM, "advances": [[str(x) for x in row] for row in advance.tolist()]}
    step |= torus(question, parts, values, turns)
    details = {f"cycle of {angle}": f"advances by {length}" for angle in question.space.Q}
    return combined([proved, Outcome("proved", "actions", arguments=(step,))]).with_detail(**details)
