"""A force that is given in time."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, dot


def _add(given: Given) -> Contribution:
    terms = [-dot(given.vector("force", body.dimension), body.x) for body in given.particles]
    return Contribution(potential=sp.Add(*terms))


EFFECT: Final = Effect(
    "driving",
    "potential −x·F(t)",
    ("force",),
    ("energy", "momentum", "angular_momentum", "lrl"),
    _add,
    on_systems=True,
)
