"""A spring between two bodies."""

from __future__ import annotations

from typing import Final

from canon.scenes.effects.effect import Contribution, Effect, Given
from canon.scenes.effects.spring import stretched


def _add(given: Given) -> Contribution:
    if len(given.particles) != 2:
        raise given.fail('a coupling spring joins two bodies: name them, as in bodies = ["a", "b"]', "bodies")
    one, other = given.particles
    apart = tuple(x - y for x, y in zip(one.x, other.x, strict=True))
    return Contribution(potential=stretched(given.formula("k"), apart, given.formula("length", default=0)))


EFFECT: Final = Effect(
    "coupling_spring", "k(|x_i − x_j| − l)²/2 between two bodies", ("k", "length"), (), _add, optional=("length",)
)
