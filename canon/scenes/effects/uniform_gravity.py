"""Uniform gravity: the potential m g z of a number g, and −m g·x of a vector, which is the acceleration itself."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, dot


def _add(given: Given) -> Contribution:
    # a number says how strongly things fall, a vector says whither
    sign = -1 if isinstance(given.table.get("g"), list) else 1
    terms = [sign * body.mass * dot(given.vector("g", body.dimension, body), body.x) for body in given.particles]
    return Contribution(potential=sp.Add(*terms))


EFFECT: Final = Effect(
    "uniform_gravity",
    "potential m g z, the force −m g along the last axis; a vector g is the acceleration: the force m g",
    ("g",),
    ("momentum", "angular_momentum", "lrl"),
    _add,
)
