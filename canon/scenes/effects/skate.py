"""A skate, or knife edge: a body that does not move sideways. The constraint is not holonomic, and not variational."""

from __future__ import annotations

from typing import Final

from canon.errors import InputError
from canon.scenes.effects.effect import Contribution, Effect, Given
from canon.scenes.skates import Blade


def _add(given: Given) -> Contribution:
    bodies = given.particles
    if given.has("body"):
        if given.has("bodies"):
            raise given.fail("both 'body' and 'bodies' are given")
        named = given.table["body"]
        bodies = tuple(body for body in bodies if body.name == named)
        if not bodies:
            known = ", ".join(body.name for body in given.surroundings.particles)
            raise given.fail(f"there is no body {str(named)[:80]!r}: the bodies are {known}", "body")
    if any(body.dimension != 2 for body in bodies):
        raise InputError("a skate runs in a plane: give positions with 2 components", given.where)
    heading = _number(given, "heading") if given.has("heading") else None
    moment = _number(given, "moment", 1)
    if not moment > 0:
        raise given.fail("a moment of inertia is above 0", "moment")
    blade = Blade(heading, _number(given, "turning", 0), moment)
    return Contribution(blades={body.name: blade for body in bodies})


def _number(given: Given, name: str, default: int | None = None) -> float:
    found = given.formula(name, default=default)
    if not found.is_number:
        raise given.fail("a number is expected", name)
    return float(found)


EFFECT: Final = Effect(
    "skate",
    "a body that moves along its heading alone; the heading turns at a constant rate",
    ("body", "heading", "turning", "moment"),
    ("momentum", "angular_momentum", "symplecticity", "loop", "cartan"),
    _add,
    optional=("body", "heading", "turning", "moment"),
    hamiltonian=False,
)
