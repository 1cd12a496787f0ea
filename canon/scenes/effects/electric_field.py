"""An electric field on charges, by its strength or its potential."""

from __future__ import annotations

from typing import Final

import sympy as sp

from canon.scenes.effects.effect import Contribution, Effect, Given, Particle, dot
from canon.scenes.effects.path_integral import along_rays
from canon.scenes.model import Formula
from canon.scenes.values import exactly_one


def _add(given: Given) -> Contribution:
    if exactly_one(given.table, ("E", "potential"), given.where) == "potential":
        terms = [body.charge * given.formula("potential", body) for body in given.charged]
    else:
        terms = [-body.charge * _work(given, body) for body in given.charged]
    return Contribution(potential=sp.Add(*terms))


def _work(given: Given, body: Particle) -> Formula:
    """∫ E·dx from the origin."""
    E = given.vector("E", body.dimension, body)
    for i, x in enumerate(body.x):
        for j, y in enumerate(body.x[:i]):
            if sp.expand(E[i].diff(y) - E[j].diff(x)) != 0:
                raise given.fail("this field has a curl, so it has no potential: give a vector_potential instead", "E")
    found = along_rays(dot(E, body.x), body.x, 0)
    if found is None:
        raise given.fail("a field that varies in space is a polynomial in x, y, z here: give its 'potential'", "E")
    return found


EFFECT: Final = Effect(
    "electric_field",
    "on charges: the strength E, uniform or a polynomial in x, y, z, or the potential",
    ("E", "potential"),
    ("momentum", "angular_momentum", "lrl"),
    _add,
    optional=("E", "potential"),
)
