"""A rotating frame: Coriolis's and the centrifugal force, in one term."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, cross, dot, in_space


def _add(given: Given) -> Contribution:
    if given.surroundings.is_system:
        raise given.fail("a rotating frame is one of bodies")
    terms = []
    for body in given.particles:
        Omega = given.axial("Omega", body.dimension)
        terms.append(-dot(Omega, cross(in_space(body.x), in_space(body.p))))
    return Contribution(generator=sp.expand(sp.Add(*terms)))


EFFECT: Final = Effect(
    "rotating_frame", "−Ω·M: the energy's place is taken by Jacobi's integral", ("Omega",), ("momentum",), _add
)
