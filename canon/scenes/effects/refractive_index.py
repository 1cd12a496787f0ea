"""A medium for rays of light: their optical Hamiltonian, with the axis in the place of time."""

from __future__ import annotations

from typing import Final

from canon.scenes.effects.effect import Contribution, Effect, Given


def _add(given: Given) -> Contribution:
    index = {}
    for ray in given.particles:
        if ray.dimension == 1:
            raise given.fail("a ray has 2 or 3 components: those across the axis, and the last one along it")
        n = given.formula("n", ray)
        if n.has(given.surroundings.t):
            raise given.fail("a refractive index depends on the place alone", "n")
        if n.is_number and not n.is_positive:
            raise given.fail(f"a refractive index is above 0, not {n}", "n")
        index[ray.name] = n
    return Contribution(index=index)


EFFECT: Final = Effect(
    "refractive_index",
    "makes rays of bodies: −√(n² − p²), n in x, y, z, the last axis in the place of time",
    ("n",),
    ("energy", "momentum", "angular_momentum"),
    _add,
)
