"""Action and angle variables: a canonical map to momenta on which alone H depends, and angles that close up.

Of a map given as old variables in new ones the cycle of an angle is the curve along which it alone grows. It must close
after `angle_period`, and not before (`cycle`), where H is smooth (`cycle_smooth`). A map given forward, or by a
generating function, is compared with the actions in closed form where there are (`cycle_action` for one degree of
freedom, `cycle_lattice` for several); else it is inverted first, and the inverse, which is only one branch of it, is
verified.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.cycle import Cycle, closes
from canon.claims.cycle_action import by_action
from canon.claims.cycle_lattice import by_actions
from canon.claims.cycle_smooth import stays_smooth
from canon.claims.generating_function import generated
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.question import Question
from canon.claims.transformation import canonical
from canon.deadline import within
from canon.decide.derivative import derivative
from canon.decide.region import Region, Requirement
from canon.domain import Condition, Domain
from canon.errors import InputError
from canon.mechanics.action_angle import linear_edge
from canon.special import EllipticPi

if TYPE_CHECKING:
    from canon.expression import Formula
    from canon.mechanics import Transformation

NOT_INVERTED = (EllipticPi, sp.elliptic_f, sp.elliptic_e, sp.elliptic_k, sp.LambertW, sp.gamma)


def action_angle(question: Question) -> Outcome:
    """`action_angle`: canonical, K of the momenta alone, each angle advances by `angle_period` round its cycle."""
    question.square_map()
    H, space = question.hamiltonian(), question.space
    period = question.key("angle_period")
    length: Any = sp.S.One if period is None else period.expr
    given = question.map
    for formula in (H, *_written(given)):
        if space.t in formula.symbols:
            raise InputError("action and angle variables are those of an H and a map without time")
    if length.free_symbols & {*space.old, *space.new, space.t} or length.is_zero:
        raise InputError("a period is an expression in parameters, and not 0", "key 'angle_period'")
    outcome = canonical(question)
    if outcome.status == "refuted":
        return outcome
    backward, grounds = question, [outcome]
    if given.direction != "backward":
        by_itself = by_action(question, length) or by_actions(question, length)
        if by_itself is not None:
            return combined([outcome, by_itself])
        inverse = _inverted(question, length)
        if inverse is None:
            return Outcome("undecided", outcome.method, note="the map wasn't inverted, so that its cycles aren't known")
        backward, verified = inverse
        grounds.append(verified)
    depends = backward.decide(_slopes(backward), _whole_cycle(backward))
    if depends.status == "refuted":
        depends = depends.with_detail(fails=f"K depends on an angle: {depends.detail.get('fails', '')}")
        return _if_inverted(backward, given, length, grounds, depends)
    if given.direction != "backward" and combined(grounds).status not in ("proved", "supported"):
        return combined(grounds)
    whole, turn = _whole_cycle(backward), backward.tape.load(length)
    cycles = [closes(Cycle(backward, angle, turn, whole)) for angle in space.Q]
    own = (c for formula in _written(given) for c in formula.conditions) if given.direction == "backward" else ()
    bent = stays_smooth(backward, whole, own)
    found = combined([*grounds, depends, *cycles, *([bent] if bent is not None else [])])
    return _if_inverted(backward, given, length, grounds, found)


def _if_inverted(
    backward: Question, given: Transformation, length: Any, grounds: Sequence[Outcome], found: Outcome
) -> Outcome:
    """The outcome; but a refutation by an inverse that was sampled only is none, unless the inverse is proved."""
    if found.status != "refuted" or given.direction == "backward" or grounds[-1].status == "proved":
        return found
    exactly = replace(backward, method="symbolic")
    if any(_is_inverse(exactly, given, *part).status == "proved" for part in _parts(length)):
        return found
    return found.with_status("undecided", "it fails for what seems to be the map's inverse, which isn't proved")


def _parts(length: Any) -> Sequence[tuple[Any, Any]]:
    """Parts of a turn of the angles, in which the map's formulas are those of one branch: from low to high values."""
    size: Any = sp.Abs(length)
    return (sp.S.Zero, size / 4), (-size / 2, size / 2)


def _written(given: Transformation) -> tuple[Formula, ...]:
    return (given.generating_function.F,) if given.generating_function is not None else given.formulas


def _inverted(question: Question, length: Any) -> tuple[Question, Outcome] | None:
    """A question about the map given backward, with the outcome that it is the map's inverse; None where none is found.

    It is verified where the angles lie within a part of one turn: elsewhere the map's angles are on other branches.
    """
    given = question.map
    if any(formula.expr.has(*NOT_INVERTED) for formula in _written(given)):
        return None
    for branch in range(2):
        try:
            inverse = within(question.budget.share(0.5), lambda branch=branch: given.backward(branch))
        except (InputError, NotImplementedError):
            return None
        subject = replace(question.subject, generating_function=None, transformation=inverse)
        other = Question(replace(question.claim, subject=subject), question.budget, question.seed, question.method)
        found = [_is_inverse(other, given, *part) for part in _parts(length)]
        best = next((verified for verified in found if verified.status == "proved"), found[0])
        if best.status in ("proved", "supported"):
            return other, best
    return None


def _is_inverse(other: Question, given: Transformation, low: Any, high: Any) -> Outcome:
    if given.direction == "implicit":
        assert given.generating_function is not None
        return generated(other, given.generating_function)
    tape, chart, space = other.tape, other.chart, other.space
    along = [chart.pull(tape.load(formula.expr)) for formula in given.formulas]
    residuals = (
        Residual(f"{x} of the inverse", tape.minus(value, tape.symbol(x)))
        for x, value in zip(space.new, along, strict=True)
    )
    turn = [Requirement("positive", (tape.load(e),), f"{e} > 0") for x in space.Q for e in (x - low, high - x)]
    return other.decide(residuals, other.region(*given.formulas).also(*turn))


def _slopes(question: Question) -> Iterator[Residual]:
    """∂K/∂(angle)."""
    tape, chart = question.tape, question.chart
    K = chart.pull(question.load(question.hamiltonian()))
    for angle in question.space.Q:
        slope = derivative(tape, K, tape.symbol(angle))
        yield Residual(f"dK/d{angle}", slope, slope)


def _whole_cycle(question: Question) -> Region:
    """The domain without bounds on the angles themselves: a cycle goes all round."""
    angles = set(question.space.Q)

    def bounds_an_angle(condition: Condition) -> bool:
        return any(linear_edge(angle, condition) is not None for angle in angles)

    asked = question.subject.domain
    kept = tuple(c for c in asked.conditions if not bounds_an_angle(c))
    domain = Domain(kept, asked.surface)
    for formula in question.sections():
        domain = domain & formula.conditions
    return question.region(domain=domain)


KINDS = {"action_angle": action_angle}
