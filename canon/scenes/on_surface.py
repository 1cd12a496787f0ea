"""Whether a scene begins on its constraints: by numpy, in formulas, before anything is loaded that compiles.

A state is on the surface g(q, t) = 0 where g is so small that a step by the tolerance would lead there, and moves along
it where ∂g/∂q · v + ∂g/∂t is. Of a string, g ≤ 0, only the first is asked: a taut one may become slack at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from canon.numeric.gradient import gradient
from canon.numeric.observe import observe
from canon.scenes.model import Model

TOLERANCE: Final = 1e-8
"""Relative to the largest coordinate, or velocity, and at least 1."""


def faults_at(model: Model, q: Sequence[float], p: Sequence[float], t: float) -> list[str]:
    """What is wrong with a state's constraints: messages, none where it lies on the surface and moves along it."""
    if not model.constraints:
        return []
    place = {symbol: k for k, symbol in enumerate(model.q)}
    velocity = _values(gradient(model.H, tuple(model.p)), model, q, p, t)
    found = list[str]()
    for number, (_, formula) in enumerate(model.constraints, 1):
        own = tuple(sorted(formula.free_symbols & place.keys(), key=place.__getitem__))
        value, *slopes, rate = _values((formula, *gradient(formula, (*own, model.t))), model, q, p, t)
        row, moving = np.array(slopes), np.array([velocity[place[symbol]] for symbol in own])
        steep, speed = float(np.sqrt(row @ row)), float(row @ moving + rate)
        near, slow = TOLERANCE * steep * _size(q), TOLERANCE * steep * _size(velocity)
        if not np.isfinite([value, steep, speed]).all():
            found.append(f"constraint {number}, or how it changes, is not finite there")
        elif number - 1 in model.strings:
            if value > near:
                found.append(f"constraint {number}, a string, is stretched by {value / (steep or 1.0):.3g}")
        else:
            if abs(value) > near:
                found.append(f"constraint {number} is missed by {abs(value):.3g}")
            if abs(speed) > slow:
                found.append(f"the velocity leaves constraint {number} at the rate {abs(speed):.3g}")
    return found


def _values(formulas: Sequence[Any], model: Model, q: Sequence[float], p: Sequence[float], t: float) -> np.ndarray:
    return observe(formulas, (model.q, model.p, model.t), np.array([t]), np.array([q]), np.array([p]))[:, 0]


def _size(values: Sequence[float] | np.ndarray) -> float:
    return max(1.0, float(np.max(np.abs(values))))
