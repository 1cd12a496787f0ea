"""Orbits of a Hamiltonian that isn't quadratic in p: that the square that was solved for is the momentum's.

What is decided: H(q, p) = E has no other solutions than p² = square(q, E), an identity in q and p; and these are
solutions where the guards are positive, an identity in q and E. A guard is an expression that is 0 only where the
square is 0, so that between turning points it keeps the sign that it has at one point. There too the sense of the
motion is seen: by the first identity ∂H/∂p · ∂square/∂E = 2p, so that for p > 0 it keeps the sign of ∂square/∂E.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb

from canon.claims.action_region import Setting, along, is_positive
from canon.claims.outcome import Outcome, Residual, combined
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, certainly_positive
from canon.decide.libration import Integrand
from canon.decide.region import Region, Requirement
from canon.mechanics.action_angle import ClosedAction
from canon.substitution import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question


def square_is_right(question: Question, setting: Setting, region: Region) -> Outcome:
    """Whether p² = square solves H = E, and nothing else does, wherever the guards are positive.

    **Arguments:** `region`, the constants.
    """
    solved, tape = setting.solved, question.tape
    if solved is None:
        raise ValueError("H is quadratic")
    p, whole = setting.p, along(question, setting, region)
    moving = replace(whole, symbols=(*whole.symbols, tape.symbol(p)))
    back: Any = {solved.level: setting.H}
    only: Any = replaced(solved.of_level, back) - p**2
    turning = moving.also(Requirement("nonzero", (tape.symbol(p),), f"{p} is not 0"))
    first = question.decide([Residual("p**2 on its own level", question.load(only))], turning)
    square = setting.at_level(setting.motion.square)
    put: Any = {p: sp.sqrt(square)}
    there: Any = replaced(setting.H, put) - setting.at_level(setting.energy)
    inside = [square, *(setting.at_level(guard) for guard in solved.guards)]
    between = whole.also(*(Requirement("positive", (tape.load(e),), f"{e} > 0") for e in inside))
    return combined([first, question.decide([Residual("H at this momentum", question.load(there))], between)])


def where_it_exists(setting: Setting, closed: ClosedAction) -> tuple[Any, ...]:
    """The guards at a point inside: an orbit that passes it has them positive, and else there is none."""
    if setting.solved is None or closed.inside is None:
        return ()
    put: Any = {setting.q: closed.inside}
    return tuple(replaced(guard, put) for guard in setting.solved.guards)


def grounds(question: Question, setting: Setting, closed: ClosedAction, region: Region) -> Outcome | None:
    """That the closed form is that of an orbit, run through in this sense; None where that isn't seen.

    **Arguments:** `region`, the constants for which the orbit exists, the guards at a point inside being positive.
    """
    solved = setting.solved
    if solved is None or closed.inside is None:
        return None
    put: Any = {setting.q: closed.inside}
    rate = replaced(setting.at_level(_rate(setting)), put)
    return square_is_right(question, setting, region) if is_positive(question, region, rate) else None


def _rate(setting: Setting) -> Any:
    """∂square/∂E."""
    if setting.solved is None:
        raise ValueError("H is quadratic")
    at: Any = {setting.solved.level: setting.energy}
    return setting.solved.of_level.diff(setting.solved.level).xreplace(at)


def guarded(question: Question, setting: Setting, integrand: Integrand, places: Sequence[Fraction]) -> bool:
    """Whether the guards, and ∂square/∂E, are certified positive at one of the places."""
    solved = setting.solved
    if solved is None:
        return True
    nodes = [question.load(e) for e in (*solved.guards, _rate(setting))]

    def positive(place: Fraction) -> bool:
        where: Ball = arb(rational(place))
        return all(certainly_positive(integrand.at(node, where)) for node in nodes)

    return any(positive(place) for place in places)
