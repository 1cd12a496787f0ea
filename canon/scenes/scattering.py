"""What a scatterer did: each body's deflection, and the cross-section of a beam."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi, sqrt
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.numeric.deflection import (
    Deflection,
    cross_section,
    deflection,
    rutherford,
    rutherford_cross_section,
)
from canon.numeric.lower import lower
from canon.numeric.precision import double
from canon.scenes.model import Formula
from canon.scenes.scene import Body, Scene

KIND: Final = "scatterer"


@dataclass(frozen=True)
class Scattered:
    """A body's energy and impact parameter, as they are far away, and its deflection.

    That is the angle χ between the directions from which it comes and into which it goes, positive where it is
    repelled; None where the body is bound, falls into the centre, or where more acts than the scatterer. `turned` is
    the angle between its first and last momentum in the run, `cross_section` dσ/dΩ at this energy and impact parameter.
    """

    turned: float
    energy: float | None = None
    impact_parameter: float | None = None
    deflection: Deflection | None = None
    cross_section: float | None = None

    @property
    def angle(self) -> float | None:
        """The angle in [0, π] between the two directions, whichever way round."""
        if self.deflection is None:
            return None
        chi = abs(self.deflection.angle)
        return chi if chi <= pi else abs(chi - 2 * pi * round(chi / (2 * pi)))


def scattered(scene: Scene, p: np.ndarray) -> dict[str, Scattered]:
    """By the names of the bodies that a scatterer acts on; p (samples, n) are the stored momenta."""
    beam = len(scene.model.scatters) > 1
    bodies = {body.name: body for body in scene.bodies}
    with double():
        return {name: _of(scene, bodies[name], V, p, beam) for name, V in scene.model.scatters.items()}


def _of(scene: Scene, body: Body, V: Formula, p: np.ndarray, beam: bool) -> Scattered:
    x0, p0 = (np.array(values)[body.columns] for values in (scene.q, scene.p))
    turned = _between(p[0, body.columns], p[-1, body.columns])
    radius = float(np.linalg.norm(x0))
    if not _alone(scene) or body.dimension == 1:
        return Scattered(turned)
    (r,) = V.free_symbols or {sp.Symbol("r", positive=True)}
    value, slope = (_function(formula, r) for formula in (V, V.diff(r)))
    mass = float(body.mass)
    E = float(p0 @ p0) / (2 * mass) + float(value(np.array([radius]))[0])
    if not E > 0:
        return Scattered(turned, E)
    moment = _wedge(x0, p0)
    b = moment / sqrt(2 * mass * E)
    k = sp.simplify(V * r) if V.is_rational_function(r) else V
    if k.is_number and k != 0:
        if k < 0 and b == 0:
            return Scattered(turned, E, b)
        sigma = rutherford_cross_section(float(k), E, b) if beam else None
        return Scattered(turned, E, b, rutherford(float(k), E, b), sigma)
    of = lambda parameter: deflection(value, slope, E, parameter, radius)
    found = of(b)
    sigma = cross_section(of, b, found.nearest) if beam and found is not None else None
    return Scattered(turned, E, b, found, sigma)


def _alone(scene: Scene) -> bool:
    """Whether nothing acts but one scatterer: then energy and moment of each body are conserved."""
    model = scene.model
    kinetic = sp.Add(*(y**2 / (2 * m) for y, m in zip(model.p, model.mass, strict=True)))
    effects: Mapping[str, Any] = {term.effect: term.expr for term in model.terms}
    return (
        {*effects} <= {"kinetic", KIND}
        and len(model.terms) == len(effects)
        and not model.frictions
        and not model.constraints
        and effects["kinetic"] == kinetic
    )


def _function(formula: Formula, r: sp.Symbol) -> Any:
    function = lower((formula,), (r,))
    return lambda values: np.array(np.broadcast_to(np.asarray(function(values)[0], dtype=float), np.shape(values)))


def _wedge(x: np.ndarray, p: np.ndarray) -> float:
    """|x × p|, in a plane or in space."""
    plane = np.outer(x, p)
    return float(np.linalg.norm(plane - plane.T) / sqrt(2))


def _between(one: np.ndarray, other: np.ndarray) -> float:
    """The angle of two vectors in [0, π], with all its digits at both ends. Kahan."""
    a, b = (vector / max(float(np.linalg.norm(vector)), 1e-300) for vector in (one, other))
    return float(2 * np.arctan2(np.linalg.norm(a - b), np.linalg.norm(a + b)))
