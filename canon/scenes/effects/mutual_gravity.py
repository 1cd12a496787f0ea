"""Newton's gravitation between every pair of bodies."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.numeric.pair_sum import RADIUS
from canon.scenes.effects.effect import Contribution, Effect, Given, lrl_vector
from canon.scenes.effects.pairs import sum_over_pairs


def _add(given: Given) -> Contribution:
    bodies = given.particles
    if len(bodies) < 2:
        raise given.fail("two bodies or more attract each other: this acts on one")
    G = given.formula("G", default=given.surroundings.constants.get("G", 1))
    softening = given.formula("softening", default=0)
    distance = sp.sqrt(RADIUS**2 + softening**2) if softening != 0 else RADIUS
    potential = sum_over_pairs(-G / distance, bodies, [body.mass for body in bodies])
    lrl = {}
    if len(bodies) == 2 and len(given.surroundings.particles) == 2 and softening == 0 and bodies[0].dimension > 1:
        one, other = bodies
        mass = one.mass * other.mass / (one.mass + other.mass)
        x = tuple(a - b for a, b in zip(one.x, other.x, strict=True))
        p = tuple(mass * (a / one.mass - b / other.mass) for a, b in zip(one.p, other.p, strict=True))
        lrl = lrl_vector(mass, G * one.mass * other.mass, x, p)
    return Contribution(potential=potential, lrl=lrl)


EFFECT: Final = Effect(
    "mutual_gravity", "−G m_i m_j/r_ij for every pair", ("G", "softening"), (), _add, optional=("G", "softening")
)
