"""A potential 1/r² about a fixed centre, which turns the apsides of an orbit."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, square


def _add(given: Given) -> Contribution:
    return Contribution(
        potential=sp.Add(*(given.formula("c", body) / square(given.from_centre(body)) for body in given.particles))
    )


EFFECT: Final = Effect(
    "inverse_square",
    "c/r²: precession of the apsides",
    ("c", "centre"),
    ("momentum", "lrl"),
    _add,
    optional=("centre",),
)
