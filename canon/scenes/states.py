"""What a run's states say by the bodies' names: their positions and velocities."""

from __future__ import annotations

import numpy as np

from canon.numeric.gradient import gradient
from canon.numeric.observe import observe
from canon.scenes.simulate import Result

Table = dict[str, np.ndarray]


def named_states(result: Result) -> dict[str, Table]:
    """`position` and `velocity` (samples, dimension) by body, v = ∂H/∂p; nothing where there are no bodies.

    A ray's velocity is its slope, the last component 1: its last coordinate is the time.
    """
    bodies, model = result.scene.bodies, result.scene.model
    if not bodies:
        return {}
    velocity = observe(gradient(model.H, model.p), (model.q, model.p, model.t), result.times, result.q, result.p).T
    tables: dict[str, Table] = {"position": {}, "velocity": {}}
    for body in bodies:
        position, rate = result.q[:, body.columns], velocity[:, body.columns]
        if body.ray:
            position, rate = np.column_stack([position, result.times]), np.column_stack([rate, np.ones(len(rate))])
        tables["position"][body.name] = position
        tables["velocity"][body.name] = rate
    return tables
