"""∫ ωᵏ/k!, ω = Σ dp∧dq, over surfaces that a scene's flow carries along: Poincaré's absolute invariants of any order.

A flow that keeps ω keeps its powers, so the monitor `symplecticity` implies them all where the flow is differentiable,
at one orbit. Here they are measured on whole pieces of surfaces, with spectral accuracy and nodes added as these are
stretched; where nodes no longer resolve a surface, that is what is said. Arnold (1989), section 44.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from canon.claims.invariance_report import Invariance
from canon.errors import InputError
from canon.numeric.images import compare_surfaces
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.predicted import conformal_rate
from canon.scenes.simulate import Result

Array = np.ndarray
Surface = Callable[[Array], Array]
BLOCKS: Final = (256, 4096)
"""So many points are carried along together: a program is compiled for a number of points."""
SIZE: Final = 1e-2
MOST_POINTS: Final = 2**16


def run_map(result: Result) -> Callable[[Array], Array]:
    """The flow of a scene's whole run, from its first stored state to its last one, by the very steps of its
    integrator: a map of phase points (…, 2n) with q before p, as `surface_invariant` and `loop_invariant` take them.

    **Raises:** `InputError` where the state is not (q, p), or is held by constraints.
    """
    model, run, first = result.scene.model, result.planned.run, result.q.shape[1]
    flow = Flow(model, result.problem.value, result.choice.method, run, result.planned.good, result.planned.error)
    if model.constraints or model.brackets or model.beside or result.q.shape != result.p.shape or len(run.states) != 2:
        raise InputError("surfaces are carried along in canonical variables of one system, without constraints")
    if not flow.followed:
        raise InputError(f"the steps of {result.choice.method.name} are not ours to carry surfaces along with")
    neighbours = flow.neighbours

    def after(points: Array) -> Array:
        flat = np.asarray(points, dtype=float).reshape(-1, 2 * first)
        block = BLOCKS[0] if len(flat) <= BLOCKS[0] else BLOCKS[1]
        found = np.empty_like(flat)
        for begin in range(0, len(flat), block):
            piece = flat[begin : begin + block]
            filled = np.concatenate([piece, np.broadcast_to(piece[:1], (block - len(piece), 2 * first))])
            found[begin : begin + block] = neighbours.along(filled, 2)[-1][: len(piece)]
        return found.reshape(np.shape(points))

    return after


def cell(result: Result, order: int, size: float = SIZE) -> Surface:
    """A piece of a surface of 2k dimensions about the first state: in the planes (q_i, p_i), i = 1 … k, a rectangle of
    this part of the orbit's size, and bent a little into the other planes.
    """
    start, n = np.concatenate([result.q[0], result.p[0]]), result.q.shape[1]
    sizes = np.concatenate([np.abs(x).max(axis=0) for x in (result.q, result.p)])
    sizes = size * np.where(sizes > 0.05 * sizes.max(), sizes, sizes.max() or 1.0)

    def surface(u: Array) -> Array:
        moved = np.zeros((len(u), 2 * n))
        for i in range(order):
            moved[:, i], moved[:, n + i] = u[:, 2 * i] - 0.5, u[:, 2 * i + 1] - 0.5
        for i in range(order, n):
            moved[:, i], moved[:, n + i] = 0.3 * moved[:, 0] * moved[:, n], 0.3 * moved[:, n]
        return start + sizes * moved

    return surface


def absolute_invariants(
    result: Result,
    orders: Sequence[int] | None = None,
    *,
    surface: Surface | None = None,
    periodic: Sequence[bool] | None = None,
    most_points: int = MOST_POINTS,
) -> tuple[Invariance, ...]:
    """∫ ωᵏ/k! over surfaces of 2k dimensions at the beginning of a run, and over what its flow makes of them.

    Where all friction is of one rate λ, areas decay as exp(−2λt), and the invariant of order k as exp(−2kλt): that is
    the `factor` which is expected.

    **Arguments:** `orders`, those that are asked for: 1 and 2 (as far as there are two degrees of freedom) where left
    out; each further one needs some hundred times the points. `surface`, with `periodic`, as `surface_invariant` takes
    them, in place of the `cell` about the first state: then its dimension says the order. `most_points` on one grid.

    **Returns:** for each order an `Invariance`: `preserved` is None where the nodes don't resolve the image any more.

    **Raises:** `InputError` where the state is not (q, p), or held by constraints; where an order is not one of 1 … n;
    where friction leaves no prediction.
    """
    carry, n, model = run_map(result), result.q.shape[1], result.scene.model
    rate = conformal_rate(model) if model.frictions else 0.0
    if rate is None:
        raise InputError("friction of several rates changes each surface in its own way: no order has a prediction")
    span = float(result.times[-1] - result.times[0])
    if surface is not None:
        if periodic is None or len(periodic) % 2 or not periodic:
            raise InputError("for each of a surface's 2, 4, … directions, whether it closes", "periodic")
        asked: list[tuple[int, Surface, Sequence[bool]]] = [(len(periodic) // 2, surface, periodic)]
    else:
        wanted = range(1, min(n, 2) + 1) if orders is None else orders
        for order in wanted:
            if not 1 <= order <= n:
                raise InputError(f"an order is one of 1 to {n}, not {order}", "orders")
        asked = [(order, cell(result, order), (False,) * (2 * order)) for order in wanted]
    found = []
    for order, piece, closes in asked:
        factor = math.exp(-2 * order * rate * span)
        compared = compare_surfaces(carry, piece, closes, factor=factor, most_points=most_points)
        found.append(Invariance("∬ dp∧dq" if order == 1 else f"∫ ω^{order}/{order}!", compared))
    return tuple(found)
