"""A frame that is displaced in time: the inertial force −m d̈."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, dot


def _add(given: Given) -> Contribution:
    t = given.surroundings.t
    terms = []
    for body in given.particles:
        d = given.vector("displacement", body.dimension)
        terms.append(body.mass * dot(tuple(component.diff(t, 2) for component in d), body.x))
    return Contribution(potential=sp.Add(*terms))


EFFECT: Final = Effect(
    "accelerated_frame",
    "adds m d̈·x for a frame displaced by d(t)",
    ("displacement",),
    ("energy", "momentum", "angular_momentum", "lrl"),
    _add,
)
