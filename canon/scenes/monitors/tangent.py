"""Symplecticity ‖M J Mᵀ − J‖ and volume det M − 1 of the flow's Jacobian M, from the beginning to the end of the run.

With one friction rate λ for all, M J Mᵀ = exp(−2λt) J; det M = exp ∫ tr ∂F/∂p dt always. Of rigid bodies M is the
derivative in turns of the body and changes of its angular momentum, and J their Lie–Poisson bracket. On a constraint
surface M takes tangent vectors to tangent vectors, and the form that is induced there is compared.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from canon.numeric.integrators.splitting import SplittingMethod
from canon.numeric.pfaffians import powers
from canon.numeric.transport import flow_differences
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.geometry import Frame, carried, frame_at, frame_on_surface, onto_attitudes
from canon.scenes.monitors.predicted import conformal_rate, contracting, not_hamiltonian, volume_exponent
from canon.scenes.monitors.reading import Reading, judged
from canon.scenes.monitors.unsymplectic import area_change, condemned

SAFETY: Final = 64.0
ROUNDING: Final = 2.0**-53
CONTRACTIONS: Final = 32.0
"""Roundings of the factors by which friction contracts in one step, which are the same in every step, and so add up."""
COARSEST: Final = 1e-2
"""Where rounding alone is larger than this, nothing can be said."""
LARGEST_FOR_ORDERS: Final = 4
"""Degrees of freedom up to which every order is looked at: there are 2·4ⁿ⁻¹ coefficients."""


def read_symplecticity(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """How far M J Mᵀ is from J, or from exp(−2λt) J, and so do the powers of both, which are Poincaré's invariants of
    every order: an M that keeps J keeps them all.
    """
    before, after = _frames(flow, q, p)
    M, rounding, error = _tangent(flow, q, p, before, after)
    kept, J = carried(before, after, M)
    value = float(np.abs(kept - J).max())
    if not not_hamiltonian(flow.model):
        orders = order_drifts(kept, J, rounding + error)
        reading = _judged("symplecticity", "conserved", value, value, rounding, error, **orders)
        return condemned(reading, flow, area_change(kept, J), rounding)
    expected = f"broken by {not_hamiltonian(flow.model)}"
    rate = conformal_rate(flow.model)
    if rate is None:
        return Reading("symplecticity", expected, 0.0, value, value, extra=order_drifts(kept, J, np.inf))
    factor = float(np.exp(-2 * rate * (times[-1] - times[0])))
    drift = float(np.abs(kept - factor * J).max())
    rounding += contraction_rounding(flow) * factor * float(np.abs(J).max())
    orders = order_drifts(kept, factor * J, rounding + error)
    reading = _judged("symplecticity", expected, value, drift, rounding, error, predicted=1 - factor, **orders)
    return condemned(reading, flow, area_change(kept, factor * J), rounding)


def read_volume(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """det M − 1, and what friction makes of it."""
    before, after = _frames(flow, q, p)
    M, rounding, error = _tangent(flow, q, p, before, after)
    sign, log = np.linalg.slogdet(M)
    if before.form:
        # the bases of two tangent spaces have no common orientation
        sign, log = 1.0, log + np.log(after.density / before.density)
    value = float(sign * np.exp(log) - 1)
    # a determinant's relative error grows with the condition of M; the steps' errors are in the other bound
    rounding = len(M) * SAFETY * ROUNDING * float(np.linalg.cond(M)) * np.sqrt(max(flow.steps, 1))
    error *= len(M)
    if not contracting(flow.model):
        reading = _judged("volume", "conserved", value, abs(value), rounding, error)
        return condemned(reading, flow, abs(value), rounding)
    exponent, off = volume_exponent(flow, times, q, p)
    predicted = float(np.expm1(exponent))
    drift = abs(float(sign * np.exp(log - exponent)) - 1)
    error += 4 * off + len(M) * contraction_rounding(flow)
    expected = f"broken by {', '.join(contracting(flow.model))}"
    reading = _judged("volume", expected, value, drift, rounding, error, predicted=predicted)
    return condemned(reading, flow, drift, rounding + 4 * off)


def order_drifts(kept: np.ndarray, expected: np.ndarray, off: float) -> dict[str, list[dict[str, float | int | None]]]:
    """For k = 1 … n the largest coefficient of keptᵏ/k! − expectedᵏ/k! of two antisymmetric matrices (2n, 2n), and what
    entries off by `off` explain of it; nothing of odd matrices, and of those with too many powers.
    """
    size = len(kept)
    if size % 2 or not 0 < size <= 2 * LARGEST_FOR_ORDERS:
        return {}
    found: list[dict[str, float | int | None]] = []
    for order, ((is_, bounds), (should, _)) in enumerate(zip(powers(kept, off), powers(expected), strict=True), 1):
        worst = int(np.argmax(np.abs(is_ - should)))
        bound = float(bounds.max()) if np.isfinite(off) else None
        found.append({"order": order, "max_drift": float(abs(is_[worst] - should[worst])), "bound": bound})
    return {"orders": found}


def contraction_rounding(flow: Flow) -> float:
    """How far, relatively, an area may be from exp(−2λt) of what it was, as the steps' factors are rounded."""
    return CONTRACTIONS * ROUNDING * max(flow.steps, 1)


def _judged(
    name: str, expected: str, value: float, drift: float, rounding: float, error: float, **extra: Any
) -> Reading:
    if not rounding < COARSEST:
        extra["note"] = "the tangent map has grown so large that rounding hides the answer"
        return Reading(name, expected, 0.0, value, None, None, "", extra)
    bound = rounding + error
    return judged(name, expected, 0.0, value, drift, bound if np.isfinite(bound) else None, **extra)


def _frames(flow: Flow, q: np.ndarray, p: np.ndarray) -> tuple[Frame, Frame]:
    """At the first state and at the last one."""
    states = [np.concatenate([q[k], p[k]]) for k in (0, -1)]
    if flow.model.constraints:
        times = flow.run.times[0], flow.run.times[flow.good - 1]
        first, last = (frame_on_surface(flow.problem, z, float(t)) for z, t in zip(states, times, strict=True))
    else:
        first, last = (frame_at(flow.model, z) for z in states)
    return first, last


def _tangent(flow: Flow, q: np.ndarray, p: np.ndarray, before: Frame, after: Frame) -> tuple[np.ndarray, float, float]:
    """M, and how far M J Mᵀ may be off: by rounding, and by the steps' errors where the method isn't symplectic."""
    if flow.closed:
        return _by_differences(flow, q, p, before, after)
    M = after.dual @ flow.jacobian @ before.basis
    size = float(np.linalg.norm(M, 2)) ** 2
    rounding = SAFETY * ROUNDING * size * float(np.sqrt(max(flow.steps, 1)))
    # friction that is linear is a part of its own, whose flow contracts areas exactly
    kept = flow.method.traits.symplectic is True and all(f.matrix is not None for f in flow.model.frictions)
    # only sums of exact flows keep brackets that are not constant
    if kept and (not flow.model.brackets or isinstance(flow.method, SplittingMethod)):
        return M, rounding, 0.0
    return M, rounding, SAFETY * (flow.error if flow.error is not None else np.inf) * size


def _by_differences(
    flow: Flow, q: np.ndarray, p: np.ndarray, before: Frame, after: Frame
) -> tuple[np.ndarray, float, float]:
    """The same of a flow in closed form; what differences leave out counts as an error."""
    run, steps, start = flow.run, max(flow.steps, 1), np.concatenate([q[0], p[0]])
    size = float(np.abs(p[0]).max()) or 1.0
    scale = np.where(np.arange(len(start)) < q.shape[1], 1.0, size)
    directions = scale * before.basis.T

    def curves(s: np.ndarray) -> np.ndarray:
        return onto_attitudes(flow.model, start + s[:, None, None] * directions)

    slopes, off = flow_differences(
        flow.problem,
        flow.method,
        curves,
        first=q.shape[1],
        steps=steps,
        duration=steps * run.step,
        t0=run.t0,
    )
    lengths = np.linalg.norm(before.basis.T * scale, axis=1) / np.linalg.norm(before.basis.T, axis=1)
    M = after.dual @ slopes / lengths
    whole = float(np.linalg.norm(M, 2))
    rounding = SAFETY * ROUNDING * whole**2 * float(np.sqrt(steps))
    return M, rounding, SAFETY * (off + ROUNDING / 1e-3) * whole * max(1.0, 1 / size)
