"""A scatterer at the origin: a potential V(r), whose deflections and cross-section are reported."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import RADIUS, Contribution, Effect, Given, length, lrl_vector
from canon.scenes.model import Formula
from canon.scenes.values import expression

FAR: Final = (1e3, 1e24)
SMALL: Final = 1e-6


def _vanishes(V: Formula) -> bool:
    """Whether V(r) goes to 0 for large r, judged by two values."""
    near, far = (complex(sp.N(V.xreplace({RADIUS: sp.Float(r)}))) for r in FAR)
    return near.imag == far.imag == 0 and abs(near) < float("inf") and abs(far) <= SMALL * abs(near)


def _add(given: Given) -> Contribution:
    if not given.has("potential"):
        raise given.fail("the key 'potential' is missing: V in r, as in potential = \"1/r\"")
    V = expression(given.table["potential"], {**given.surroundings.constants, "r": RADIUS}, given.place("potential"))
    if not _vanishes(V):
        raise given.fail("the potential of a scatterer vanishes far away, faster than the root of 1/r", "potential")
    terms = [V.xreplace({RADIUS: length(particle.x)}) for particle in given.particles]
    k, alone, lrl = sp.simplify(V * RADIUS) if V.is_rational_function(RADIUS) else V, given.particles[0], {}
    if k.is_number and len(given.surroundings.particles) == 1 and alone.dimension > 1 and k != 0:
        lrl = lrl_vector(alone.mass, -k, alone.x, alone.p)
    return Contribution(potential=sp.Add(*terms), lrl=lrl, scatters={particle.name: V for particle in given.particles})


EFFECT: Final = Effect(
    "scatterer",
    "V in r about the origin; the deflection is reported, and a beam's cross-section",
    ("potential",),
    ("momentum", "lrl"),
    _add,
)
