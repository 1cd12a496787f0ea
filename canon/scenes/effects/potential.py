"""Any other potential, of each body or of each pair."""

from __future__ import annotations

from itertools import combinations
from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, length
from canon.scenes.values import exactly_one, expression


def _add(given: Given) -> Contribution:
    if exactly_one(given.table, ("V", "pair"), given.where) == "V":
        return Contribution(potential=sp.Add(*(given.formula("V", particle) for particle in given.particles)))
    if given.surroundings.is_system or len(given.particles) < 2:
        raise given.fail("a potential of pairs acts on two bodies or more", "pair")
    terms = []
    for one, other in combinations(given.particles, 2):
        r = length(tuple(x - y for x, y in zip(one.x, other.x, strict=True)))
        terms.append(expression(given.table["pair"], {**given.names(None), "r": r}, given.place("pair")))
    return Contribution(potential=sp.Add(*terms))


EFFECT: Final = Effect(
    "potential",
    "V in x, y, z, t of each body, or `pair` in r (and t) of each pair",
    ("V", "pair"),
    ("momentum", "angular_momentum", "lrl"),
    _add,
    optional=("V", "pair"),
    on_systems=True,
)
