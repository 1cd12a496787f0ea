"""A massless rod between two bodies, or from a body to an anchor: their distance is fixed."""

from __future__ import annotations

from typing import Final

from canon.scenes.effects.effect import Contribution, Effect, Given, square


def distance(given: Given) -> Contribution:
    """The constraint (|x − x_a|² − l²)/2 of a rod, or a string. **Raises:** `InputError`."""
    length = given.formula("length")
    if not (length.is_number and length.is_positive):
        raise given.fail(f"the length of a {given.kind} is a number above 0", "length")
    bodies = given.particles
    if len(bodies) == 2 and not given.has("anchor"):
        one, other = bodies
        apart = tuple(x - y for x, y in zip(one.x, other.x, strict=True))
        return Contribution(constraints=((square(apart) - length**2) / 2,))
    if len(bodies) != 1:
        raise given.fail(f"a {given.kind} joins two bodies, or one to an anchor: name them in 'bodies'")
    return Contribution(constraints=((square(given.from_centre(bodies[0], "anchor")) - length**2) / 2,))


EFFECT: Final = Effect(
    "rod",
    "holds two bodies, or one and an anchor, at a distance; its reaction is a multiplier",
    ("length", "anchor"),
    ("momentum", "lrl"),
    distance,
    optional=("anchor",),
)
