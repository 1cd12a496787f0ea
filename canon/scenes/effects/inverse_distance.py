"""Attraction to, or repulsion from, a fixed centre by a potential 1/r."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, length, lrl_vector


def _add(given: Given) -> Contribution:
    terms, lrl = [], {}
    for particle in given.particles:
        a, r = given.formula("a", particle), given.from_centre(particle)
        terms.append(-a / length(r))
        if len(given.surroundings.particles) == 1 and particle.dimension > 1 and a.is_number:
            lrl = lrl_vector(particle.mass, a, r, particle.p)
    return Contribution(potential=sp.Add(*terms), lrl=lrl)


EFFECT: Final = Effect(
    "inverse_distance", "−a/r: attraction for a > 0", ("a", "centre"), ("momentum",), _add, optional=("centre",)
)
