"""What theory says of broken invariants: how friction contracts phase space, areas in it, and loops."""

from __future__ import annotations

import numpy as np
import sympy as sp

from canon.numeric.constraint_tangents import tangent_places
from canon.numeric.observe import observe
from canon.scenes.model import Formula, Model
from canon.scenes.monitors.flow import Flow
from canon.scenes.skates import KIND as SKATE


def volume_exponent(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> tuple[float, float]:
    """∫ tr ∂F/∂p dt along the orbit, and how far the quadrature may be off: exact where the trace is constant.

    On a constraint surface the trace is that along it: −tr (EᵀM E)⁻¹ EᵀαE for the velocities E that are allowed.
    """
    model = flow.model
    if model.constraints:
        values = _along_surface(flow, times, q)
        if values is None:
            rate = conformal_rate(model, any_rest=True) or 0.0
            free = model.n - len(model.constraints)
            return -2 * rate * free * float(times[-1] - times[0]), 0.0
        return _integral(values, times)
    traces = [F.diff(y) for friction in model.frictions for F, y in zip(friction.force, model.p, strict=True)]
    divergence = sp.expand(sp.Add(*traces))
    if divergence.is_number:
        return float(divergence) * float(times[-1] - times[0]), 0.0
    return _integral(observe([divergence], (model.q, model.p, model.t), times, q, p)[0], times)


def _along_surface(flow: Flow, times: np.ndarray, q: np.ndarray) -> np.ndarray | None:
    """The trace at every state; None for one rate for all, with which it is constant."""
    model = flow.model
    if all(friction.rate is not None for friction in model.frictions):
        return None
    masses = np.diag([float(m) for m in model.mass])
    D = sum(np.array(friction.matrix, dtype=float) for friction in model.frictions)
    E = tangent_places(flow.problem, q, times)
    inertia, resistance = (np.swapaxes(E, 1, 2) @ A @ E for A in (masses, D @ masses))
    return -np.trace(np.linalg.solve(inertia, resistance), axis1=1, axis2=2)


def _integral(values: np.ndarray, times: np.ndarray) -> tuple[float, float]:
    """∫ of values at equal distances, and how far it may be off."""
    fine = _trapezoid(values, times)
    if len(times) < 5 or len(times) % 2 == 0:
        return fine, abs(fine)
    coarse = _trapezoid(values[::2], times[::2])
    return fine + (fine - coarse) / 3, abs(fine - coarse)


def contracting(model: Model) -> tuple[str, ...]:
    """The effects whose forces have a divergence: a torque that does not depend on momenta has none."""
    return tuple(
        dict.fromkeys(
            friction.effect
            for friction in model.frictions
            if sp.expand(sp.Add(*(F.diff(y) for F, y in zip(friction.force, model.p, strict=True)))) != 0
        )
    )


def _trapezoid(values: np.ndarray, times: np.ndarray) -> float:
    return float(((values[1:] + values[:-1]) / 2 * np.diff(times)).sum())


def conformal_rate(model: Model, *, any_rest: bool = False) -> float | None:
    """The λ with which areas Σ dp∧dq contract as exp(−2λt): one rate for all momenta, and no vector potential, which is
    of no importance to phase volume (`any_rest`).
    """
    rates: list[Formula] = [friction.rate for friction in model.frictions]
    if (
        model.gliders
        or any(rate is None for rate in rates)
        or (not any_rest and any(value != 0 for friction in model.frictions for value in friction.rest))
    ):
        return None
    return float(sp.Add(*rates))


def not_hamiltonian(model: Model) -> str:
    """The effects that make the flow none of a Hamiltonian, frictions and skates; nothing where there are none."""
    skates = (SKATE,) if model.gliders else ()
    return ", ".join(dict.fromkeys((*(friction.effect for friction in model.frictions), *skates)))
