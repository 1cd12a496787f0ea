"""A magnetic field on charges, m v = p − q A (SI): B in the symmetric gauge, A = B × x/2 where it is uniform."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, Particle, Vector, cross, in_space
from canon.scenes.effects.path_integral import along_rays
from canon.scenes.values import exactly_one


def _add(given: Given) -> Contribution:
    by_field = exactly_one(given.table, ("B", "vector_potential"), given.where) == "B"
    shift = {}
    for body in given.charged:
        A = _gauge(given, body) if by_field else given.vector("vector_potential", body.dimension, body)
        shift[body.name] = tuple(body.charge * component for component in A)
    return Contribution(shift=shift)


def _gauge(given: Given, body: Particle) -> Vector:
    """A = ∫₀¹ s B(s x) × x ds, the Poincaré gauge."""
    B = given.axial("B", body.dimension, body)
    if any(given.surroundings.t in component.free_symbols for component in B):
        raise given.fail("B is constant in time: give a 'vector_potential', whose induced E acts too", "B")
    divergence = sp.Add(*(component.diff(x) for component, x in zip(B, body.x, strict=False)))
    if sp.expand(divergence) != 0:
        raise given.fail(f"no magnetic field has a divergence: this one has {divergence}", "B")
    product = cross(B, in_space(body.x))
    A = [along_rays(component, body.x, 1) for component in product[: body.dimension]]
    if any(component is None for component in A):
        raise given.fail("a field that varies in space is a polynomial in x, y, z here: give a 'vector_potential'", "B")
    return tuple(A)


EFFECT: Final = Effect(
    "magnetic_field",
    "on charges, m v = p − qA: B, constant in time, or the vector_potential, whose induced E acts too",
    ("B", "vector_potential"),
    ("momentum", "angular_momentum", "lrl"),
    _add,
    optional=("B", "vector_potential"),
)
