"""What a run's states say by the bodies' names: their positions and velocities."""

from __future__ import annotations

import numpy as np

from canon.numeric.observe import observe
from canon.scenes.simulate import Result

Table = dict[str, np.ndarray]


def named_states(result: Result) -> dict[str, Table]:
    """`position` and `velocity` (samples, dimension) by body, v = ∂H/∂p; nothing where there are no bodies."""
    bodies, model = result.scene.bodies, result.scene.model
    if not bodies:
        return {}
    velocity = observe(
        [model.H.diff(y) for y in model.p], (model.q, model.p, model.t), result.times, result.q, result.p
    ).T
    tables: dict[str, Table] = {"position": {}, "velocity": {}}
    for body in bodies:
        columns = slice(body.first, body.first + body.dimension)
        tables["position"][body.name] = result.q[:, columns]
        tables["velocity"][body.name] = velocity[:, columns]
    return tables
