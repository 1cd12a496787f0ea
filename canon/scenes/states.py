"""What a run's states say by the bodies' names: their positions and velocities."""

from __future__ import annotations

import numpy as np
import sympy as sp

from canon.numeric.gradient import gradient
from canon.numeric.observe import observe
from canon.scenes.model import Model
from canon.scenes.simulate import Result

Table = dict[str, np.ndarray]


def named_states(result: Result) -> dict[str, Table]:
    """What bodies and rigid bodies do by their names: `position` and `velocity` (samples, dimension), v = ∂H/∂p.

    A ray's velocity is its slope, the last component 1: its last coordinate is the time.
    """
    bodies, model = result.scene.bodies, result.scene.model
    tables = _turning(result) if model.rigid and model.q else {}
    if not bodies:
        return tables
    moving = model.beside[0] if model.beside else model
    return {**_moving(result, moving), **tables}


def _moving(result: Result, model: Model) -> dict[str, Table]:
    """`position` and `velocity` of point bodies, the first of the coordinates, and the `heading` of those on skates."""
    bodies = result.scene.bodies
    rates = gradient(model.H, model.p)
    if model.gliders:
        places = model.q[: len(model.q) - len(model.gliders)]
        rates = tuple(sp.Add(*model.bracket_terms(x, model.H)) for x in places)
    q, p = result.q[:, : len(model.q)], result.p[:, : len(model.p)]
    velocity = observe(rates, (model.q, model.p, model.t), result.times, q, p).T
    tables: dict[str, Table] = {"position": {}, "velocity": {}}
    for body in bodies:
        position, rate = result.q[:, body.columns], velocity[:, body.columns]
        if body.ray:
            position, rate = np.column_stack([position, result.times]), np.column_stack([rate, np.ones(len(rate))])
        tables["position"][body.name] = position
        tables["velocity"][body.name] = rate
    if model.gliders:
        tables["heading"] = {glider.body.name: result.q[:, model.q.index(glider.heading)] for glider in model.gliders}
    return tables


def own_states(result: Result) -> Table:
    """A system's own names for its state, each with its rows: (samples, components), or (samples,) of one number."""
    model = result.scene.model
    symbols = (model.q, model.p, model.t)
    found = {}
    for name, formulas in result.scene.own.items():
        several = isinstance(formulas, tuple)
        rows = observe(formulas if several else (formulas,), symbols, result.times, result.q, result.p)
        found[name] = rows.T if several else rows[0]
    return found


def _turning(result: Result) -> dict[str, Table]:
    """`rotation` (samples, 3, 3) body to space, `angular_velocity` in the body and `angular_momentum` in space."""
    model = result.scene.model
    tables: dict[str, Table] = {"rotation": {}, "angular_velocity": {}, "angular_momentum": {}}
    for body in model.rigid:
        entries = [entry for row in body.rotation for entry in row]
        symbols = (model.q, model.p, model.t)
        values = observe([*entries, *body.M_in_space], symbols, result.times, result.q, result.p).T
        first = model.p.index(body.M[0])
        tables["rotation"][body.name] = values[:, :9].reshape(-1, 3, 3)
        tables["angular_velocity"][body.name] = result.p[:, first : first + 3] / np.array(
            [float(moment) for moment in body.moments]
        )
        tables["angular_momentum"][body.name] = values[:, 9:]
    return tables
