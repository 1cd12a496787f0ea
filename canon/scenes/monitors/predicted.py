"""What theory says of broken invariants: how friction contracts phase space, areas in it, and loops."""

from __future__ import annotations

import numpy as np
import sympy as sp

from canon.numeric.observe import observe
from canon.scenes.model import Formula, Model
from canon.scenes.skates import KIND as SKATE


def volume_exponent(model: Model, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> tuple[float, float]:
    """∫ tr ∂F/∂p dt along the orbit, and how far the quadrature may be off: exact where the trace is constant."""
    traces = [F.diff(y) for friction in model.frictions for F, y in zip(friction.force, model.p, strict=True)]
    divergence = sp.expand(sp.Add(*traces))
    if divergence.is_number:
        return float(divergence) * float(times[-1] - times[0]), 0.0
    values = observe([divergence], (model.q, model.p, model.t), times, q, p)[0]
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


def conformal_rate(model: Model) -> float | None:
    """The λ with which areas Σ dp∧dq contract as exp(−2λt): one rate for all momenta, and no vector potential."""
    rates: list[Formula] = [friction.rate for friction in model.frictions]
    if (
        model.gliders
        or any(rate is None for rate in rates)
        or any(value != 0 for friction in model.frictions for value in friction.rest)
    ):
        return None
    return float(sp.Add(*rates))


def not_hamiltonian(model: Model) -> str:
    """The effects that make the flow none of a Hamiltonian, frictions and skates; nothing where there are none."""
    skates = (SKATE,) if model.gliders else ()
    return ", ".join(dict.fromkeys((*(friction.effect for friction in model.frictions), *skates)))
