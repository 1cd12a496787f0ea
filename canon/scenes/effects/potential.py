"""Any other potential, of each body or of each pair."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.numeric.pair_sum import RADIUS
from canon.scenes.effects.effect import Contribution, Effect, Given
from canon.scenes.effects.pairs import sum_over_pairs
from canon.scenes.values import exactly_one, expression


def _add(given: Given) -> Contribution:
    if exactly_one(given.table, ("V", "pair"), given.where) == "V":
        return Contribution(potential=sp.Add(*(given.formula("V", particle) for particle in given.particles)))
    if given.surroundings.is_system or len(given.particles) < 2:
        raise given.fail("a potential of pairs acts on two bodies or more", "pair")
    law = expression(given.table["pair"], {**given.names(None), "r": RADIUS}, given.place("pair"))
    return Contribution(potential=sum_over_pairs(law, given.particles))


EFFECT: Final = Effect(
    "potential",
    "V in x, y, z, t of each body, or `pair` in r (and t) of each pair",
    ("V", "pair"),
    ("momentum", "angular_momentum", "lrl"),
    _add,
    optional=("V", "pair"),
    on_systems=True,
)
