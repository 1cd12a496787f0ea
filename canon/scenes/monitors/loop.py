"""Poincaré's relative invariant ∮ p dq of a small loop that is carried along, and Cartan's ∮ p dq − H dt of states at
different times. The loops are measured with spectral accuracy, with more nodes and smaller as they are stretched; from
when on a loop is no longer resolved is said.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from typing import Final

import numpy as np

from canon.numeric.constraint_tangents import put_on
from canon.numeric.integrators.splitting import SplittingMethod
from canon.numeric.loops import LoopIntegral, loop_integral
from canon.numeric.observe import observe
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.geometry import canonical, onto_attitudes
from canon.scenes.monitors.predicted import conformal_rate, not_hamiltonian
from canon.scenes.monitors.reading import Reading, judged
from canon.scenes.monitors.tangent import contraction_rounding
from canon.scenes.monitors.unsymplectic import condemned

RADII: Final = (1e-2, 1e-4)
"""Of the loop, beside the size of the orbit: the smaller one where the other is stretched too far."""
NODES: Final = (64, 256, 1024)
EARLY: Final = 8
"""The part of the run that says how large the orbit is: one that runs away is larger later than where loops begin."""
COSTLY: Final = 20_000_000_000
"""Operations, of all steps of all nodes together, beyond which no more nodes are tried."""
LOOKS: Final = 33
"""Times at which the loop is measured, at most; `STORED` numbers are kept for that."""
STORED: Final = 20_000_000
SAFETY: Final = 20.0
SHIFT: Final = 0.02
"""Of the times of a loop of Cartan's, beside the run's duration, in steps of the run at most `SHIFT_STEPS`."""
SHIFT_STEPS: Final = 16
PHASE: Final = 0.5
"""With which no node of the loop is at the same time, as steps of length 0 are no steps."""


@dataclass(frozen=True)
class Carried:
    """The integrals of one loop at increasing times, as long as they are resolved, each with what errors of the steps
    may make of it; `blurred` says that these, and no stretching, were larger than the integral in the end."""

    nodes: int
    times: tuple[float, ...]
    integrals: tuple[LoopIntegral, ...]
    slack: tuple[float, ...]
    whole: bool
    blurred: bool


def read_loop(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """∮ p dq from the beginning to the end, or as long as the loop can be resolved."""
    best: Carried | None = None
    for radius, nodes in _attempts(flow):
        found = _carried_along(flow, _small_loop(flow, q, p, nodes, radius), times)
        if best is None or len(found.times) > len(best.times):
            best = found
        if found.whole:
            break
    if best is None or len(best.times) < 2:
        return _lost("loop", flow, best.integrals[0] if best is not None and best.integrals else None)
    return _reading_along(flow, best)


def _attempts(flow: Flow) -> Iterator[tuple[float, int]]:
    """Radii and numbers of nodes; a smaller loop is tried before one with more nodes, as it gains more."""
    for nodes, radius in product(NODES, RADII):
        if nodes == NODES[0] or nodes * flow.steps * flow.operations <= COSTLY:
            yield radius, nodes


def _carried_along(flow: Flow, before: np.ndarray, times: np.ndarray) -> Carried:
    between = max(len(times) - 1, 1)
    finer = max(k for k in range(1, LOOKS // between + 2) if flow.divides(k))
    samples = between * finer + 1 if between * finer * before.size <= STORED else 2
    along = flow.neighbours.along(before, samples)
    rows = np.unique(np.linspace(0, samples - 1, min(LOOKS, samples)).round().astype(int))
    moments = np.linspace(times[0], times[-1], samples)
    seen: list[tuple[float, LoopIntegral, float]] = []
    start, blurred = canonical(flow.model, along[0]), False
    for row in rows:
        points = canonical(flow.model, along[row])
        found, slack = _integral(points, flow, _stretched(points, start)), _slack(flow, points)
        if found is None or not found.resolved:
            break
        if seen and SAFETY * found.bound + _excused(flow, slack) > abs(seen[0][1].value):
            # a bound that is larger than the integral would pass anything
            blurred = slack > SAFETY * found.bound
            break
        seen.append((float(moments[row]), found, slack))
    columns = zip(*seen, strict=True) if seen else ((), (), ())
    return Carried(len(before), *map(tuple, columns), whole=len(seen) == len(rows), blurred=blurred)


def _stretched(points: np.ndarray, start: np.ndarray) -> float:
    """How many times as long a loop has become, in the direction in which it grew most: so much do roundings grow."""
    if not np.isfinite(points).all():
        return 1.0
    now, then = (np.abs(np.diff(x, axis=0, append=x[:1])).sum(axis=0) for x in (points, start))
    return max(1.0, float((now[then > 0] / then[then > 0]).max(initial=1.0)))


def _reading_along(flow: Flow, loop: Carried) -> Reading:
    """The largest drift of the integral, from its first value or from what friction makes of it."""
    values = np.array([each.value for each in loop.integrals])
    first, last = float(values[0]), float(values[-1])
    rounding = SAFETY * (loop.integrals[0].bound + max(each.bound for each in loop.integrals))
    bound = rounding + max(loop.slack)
    extra: dict[str, object] = {"nodes": loop.nodes}
    if not loop.whole:
        why = "the steps' errors are larger than the loop" if loop.blurred else _torn(flow)
        extra |= {"resolved_until": loop.times[-1], "note": f"{why} after t = {loop.times[-1]:.6g}"}
    final = last if loop.whole else None
    if not not_hamiltonian(flow.model):
        drift = float(np.abs(values - first).max())
        reading = judged("loop", "conserved", first, final, drift, bound, **extra)
        return condemned(reading, flow, drift / abs(first), rounding / abs(first))
    expected = f"broken by {not_hamiltonian(flow.model)}"
    rate = conformal_rate(flow.model)
    if rate is None:
        return Reading("loop", expected, first, final, float(np.abs(values - first).max()), extra=extra)
    predicted = first * np.exp(-2 * rate * (np.array(loop.times) - loop.times[0]))
    drift = float(np.abs(values - predicted).max())
    bound += contraction_rounding(flow) * abs(first)
    reading = judged("loop", expected, first, final, drift, bound, predicted=float(predicted[-1]), **extra)
    return condemned(reading, flow, drift / abs(first), rounding / abs(first))


def _torn(flow: Flow) -> str:
    most = max(nodes for _, nodes in _attempts(flow))
    return f"the loop is stretched so much that {most} nodes in double precision no longer resolve it"


def read_cartan(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """∮ p dq − H dt of a loop of states at different times, beside ∮ p dq of the same loop at the beginning."""
    model, run = flow.model, flow.run
    first = last = None
    extended = np.zeros((0, 0))
    for radius, nodes in _attempts(flow):
        before = _small_loop(flow, q, p, nodes, radius)
        steps = min(max(int(SHIFT * flow.steps), 1), SHIFT_STEPS)
        late = steps * run.step * np.sin(2 * np.pi * np.arange(nodes) / nodes + PHASE)
        carried = flow.neighbours.along(before, 2)[-1]
        if not np.isfinite(carried).all():
            continue
        n, moments = model.n, times[-1] + late
        after = flow.neighbours.shifted(carried, late, steps)
        energy = observe([model.H], (model.q, model.p, model.t), moments, after[:, :n], after[:, n:])[0]
        after = canonical(model, after)
        extended = np.column_stack([after[:, :n], late, after[:, n:], -energy])
        first, last = _integral(canonical(model, before), flow), _integral(extended, flow)
        if last is not None and last.resolved:
            break
    if first is None or last is None or not last.resolved:
        return _lost("cartan", flow, first)
    return _reading_cartan(flow, first, last, extended)


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
    early = slice(0, max(2, len(q) // EARLY))
    sizes = [np.abs(x[early]).max(axis=0) for x in (q, p)]
    sizes = [radius * np.where(s > 0.05 * s.max(), s, s.max() if s.max() > 0 else 1.0) for s in sizes]
    angles = [2 * np.pi * np.arange(nodes)[:, None] / nodes + np.arange(x.shape[1]) for x in (q, p)]
    return np.hstack([q[0] + sizes[0] * np.cos(angles[0]), p[0] + sizes[1] * np.sin(angles[1])])


def _integral(points: np.ndarray, flow: Flow, stretched: float = 1.0) -> LoopIntegral | None:
    if not np.isfinite(points).all():
        return None
    unit = 2.0**-52 * np.sqrt(max(flow.steps, 1)) * stretched
    return loop_integral(points, noise=lambda _, nodes: unit * np.abs(nodes))


def _slack(flow: Flow, after: np.ndarray) -> float:
    """What errors of the steps make of ∮ p dq: nothing where each step is a canonical transformation to rounding, as
    those of splittings are, however long they are.
    """
    frictions = all(friction.matrix is not None for friction in flow.model.frictions)
    if isinstance(flow.method, SplittingMethod) and not flow.closed and frictions and not flow.model.brackets:
        return 0.0
    return _error_slack(flow, after)


def _excused(flow: Flow, slack: float) -> float:
    """The slack, of a symplectic method; what others make of areas is judged all the same (`condemned`)."""
    return slack if flow.method.traits.symplectic is True else 0.0


def _error_slack(flow: Flow, after: np.ndarray) -> float:
    """What errors of the states make of the integral, and all the more where the steps aren't symplectic."""
    error = flow.error if flow.error is not None else np.inf
    n = after.shape[1] // 2
    around = np.abs(np.diff(after, axis=0, append=after[:1])).sum(axis=0)
    across = np.ptp(after, axis=0)
    scale = float((around[:n] * across[n:] + around[n:] * across[:n]).sum())
    sizes = np.abs(after).max(axis=0)
    scale += float((around[:n] * sizes[n:]).sum()) if flow.method.traits.symplectic is not True else 0.0
    return SAFETY * error * scale


def _reading_cartan(flow: Flow, first: LoopIntegral, last: LoopIntegral, extended: np.ndarray) -> Reading:
    slack = _error_slack(flow, extended)
    rounding = SAFETY * (first.bound + last.bound)
    bound = rounding + slack
    if rounding + _excused(flow, slack) > abs(first.value):
        # it would pass anything
        note = "the steps' errors are larger than the loop" if slack > rounding else _torn(flow)
        return replace(_lost("cartan", flow, first), extra={"note": note})
    drift = abs(last.value - first.value)
    if not not_hamiltonian(flow.model):
        reading = judged("cartan", "conserved", first.value, last.value, drift, bound, nodes=last.nodes)
        # p dq and H dt nearly cancel along the flow: beside a small loop alone, the error of a few steps would be large
        n = extended.shape[1] // 2
        forms = extended[:, n:] * np.diff(extended[:, :n], axis=0, append=extended[:1, :n])
        size = max(float(np.abs(forms).sum()), abs(first.value))
        return condemned(reading, flow, drift / size, rounding / size)
    expected = f"broken by {not_hamiltonian(flow.model)}"
    return Reading("cartan", expected, first.value, last.value, drift, extra={"nodes": last.nodes})


def _lost(name: str, flow: Flow, first: LoopIntegral | None) -> Reading:
    expected = f"broken by {not_hamiltonian(flow.model)}" if not_hamiltonian(flow.model) else "conserved"
    return Reading(name, expected, None if first is None else first.value, None, None, extra={"note": _torn(flow)})
