"""Uniform gravity: the potential m g z."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, dot


def _add(given: Given) -> Contribution:
    terms = [
        particle.mass * dot(given.vector("g", particle.dimension, particle), particle.x) for particle in given.particles
    ]
    return Contribution(potential=sp.Add(*terms))


EFFECT: Final = Effect(
    "uniform_gravity",
    "potential m g z, the force −m g along the last axis; a vector g has the potential m g·x",
    ("g",),
    ("momentum", "angular_momentum", "lrl"),
    _add,
)
