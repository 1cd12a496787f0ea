"""The actions of a scene or claim file as JSON, and in words."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Final

from canon.numeric.actions.bounded import Bounded
from canon.numeric.actions.elliptic import RULE as MEAN
from canon.report.words import visible
from canon.scenes.actions import Actions
from canon.scenes.degrees import Degree
from canon.scenes.values import text_of

BEYOND: Final = "beyond double precision"
"""The price of one digit more: the bounds of actions are those of the doubles that hold them."""


def action_record(actions: Actions, seconds: float | None = None) -> dict[str, Any]:
    """The record that `canon actions --json` prints."""
    return {
        "format": 1,
        "title": actions.title,
        "seconds": None if seconds is None else round(seconds, 6),
        "one_digit_more": BEYOND,
        "hamiltonian": text_of(actions.H),
        "energy": _pair(actions.energy),
        "separates": actions.how,
        "degrees": [_degree(degree) for degree in actions.degrees],
    }


def _degree(degree: Degree) -> dict[str, Any]:
    orbit = degree.orbit
    return {
        "name": degree.name,
        "kind": "cyclic" if orbit is None else orbit.kind,
        "action": _pair(degree.action),
        "frequency": _pair(degree.frequency),
        "period": None if orbit is None else _pair(orbit.period),
        "angle": _pair(degree.angle),
        "ends": None if orbit is None else [_pair(end) for end in orbit.ends],
        "rule": None if orbit is None else orbit.rule,
        "nodes": None if orbit is None else orbit.nodes,
        "note": "" if orbit is None else orbit.note,
    }


def _pair(number: Bounded | None) -> dict[str, float] | None:
    return None if number is None else {"value": number.value, "bound": number.bound}


def action_lines(actions: Actions) -> Iterator[str]:
    """What was found, for people. J = ∮ p dq, ν = dE/dJ in cycles, w grows by 1 in a period."""
    if actions.title:
        yield visible(actions.title)
    yield f"  Hamiltonian  {text_of(actions.H)}"
    yield f"  energy       {actions.energy}"
    yield f"  separates    {actions.how}"
    for degree in actions.degrees:
        orbit = degree.orbit
        yield f"{degree.name}: {_course(degree)}"
        yield f"  action       {degree.action}   (J/2π = {degree.action.value / (2 * math.pi):.10g})"
        if degree.frequency is not None:
            period = f"   (period {orbit.period})" if orbit is not None and orbit.period is not None else ""
            yield f"  frequency    {degree.frequency}{period}"
        if degree.angle is not None:
            yield f"  angle        {degree.angle}"
        if orbit is not None:
            yield f"  rule         {orbit.rule}, {orbit.nodes} {'steps' if orbit.rule == MEAN else 'nodes'}"
            if orbit.note:
                yield f"  ! {orbit.note}"


def _course(degree: Degree) -> str:
    orbit = degree.orbit
    if orbit is None:
        return "cyclic, taken as an angle of period 2π"
    low, high = orbit.ends
    return f"{orbit.kind} from {low.value:.10g} to {high.value:.10g}"
