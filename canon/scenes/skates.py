"""Bodies on skates: their state, and what effects do along their headings.

A skate's heading α is part of the state. With the momentum P along it in place of p_x and p_y the equations of motion
have the form of brackets that are no Poisson brackets: {x, P} = cos α, {y, P} = sin α, {α, p_α} = 1. So the energy is
kept, phase volume is too where there is no friction, and canonical invariants are not. Ledger 4.17, sec-6-c.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.numeric.gradient import gradient
from canon.numeric.integrators.problem import Splitting
from canon.numeric.integrators.skate import Gliding
from canon.numeric.skate_formula import gliding_bodies
from canon.scenes.model import Bracket, Formula, Friction, Model, Term

if TYPE_CHECKING:
    from canon.scenes.bodies import Start
    from canon.scenes.effects.effect import Contribution, Particle, Surroundings

KIND: Final = "skate"
SIDEWAYS: Final = 1e-9
"""A part of the velocity across the heading, beside its size, that rounding may have made."""


@dataclass(frozen=True)
class Blade:
    """The heading at the beginning (None: that of the velocity), the rate of its turning, and its moment of inertia."""

    heading: float | None
    turning: float
    moment: float


@dataclass(frozen=True)
class Glider:
    """A body on a skate: its heading α, P along it, and p_α, as symbols."""

    body: Particle
    blade: Blade
    heading: sp.Symbol
    P: sp.Symbol
    turning: sp.Symbol

    @property
    def momentum(self) -> tuple[Formula, ...]:
        """m v."""
        return (self.P * sp.cos(self.heading), self.P * sp.sin(self.heading))

    @property
    def brackets(self) -> tuple[Bracket, ...]:
        """The brackets of its coordinates that are not 0."""
        x, y = self.body.x
        return (
            (x, self.P, sp.cos(self.heading)),
            (y, self.P, sp.sin(self.heading)),
            (self.heading, self.turning, sp.S.One),
        )


def gliders_of(particles: Sequence[Particle], effects: Sequence[tuple[str, Contribution]]) -> tuple[Glider, ...]:
    """The bodies that are on skates."""
    blades = {name: blade for _, part in effects for name, blade in part.blades.items()}
    found = []
    for body in particles:
        if body.name in blades:
            suffix = body.x[0].name[1:]
            names = (f"alpha{suffix}", f"P{suffix}", f"p_alpha{suffix}")
            found.append(Glider(body, blades[body.name], *(sp.Symbol(name, real=True) for name in names)))
    return tuple(found)


def model_of_skates(surroundings: Surroundings, effects: Sequence[tuple[str, Contribution]]) -> Model:
    """The model of bodies of which some are on skates. **Raises:** `InputError` for what can't be joined with one."""
    _check(surroundings, effects)
    bodies, t = surroundings.particles, surroundings.t
    gliders = {glider.body.name: glider for glider in gliders_of(bodies, effects)}
    on_skates = gliders.values()
    p: list[sp.Symbol] = []
    momenta: list[tuple[Formula, ...]] = []
    brackets: list[Bracket] = []
    kinetic: list[Formula] = []
    for body in bodies:
        glider = gliders.get(body.name)
        own = (glider.P,) if glider is not None else body.p
        p += own
        momenta.append(glider.momentum if glider is not None else body.p)
        brackets += glider.brackets if glider is not None else zip(body.x, body.p, [sp.S.One] * 2, strict=True)
        kinetic.append(sp.Add(*(y**2 for y in own)) / (2 * body.mass))
    turned = sp.Add(*(glider.turning**2 / (2 * sp.Float(glider.blade.moment)) for glider in on_skates))
    potentials = [Term(kind, part.potential) for kind, part in effects if part.potential != 0]
    q = (*(x for body in bodies for x in body.x), *(glider.heading for glider in on_skates))
    p += [glider.turning for glider in on_skates]
    frictions = []
    for kind, part in effects:
        if part.rates:
            rates = [part.rates.get(body.name, sp.S.Zero) for body in bodies for _ in _own(body, gliders)]
            rates += [sp.S.Zero] * len(gliders)
            force = tuple(-2 * rate * y for rate, y in zip(rates, p, strict=True))
            frictions.append(Friction(kind, force, sp.diag(*(2 * rate for rate in rates)).as_immutable()))
    crossed = sp.Add(*(x[0] * y[1] - x[1] * y[0] for x, y in zip((b.x for b in bodies), momenta, strict=True)))
    return Model(
        q,
        tuple(p),
        t,
        (Term("kinetic", sp.Add(*kinetic)), Term(KIND, turned), *potentials),
        tuple(frictions),
        momenta={f"P_{axis}": sp.Add(*column) for axis, column in zip("xy", zip(*momenta, strict=True), strict=True)},
        angular_momenta={"M": crossed},
        brackets=tuple(brackets),
        mass=tuple(body.mass for body in bodies),
        gliders=tuple(on_skates),
    )


def _own(body: Particle, gliders: dict[str, Glider]) -> tuple[Any, ...]:
    return (gliders[body.name].P,) if body.name in gliders else body.p


def _check(surroundings: Surroundings, effects: Sequence[tuple[str, Contribution]]) -> None:
    if surroundings.relativistic:
        raise InputError("a skate has no relativistic dynamics: it is a rigid edge", "dynamics")
    for kind, part in effects:
        if part.constraints or part.resistance is not None or part.shift or part.generator != 0:
            word = "a matrix of damping" if part.resistance is not None else f"the effect {kind!r}"
            raise InputError(f"{word} together with a skate is not available in this version", "effect")


def start_of_skates(
    starts: Sequence[Start], effects: Sequence[tuple[str, Contribution]]
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """q and p at the beginning. **Raises:** `InputError` where a body moves sideways."""
    gliders = {glider.body.name: glider for glider in gliders_of([start.particle for start in starts], effects)}
    q = [float(x) for start in starts for x in start.position]
    p, headings, turnings = list[float](), list[float](), list[float]()
    for index, start in enumerate(starts, 1):
        body = start.particle
        given = start.velocity if start.momentum is None else start.momentum
        scale = float(body.mass) if start.momentum is None else 1.0
        momentum = scale * np.array([float(part) for part in given or (0, 0)])
        glider = gliders.get(body.name)
        if glider is None:
            p += momentum.tolist()
            continue
        size = float(np.hypot(*momentum))
        alpha = glider.blade.heading
        if alpha is None:
            alpha = float(np.arctan2(momentum[1], momentum[0])) if size > 0 else 0.0
        along, across = momentum @ [np.cos(alpha), np.sin(alpha)], momentum @ [-np.sin(alpha), np.cos(alpha)]
        if abs(across) > SIDEWAYS * size:
            raise InputError(f"its skate does not move sideways: the velocity is not along {alpha:g}", f"body {index}")
        p.append(float(along))
        headings.append(alpha)
        turnings.append(glider.blade.moment * glider.blade.turning)
    return (*q, *headings), (*p, *turnings)


def skate_splitting(model: Model) -> Splitting:
    """The free motion of all bodies, friction, and one kick along the headings."""
    by_place = {glider.body.x[0]: glider for glider in model.gliders}
    bodies, momentum = [], 0
    for index, mass in enumerate(map(float, model.mass)):
        place = 2 * index
        glider = by_place.get(model.q[place])
        if glider is None:
            bodies.append(Gliding(mass, place, momentum))
            momentum += 2
            continue
        heading, turning = model.q.index(glider.heading), model.p.index(glider.turning)
        bodies.append(Gliding(mass, place, momentum, heading, turning, glider.blade.moment))
        momentum += 1
    V = sp.Add(*(term.expr for term in model.terms if not term.expr.free_symbols & {*model.p}))
    slope = dict(zip(model.q, gradient(V, model.q), strict=True))
    kicks = [-sp.Add(*(b * slope[u] for u, v, b in model.brackets if v == y)) for y in model.p]
    damping: Any = sp.zeros(len(model.p), len(model.p))
    for friction in model.frictions:
        damping += friction.matrix
    rates = [float(damping[k, k]) / 2 for k in range(len(model.p))] if model.frictions else None
    return gliding_bodies(bodies, kicks, (*model.q, model.t), rates)
