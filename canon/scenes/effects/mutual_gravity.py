"""Newton's gravitation between every pair of bodies."""

from __future__ import annotations

from itertools import combinations
from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, length, lrl_vector, square


def _add(given: Given) -> Contribution:
    bodies = given.particles
    if len(bodies) < 2:
        raise given.fail("two bodies or more attract each other: this acts on one")
    G = given.formula("G", default=given.surroundings.constants.get("G", 1))
    softening = given.formula("softening", default=0)
    terms = []
    for one, other in combinations(bodies, 2):
        apart = tuple(x - y for x, y in zip(one.x, other.x, strict=True))
        distance = sp.sqrt(square(apart) + softening**2) if softening != 0 else length(apart)
        terms.append(-G * one.mass * other.mass / distance)
    lrl = {}
    if len(bodies) == 2 and len(given.surroundings.particles) == 2 and softening == 0 and bodies[0].dimension > 1:
        one, other = bodies
        mass = one.mass * other.mass / (one.mass + other.mass)
        x = tuple(a - b for a, b in zip(one.x, other.x, strict=True))
        p = tuple(mass * (a / one.mass - b / other.mass) for a, b in zip(one.p, other.p, strict=True))
        lrl = lrl_vector(mass, G * one.mass * other.mass, x, p)
    return Contribution(potential=sp.Add(*terms), lrl=lrl)


EFFECT: Final = Effect(
    "mutual_gravity", "−G m_i m_j/r_ij for every pair", ("G", "softening"), (), _add, optional=("G", "softening")
)
