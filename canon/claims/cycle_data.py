"""The cycles of a torus as data, for a certificate: what they lie on, their actions, and which each angle goes round.

Of each cycle there is its coordinate and its action. Where the coordinate moves on a level of a function H of it, its
momentum and what was named before, H and the name of its level are there, too; else the coordinate is cyclic, and the
action 2π times its momentum. Of a map by a generating function the levels, and the momenta of cyclic coordinates, are
there as functions of the new momenta besides.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import sympy as sp

from canon.claims.claim_tables import text_of

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.mechanics.nested_degrees import Degree

LEVEL: Final = "level_"
"""With a number, the name of a level."""


def torus(
    question: Question,
    cycles: Sequence[tuple[Any, Degree | None]],
    values: dict[Any, Any],
    turns: Sequence[Sequence[int]],
) -> dict[str, Any]:
    """{"torus": {"cycles": …, "turns": …}}, or nothing where the levels aren't functions of the new momenta.

    **Arguments:** the action of each cycle, in names for the levels, with its degree of freedom (None: cyclic); the
    levels' `values`; for each angle how many times its own cycle goes round each of these.
    """
    space = question.space
    cyclic = _cyclic(question, {degree.q for _, degree in cycles if degree is not None})
    levels = [degree.level for _, degree in cycles if degree is not None]
    names = {level: sp.Symbol(f"{LEVEL}{k}") for k, level in enumerate(levels, 1)}
    unnamed, found = iter(cyclic.items()), list[dict[str, str]]()
    for action, degree in cycles:
        entry: dict[str, Any]
        if degree is None:
            q, value = next(unnamed)
            entry = {"coordinate": q, "action": sp.expand(action)}
        else:
            value = values[degree.level]
            entry = {"coordinate": degree.q, "H": degree.H, "level": degree.level, "action": sp.expand(action)}
        if question.chart.direction == "implicit":
            value = value.xreplace({p: cyclic[q] for q, p in zip(space.q, space.p, strict=True) if q in cyclic})
            if value.free_symbols & {*space.old, *space.Q}:
                return {}
            entry["value"] = value
        found.append({key: text_of(x.xreplace(names)) for key, x in entry.items()})
    return {"torus": {"cycles": found, "turns": [list(row) for row in turns]}}


def _cyclic(question: Question, moving: set[Any]) -> dict[Any, Any]:
    """The coordinates that H doesn't contain, with their momenta; by a generating function as its derivatives."""
    space, F = question.space, question.map.generating_function
    implicit = question.chart.direction == "implicit" and F is not None
    pairs = [(q, p) for q, p in zip(space.q, space.p, strict=True) if q not in moving]
    return {q: sp.diff(F.F.expr, q) if implicit and F is not None else p for q, p in pairs}
