"""A smooth surface, or a curve, on which bodies move; it may itself move."""

from __future__ import annotations

from typing import Final

from canon.scenes.effects.effect import Contribution, Effect, Given


def _add(given: Given) -> Contribution:
    found = []
    for body in given.particles:
        equation = given.formula("equation", body)
        if not equation.free_symbols & {*body.x}:
            raise given.fail("the equation of a surface is one in x, y, z", "equation")
        found.append(equation)
    return Contribution(constraints=tuple(found))


EFFECT: Final = Effect(
    "surface",
    "holds bodies on the surface where the equation, in x, y, z, t, is 0",
    ("equation",),
    ("momentum", "angular_momentum", "lrl"),
    _add,
)
