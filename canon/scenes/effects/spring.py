"""A spring from each body to an anchor, which may move uniformly."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, Vector, length, square


def stretched(k: object, r: Vector, rest: object) -> sp.Expr:
    """k(|r| − l)²/2, without a root where l = 0."""
    return k * square(r) / 2 if rest == 0 else k * (length(r) - rest) ** 2 / 2  # pyright: ignore[reportOperatorIssue]


def _add(given: Given) -> Contribution:
    terms = []
    for particle in given.particles:
        r = given.from_centre(particle, "anchor")
        if given.has("anchor_velocity"):
            velocity = given.vector("anchor_velocity", particle.dimension)
            r = tuple(x - v * given.surroundings.t for x, v in zip(r, velocity, strict=True))
        terms.append(stretched(given.formula("k", particle), r, given.formula("length", default=0)))
    return Contribution(potential=sp.Add(*terms))


EFFECT: Final = Effect(
    "spring",
    "k(|x − x_a| − l)²/2 to an anchor x_a, which moves with anchor_velocity",
    ("k", "anchor", "length", "anchor_velocity"),
    ("momentum", "lrl"),
    _add,
    optional=("anchor", "length", "anchor_velocity"),
)
