"""Rays of light: bodies in a medium, followed along the last axis, which takes the place of time.

A ray x⊥(z) makes ∫ n ds = ∫ n √(1 + x⊥'²) dz stationary, so that p = n x⊥'/√(1 + x⊥'²) = n sin(angle), and
H = −√(n² − p²) = −n cos(angle). Goldstein, Classical Mechanics, 10.8; ledger S25.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import sympy as sp

from canon.errors import InputError
from canon.scenes.assemble import Named
from canon.scenes.bodies import Start
from canon.scenes.effects.effect import AXES, Surroundings, square
from canon.scenes.model import Model, Term
from canon.scenes.own_hamiltonian import angular_momenta

KIND: Final = "refractive_index"
CLOSE: Final = 1e-9
"""How far a momentum that is given may be from the length n, beside n."""


def names_rays(effects: Any) -> bool:
    """Whether a list of effects, as it stands in a file, makes rays of bodies."""
    tables = effects if isinstance(effects, list) else []
    return any(isinstance(table, dict) and table.get("kind") == KIND for table in tables)


def are_rays(effects: Sequence[Named]) -> bool:
    """Whether the bodies are rays."""
    return any(part.index for _, part in effects)


def rays_of(
    starts: Sequence[Start], surroundings: Surroundings, effects: Sequence[Named]
) -> tuple[Model, tuple[tuple[float, ...], tuple[float, ...]], float]:
    """The model of rays, their initial (q, p) across the axis, and where on the axis they begin.

    **Raises:** `InputError` where other effects act too, a body is no ray, or no ray goes this way from here.
    """
    n = _indices(starts, surroundings, effects)
    axis = sp.Symbol(AXES[starts[0].particle.dimension - 1], real=True)
    begin = starts[0].position[-1]
    if any(start.position[-1] != begin for start in starts):
        raise InputError("all rays begin at the same place of the last axis, which is their time", "body")
    terms, q, p = [], list[float](), list[float]()
    for number, (start, index) in enumerate(zip(starts, n, strict=True), 1):
        ray = start.particle
        here = index.xreplace(dict(zip(ray.x, start.position, strict=True)))
        if not (here.is_number and here.is_positive):
            raise InputError("the refractive index is not above 0 where the ray begins", f"body {number}")
        terms.append(-sp.sqrt(index.xreplace({ray.x[-1]: axis}) ** 2 - square(ray.p[:-1])))
        q += map(float, start.position[:-1])
        p += map(float, _momentum(start, here, f"body {number}"))
    places = [start.particle.x[:-1] for start in starts]
    momenta = [start.particle.p[:-1] for start in starts]
    total = {f"P_{name}": sp.Add(*column) for name, column in zip("xy", zip(*momenta, strict=True), strict=False)}
    model = Model(
        tuple(symbol for place in places for symbol in place),
        tuple(symbol for each in momenta for symbol in each),
        axis,
        (Term(KIND, sp.Add(*terms)),),
        momenta=total,
        angular_momenta=angular_momenta(places, momenta),
    )
    return model, (tuple(q), tuple(p)), float(begin)


def _indices(starts: Sequence[Start], surroundings: Surroundings, effects: Sequence[Named]) -> list[Any]:
    """The refractive index of each ray."""
    if surroundings.relativistic:
        raise InputError("rays have no kinetic energy: leave 'dynamics' out", "dynamics")
    for place, (kind, part) in enumerate(effects, 1):
        if not part.index:
            raise InputError(f"the effect {kind!r} acts on bodies, and these are rays", f"effect {place}")
    found = []
    for start in starts:
        given = [part.index[start.particle.name] for _, part in effects if start.particle.name in part.index]
        if len(given) != 1:
            what = "no refractive index" if not given else "two refractive indices"
            raise InputError(f"{what} for {start.particle.name!r}: each ray has one, and there is nothing but rays")
        found.append(given[0])
    return found


def _momentum(start: Start, n: Any, where: str) -> tuple[Any, ...]:
    """p across the axis, from the ray's direction (`velocity`), or from n times the unit vector along it."""
    if start.momentum is not None:
        if abs(float(sp.sqrt(square(start.momentum)) / n) - 1) > CLOSE or not start.momentum[-1] > 0:
            raise InputError(
                f"a ray's momentum has the length n = {float(n):.10g}, and its last component is above 0: "
                "or give its direction, as 'velocity'",
                where,
            )
        return start.momentum[:-1]
    direction: tuple[Any, ...] = start.velocity or ()
    if not any(component != 0 for component in direction):
        return (sp.S.Zero,) * (len(direction) - 1)
    if not direction[-1] > 0:
        raise InputError("a ray goes forwards along the last axis: the last component is above 0", where)
    return tuple(n * component / sp.sqrt(square(direction)) for component in direction[:-1])
