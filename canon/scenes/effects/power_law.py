"""A power of the distance from a fixed centre."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, length, square


def _add(given: Given) -> Contribution:
    n = given.formula("n")
    if not n.is_number:
        raise given.fail("the exponent is a number", "n")
    terms = []
    for particle in given.particles:
        r = given.from_centre(particle)
        power = square(r) ** (n / 2) if n.is_even else length(r) ** n
        terms.append(given.formula("a", particle) * power)
    return Contribution(potential=sp.Add(*terms))


EFFECT: Final = Effect("power_law", "a rⁿ", ("a", "n", "centre"), ("momentum", "lrl"), _add, optional=("centre",))
