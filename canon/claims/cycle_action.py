"""The cycle of an angle of one degree of freedom, by its action: no map is inverted, and no cycle is followed.

Along the flow of H = K(P) the angle grows at the rate dK/dP, and the orbit closes after the period dJ/dE, J = ∮ p dq.
So round its cycle it advances by dJ/dP: J, known in closed form at E = H(q, p), must grow by as much as P times the
angle's period does. Goldstein, Poole and Safko (2002), section 10.6.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.action_region import Setting, along, assumed, existing, not_implied
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.show import is_steep
from canon.deadline import within
from canon.decide.derivative import derivative
from canon.decide.implied import follows
from canon.decide.region import Region, Requirement
from canon.domain import Condition
from canon.errors import EmptyDomain, InputError
from canon.mechanics.action_angle import ClosedAction, NotQuadratic, OneDegree, linear_edge, one_degree
from canon.mechanics.closed_actions import librations
from canon.mechanics.standard_actions import cosine, rotation

if TYPE_CHECKING:
    from canon.claims.question import Question


def by_action(question: Question, length: Any) -> Outcome | None:
    """Whether the angle of a canonical map advances by ± `length` round its cycle; None where no closed form tells."""
    space = question.space
    if space.n != 1 or question.method == "numeric" or question.subject.domain.surface:
        return None
    q, p = space.old
    H = question.hamiltonian()
    energy = sp.Dummy("E", real=True)
    conditions = tuple(c for c in (*question.subject.domain.conditions, *H.conditions) if _speaks_of(c, q))
    try:
        motion = within(question.budget.share(0.5), lambda: one_degree(H.expr, q, p, energy, conditions))
    except NotQuadratic:
        return None
    if is_steep(motion.square):
        return None
    everywhere = (*H.conditions, *_edges(conditions, q), *assumed(q, sign=False))
    setting = Setting(q, p, H.expr, energy, sp.S.Zero, everywhere, motion)
    region = question.region()
    for closed, cycle in _closed_forms(motion):
        grounds = grounds_of(question, setting, closed, region, closed.exists, {setting.energy: setting.H})
        if grounds is None:
            continue
        advance = _advance(question, closed, energy, length, region)
        if advance is not None:
            found = f"{cycle}, dJ/dP = {length}"
            return combined([*grounds, advance]).with_detail(**{f"cycle of {space.Q[0]}": found, "by": closed.method})
    return None


def _speaks_of(condition: Condition, q: sp.Symbol) -> bool:
    """Whether it is one on the coordinate and constants."""
    return all(term.free_symbols & {q} for term in condition.terms) and linear_edge(q, condition) is not None


def _edges(conditions: tuple[Condition, ...], q: sp.Symbol) -> tuple[Condition, ...]:
    return tuple(c for c in conditions if linear_edge(q, c) is not None)


def _closed_forms(motion: OneDegree) -> Iterator[tuple[ClosedAction, str]]:
    """Actions with the cycle that they belong to. A rotation's coordinate is an angle, of period 2π."""
    for closed in librations(motion):
        yield closed, "a libration"
    if cosine(motion.square, motion.q) is not None and motion.mean == 0:
        with contextlib.suppress(InputError):  # 2π is no period of H
            yield from ((closed, "a rotation") for closed in rotation(motion, 2 * sp.pi))


def grounds_of(
    question: Question,
    setting: Setting,
    closed: ClosedAction,
    region: Region,
    positive: Sequence[sp.Expr],
    values: dict[Any, Any],
) -> list[Outcome] | None:
    """That the closed form is the action of the orbit through each point of the region; None where it isn't shown.

    What is to be `positive` for that is looked at with the `values` of the energies there.
    """
    tape, chart = question.tape, question.chart
    for wanted in positive:
        here: Any = wanted.xreplace(values)
        node = chart.pull(tape.load(here))
        if not follows(tape, Requirement("positive", (node,), wanted), region, question.budget):
            return None
    try:
        constants = existing(question, setting, closed)
        if not_implied(question, setting, constants, closed):
            return None
        checks = [Residual(name, question.load(expression)) for name, expression in closed.vanishes]
        grounds = [question.decide(checks, along(question, setting, constants))] if checks else []
    except EmptyDomain:
        return None
    return grounds if all(ground.status == "proved" for ground in grounds) else None


def _advance(question: Question, closed: ClosedAction, energy: Any, length: Any, region: Region) -> Outcome | None:
    """{P, H} = 0 and dJ = ± length · dP: the sign tells which way the angle grows. A third way refutes."""
    tape, chart, space = question.tape, question.chart, question.space
    H = question.hamiltonian().expr
    here: Any = {energy: H}
    value: Any = closed.value.xreplace(here)
    J = chart.pull(tape.load(value))
    P, K = chart.new[1], chart.pull(tape.load(H))
    u, v = chart.coordinates
    (P_u, P_v), (K_u, K_v), (J_u, J_v) = ([derivative(tape, f, x) for x in (u, v)] for f in (P, K, J))
    alone = tape.minus(tape.times(P_u, K_v), tape.times(P_v, K_u))
    depends = question.decide([Residual(f"{{{space.P[0]}, H}}", alone, alone)], region)
    if depends.status != "proved":
        return depends if depends.status == "refuted" else None
    size = tape.load(length)
    tried = []
    for sign in (1, -1):
        turn = tape.scaled(size, sign)
        residuals = [
            Residual(f"dJ/d{tape.symbol_at(x)} - {length}*d{space.P[0]}/d{tape.symbol_at(x)}", node)
            for x, node in ((u, tape.minus(J_u, tape.times(turn, P_u))), (v, tape.minus(J_v, tape.times(turn, P_v))))
        ]
        outcome = question.decide(residuals, region)
        if outcome.status == "proved":
            return combined([depends, outcome])
        tried.append(outcome)
    if any(outcome.status != "refuted" for outcome in tried):
        return None
    # where neither sign is right, at one point, the angle advances by something else there
    square = [
        Residual(
            f"the advance of {space.Q[0]} round its cycle",
            tape.minus(tape.times(J_x, J_x), tape.times(size, size, P_x, P_x)),
        )
        for J_x, P_x in ((J_u, P_u), (J_v, P_v))
    ]
    outcome = question.decide(square, region)
    return outcome if outcome.status == "refuted" else None
