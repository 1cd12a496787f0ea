"""The skate on an incline of the catalogue, whose state has names of its own."""

from __future__ import annotations

from typing import Any

import numpy as np
import sympy as sp

from canon.claims import document
from canon.claims.document import Table, key
from canon.scenes.assemble import Named
from canon.scenes.bodies import Start
from canon.scenes.effects.effect import Contribution, Particle
from canon.scenes.model import Model
from canon.scenes.skates import KIND, Blade
from canon.scenes.systems import WHERE, named_system, read_parameters
from canon.scenes.values import needed, number, numbers


def read_skate(table: Table) -> tuple[Start, tuple[Named, ...]]:
    """The skate of the catalogue, a [system] with keys of its own, and the effects on it. **Raises:** `InputError`."""
    document.only(table, ("name", "parameters", "position", "heading", "speed", "turning"), WHERE)
    system = named_system(table)
    values, _, _ = read_parameters(system, table)
    place = numbers(needed(table, "position", WHERE), key("position", WHERE), [2])
    heading, speed, turning = (
        float(number(needed(table, word, WHERE), key(word, WHERE))) for word in ("heading", "speed", "turning")
    )
    x, y, px, py = (sp.Symbol(name, real=True) for name in ("x", "y", "px", "py"))
    body = Particle(system.name, (x, y), (px, py), values["m"])
    velocity = (sp.Float(speed * np.cos(heading)), sp.Float(speed * np.sin(heading)))
    gravity = Contribution(potential=-values["m"] * values["g"] * x)
    blade = Contribution(blades={body.name: Blade(heading, turning, float(values["I"]))})
    return Start(body, place, velocity, None), (("uniform_gravity", gravity), (KIND, blade))


def own_names(model: Model) -> dict[str, Any]:
    """The system's own names for its state."""
    (glider,) = model.gliders
    rate = glider.turning / glider.blade.moment
    return {"speed": glider.P / glider.body.mass, "turning": rate, "heading": glider.heading, "position": glider.body.x}
