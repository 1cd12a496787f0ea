"""Poincaré's relative invariant ∮ p dq of a small loop that is carried along, and Cartan's ∮ p dq − H dt of states at
different times. The loops are measured with spectral accuracy; one that is stretched beyond its nodes is said to be.
"""

from __future__ import annotations

from itertools import product
from typing import Final

import numpy as np

from canon.numeric.constraint_tangents import put_on
from canon.numeric.loops import LoopIntegral, loop_integral
from canon.numeric.observe import observe
from canon.numeric.transport import shifted, transported
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.geometry import canonical, onto_attitudes
from canon.scenes.monitors.predicted import conformal_rate, not_hamiltonian
from canon.scenes.monitors.reading import Reading, judged

RADII: Final = (1e-2, 1e-4)
"""Of the loop, beside the size of the orbit: the smaller one where the other is stretched too far."""
NODES: Final = (64, 256, 1024)
SAFETY: Final = 20.0
SHIFT: Final = 0.02
"""Of the times of a loop of Cartan's, beside the run's duration, in steps of the run at most `SHIFT_STEPS`."""
SHIFT_STEPS: Final = 16
PHASE: Final = 0.5
"""With which no node of the loop is at the same time, as steps of length 0 are no steps."""


def read_loop(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """∮ p dq at the beginning and at the end."""
    first = last = None
    after = np.zeros((0, 0))
    for radius, nodes in product(RADII, NODES):
        before = _small_loop(flow, q, p, nodes, radius)
        after = canonical(flow.model, _carried(flow, before))
        first, last = _integral(canonical(flow.model, before), flow), _integral(after, flow)
        if last is not None and last.resolved:
            break
    if first is None or last is None or not last.resolved:
        return _lost("loop", flow, first)
    return _reading("loop", flow, times, first, last, _slack(flow, after))


def read_cartan(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """∮ p dq − H dt of a loop of states at different times, beside ∮ p dq of the same loop at the beginning."""
    model, run = flow.model, flow.run
    first = last = None
    extended = np.zeros((0, 0))
    for radius, nodes in product(RADII, NODES):
        before = _small_loop(flow, q, p, nodes, radius)
        steps = min(max(int(SHIFT * flow.steps), 1), SHIFT_STEPS)
        late = steps * run.step * np.sin(2 * np.pi * np.arange(nodes) / nodes + PHASE)
        carried = _carried(flow, before)
        if not np.isfinite(carried).all():
            continue
        n, moments = model.n, times[-1] + late
        after = shifted(flow.problem, flow.method, carried, late, steps=steps, t0=float(times[-1]), first=n)
        energy = observe([model.H], (model.q, model.p, model.t), moments, after[:, :n], after[:, n:])[0]
        after = canonical(model, after)
        extended = np.column_stack([after[:, :n], late, after[:, n:], -energy])
        first, last = _integral(canonical(model, before), flow), _integral(extended, flow)
        if last is not None and last.resolved:
            break
    if first is None or last is None or not last.resolved:
        return _lost("cartan", flow, first)
    return _reading("cartan", flow, times, first, last, _slack(flow, extended))


def _small_loop(flow: Flow, q: np.ndarray, p: np.ndarray, nodes: int, radius: float) -> np.ndarray:
    """A loop of states that are possible: with unit quaternions for the attitudes of rigid bodies, and on a constraint
    surface where there is one.
    """
    loop = small_loop(q, p, nodes, radius)
    if flow.model.constraints:
        return put_on(flow.problem, loop, flow.run.t0)
    return onto_attitudes(flow.model, loop)


def small_loop(q: np.ndarray, p: np.ndarray, nodes: int, radius: float) -> np.ndarray:
    """A loop (nodes, N) about the first state: an ellipse in every plane (q_i, p_i), each with another phase."""
    sizes = [np.abs(x).max(axis=0) for x in (q, p)]
    sizes = [radius * np.where(s > 0.05 * s.max(), s, s.max() if s.max() > 0 else 1.0) for s in sizes]
    angles = [2 * np.pi * np.arange(nodes)[:, None] / nodes + np.arange(x.shape[1]) for x in (q, p)]
    return np.hstack([q[0] + sizes[0] * np.cos(angles[0]), p[0] + sizes[1] * np.sin(angles[1])])


def _carried(flow: Flow, points: np.ndarray) -> np.ndarray:
    run = flow.run
    steps = max(flow.steps, 1)
    return transported(
        flow.problem,
        flow.method,
        points,
        steps=steps,
        duration=steps * run.step,
        t0=run.t0,
        first=flow.model.n,
    )


def _integral(points: np.ndarray, flow: Flow) -> LoopIntegral | None:
    if not np.isfinite(points).all():
        return None
    unit = 2.0**-52 * np.sqrt(max(flow.steps, 1))
    return loop_integral(points, noise=lambda _, nodes: unit * np.abs(nodes))


def _slack(flow: Flow, after: np.ndarray) -> float:
    """What errors of the steps make of the integral, and all the more where it isn't symplectic."""
    error = flow.error if flow.error is not None else np.inf
    n = after.shape[1] // 2
    around = np.abs(np.diff(after, axis=0, append=after[:1])).sum(axis=0)
    across = np.ptp(after, axis=0)
    scale = float((around[:n] * across[n:] + around[n:] * across[:n]).sum())
    sizes = np.abs(after).max(axis=0)
    scale += float((around[:n] * sizes[n:]).sum()) if flow.method.traits.symplectic is not True else 0.0
    return SAFETY * error * scale


def _reading(
    name: str, flow: Flow, times: np.ndarray, first: LoopIntegral, last: LoopIntegral, slack: float
) -> Reading:
    bound = SAFETY * (first.bound + last.bound) + slack
    drift = abs(last.value - first.value)
    extra = {"nodes": last.nodes}
    if not not_hamiltonian(flow.model):
        return judged(name, "conserved", first.value, last.value, drift, bound, **extra)
    expected = f"broken by {not_hamiltonian(flow.model)}"
    rate = conformal_rate(flow.model)
    if rate is None or name == "cartan":
        return Reading(name, expected, first.value, last.value, drift, extra=extra)
    predicted = first.value * float(np.exp(-2 * rate * (times[-1] - times[0])))
    drift = abs(last.value - predicted)
    return judged(name, expected, first.value, last.value, drift, bound, predicted=predicted, **extra)


def _lost(name: str, flow: Flow, first: LoopIntegral | None) -> Reading:
    expected = f"broken by {not_hamiltonian(flow.model)}" if not_hamiltonian(flow.model) else "conserved"
    note = f"the loop is stretched so much that {NODES[-1]} nodes no longer resolve it"
    return Reading(name, expected, None if first is None else first.value, None, None, extra={"note": note})
