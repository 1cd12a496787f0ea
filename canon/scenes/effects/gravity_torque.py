"""Gravity on a top with a fixed point, whose centre of mass is on its third axis."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given


def _add(given: Given) -> Contribution:
    weight = given.formula("m") * given.formula("g") * given.formula("l")
    return Contribution(potential=sp.Add(*(weight * body.rotation[2][2] for body in given.rigid)))


EFFECT: Final = Effect(
    "gravity_torque",
    "m g l cos θ of a top with a fixed point: l from it to the centre of mass, along the body's third axis",
    ("m", "g", "l"),
    ("angular_momentum", "casimir"),
    _add,
    on_rigid=True,
)
