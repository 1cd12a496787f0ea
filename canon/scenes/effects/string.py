"""A massless string between two bodies, or from a body to an anchor: their distance is at most its length."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from canon.scenes.effects.effect import Contribution, Effect, Given
from canon.scenes.effects.rod import distance


def _add(given: Given) -> Contribution:
    return replace(distance(given), unilateral=True)


EFFECT: Final = Effect(
    "string",
    "a rod that does not push: slack when its tension would be negative, its jerk inelastic when taut again",
    ("length", "anchor"),
    ("energy", "momentum", "lrl", "symplecticity", "volume", "loop", "cartan", "reversibility"),
    _add,
    optional=("anchor",),
)
