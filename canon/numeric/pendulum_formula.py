"""Recognises a pendulum: p²/2I − k cos(aq + b), whose motion is known in elliptic functions for every energy."""

from __future__ import annotations

import math
from typing import Any, Final

import sympy as sp

from canon.numeric.integrators.problem import ExactPart, Splitting, State

SOURCE: Final = "Whittaker (1937), Analytical Dynamics, 44; Lawden (1989), Elliptic Functions and Applications, 5.1"


def pendulum_of(H: Any, q: sp.Symbol, p: sp.Symbol) -> Splitting | None:
    """The motion of H as one part, on slots (q, p), arrays (1, …); None where H is no pendulum with numbers alone."""
    expanded: Any = sp.expand(H)
    inverse = 2 * expanded.coeff(p, 2)
    rest = sp.expand(expanded - inverse * p**2 / 2)
    waves = [term for term in sp.Add.make_args(rest) if term.has(q)]
    if not (inverse.is_number and inverse.is_positive) or rest.has(p) or len(waves) != 1:
        return None
    if any(not term.is_number for term in sp.Add.make_args(rest) if term != waves[0]):
        return None
    strength, cosine = waves[0].as_independent(q)
    if not isinstance(cosine, sp.cos) or not (strength.is_number and strength.is_real):
        return None
    wave: Any = cosine.args[0]
    slope, shift = wave.diff(q), wave.subs(q, 0)
    if not (slope.is_number and slope.is_real and shift.is_number and shift.is_real) or slope == 0:
        return None
    # the angle is counted from where it hangs
    turned = float(shift) + (math.pi if strength > 0 else 0.0)
    return Splitting((_part(float(slope), turned, 1 / float(inverse * slope**2), abs(float(strength))),))


def _part(slope: float, shift: float, inertia: float, strength: float) -> ExactPart:
    def flow(state: State, h: Any, t: Any) -> State:
        from canon.numeric.exact.pendulum import pendulum

        q, p, *others = state
        angle, momentum = pendulum(slope * q + shift, p / slope, h, inertia=inertia, strength=strength)
        return ((angle - shift) / slope, momentum * slope, *others)

    return ExactPart(flow, name="pendulum")
