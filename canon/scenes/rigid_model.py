"""Assembles rigid bodies and the effects on them into a model, and into what an integrator takes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from canon.numeric.rigid_formula import rigid_bodies_under
from canon.scenes.effects.effect import Contribution
from canon.scenes.model import Friction, Model, Term
from canon.scenes.rigid import RigidBody

KINETIC = "kinetic"
NEEDS_ATTITUDE = frozenset({"angular_momentum", "loop", "cartan"})
"""Monitors that follow the attitude."""


def model_of_rigid_bodies(
    bodies: Sequence[RigidBody], effects: Sequence[tuple[str, Contribution]], t: sp.Symbol
) -> Model:
    """H = Σ M²/2I + potentials of the attitudes, and torques that have no potential."""
    terms = [Term(KINETIC, sp.Add(*(body.kinetic for body in bodies)))]
    terms += [Term(kind, part.potential) for kind, part in effects if part.potential != 0]
    q, p = (tuple(x for body in bodies for x in getattr(body, word)) for word in ("attitude", "M"))
    torques = [
        Friction(kind, tuple(K for body in bodies for K in part.torques.get(body.name, (sp.S.Zero,) * 3)))
        for kind, part in effects
        if part.torques
    ]
    totals = zip(*(body.M_in_space for body in bodies), strict=True)
    single = len(bodies) == 1
    return Model(
        q,
        p,
        t,
        tuple(terms),
        tuple(torques),
        angular_momenta={f"M_{axis}": sp.Add(*column) for axis, column in zip("xyz", totals, strict=True)},
        rigid=tuple(bodies),
        brackets=tuple(bracket for body in bodies for bracket in body.brackets),
        casimirs={"M^2" if single else f"M^2 of {body.name}": sp.Add(*(M**2 for M in body.M)) for body in bodies},
    )


def without_attitude(model: Model, monitors: Collection[str]) -> Model:
    """Euler's equations alone, where neither a force nor a monitor depends on the attitude; else the model itself."""
    called = {symbol for term in model.terms for symbol in term.expr.free_symbols}
    called |= {symbol for torque in model.frictions for K in torque.force for symbol in K.free_symbols}
    if called & {*model.q} or NEEDS_ATTITUDE & {*monitors}:
        return model
    own = tuple(bracket for bracket in model.brackets if not {*bracket[:2]} & {*model.q})
    return replace(model, q=(), angular_momenta={}, brackets=own)


def rigid_splitting(model: Model, closed: bool = True) -> Any:
    """The free motion of all bodies, and one kick of all torques; where there is none in closed form, or not."""
    rates = []
    V = sp.Add(*(term.expr for term in model.terms if term.effect != KINETIC))
    for k, M in enumerate(model.p):
        own = [bracket * V.diff(a) for a, v, bracket in model.brackets if v == M]
        rates.append(-sp.Add(*own) + sp.Add(*(torque.force[k] for torque in model.frictions)))
    moments = [[float(I) for I in body.moments] for body in model.rigid]
    return rigid_bodies_under(rates, moments, model.q, model.t, closed=closed)
