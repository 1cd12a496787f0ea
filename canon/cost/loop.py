"""What the digits of ∮ p dq cost: nodes of a loop that a scene's flow carries along, by spectral quadrature and, as it
used to be done, by a polygon. What it must be is known: the loop is an ellipse in every plane at the beginning, and a
Hamiltonian flow keeps the integral (Poincaré).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from canon.cost.clock import timed
from canon.cost.reference import ordinary
from canon.cost.study import Point, Study
from canon.errors import InputError
from canon.numeric.loops import loop_integral
from canon.numeric.transport import transported
from canon.scenes.monitors.loop import small_loop
from canon.scenes.problem import problem_of
from canon.scenes.scene import Scene
from canon.scenes.simulate import simulate

RADIUS: Final = 1e-2
NODES: Final = (8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096)

Watch = Callable[[str], None]


def cost_of_loop(scene: Scene, *, cap: float = 5.0, counts: Sequence[int] = NODES, watch: Watch | None = None) -> Study:
    """The relative error of ∮ p dq at the end of a scene, against seconds, for loops of more and more nodes.

    **Arguments:** `cap`, seconds that one loop may take; `counts`, of nodes.

    **Raises:** `InputError` where the scene has no canonical variables, or friction: then nothing keeps the integral.
    """
    model = scene.model
    if not ordinary(model) or model.frictions:
        raise InputError(
            "∮ p dq is kept by Hamiltonian motion in canonical variables: this scene has others, or friction"
        )
    if watch:
        watch("the step")
    result = simulate(scene)
    run, method = result.planned.run, result.choice.method
    value = problem_of(model, exact=scene.settings.integrator is None).value
    q, p = np.array([scene.q]), np.array([scene.p])
    exact = _area(q, p)
    points: list[Point] = []
    for nodes in counts:
        if watch:
            watch(f"{nodes} nodes")
        before = small_loop(q, p, nodes, RADIUS)

        def carry(before: np.ndarray = before) -> np.ndarray:
            return transported(
                value, method, before, steps=run.total, duration=run.duration, t0=run.t0, first=model.n
            )  # fmt: skip

        after, timing = timed(carry, cap=cap)
        if not np.isfinite(after).all():
            continue
        for name, rule in (("spectral", _spectral), ("polygon", _polygon)):
            error = abs(rule(after) - exact) / abs(exact)
            points.append(Point(name, nodes, error, timing.median, timing.least, timing.first, timing.runs))
        if 2 * timing.median > cap:
            break
    what = "∮ p dq of the ellipse at the beginning, in closed form"
    floor = _rounding(run.total)
    return Study(
        "loop", scene.title or "scene", "nodes", "relative, of ∮ p dq at the end", what, floor, tuple(points),
        {"polygon": 2}, _messages(result),
    )  # fmt: skip


def _messages(result: Any) -> tuple[str, ...]:
    error = result.planned.error
    reached = "unknown" if error is None else f"{error:.1e}"
    return (f"carried by {result.choice.method.name} with {result.planned.run.total} steps, error {reached}",)


def _rounding(steps: int) -> float:
    """What rounding leaves of a loop whose area is `RADIUS`² of that of the states, after so many steps."""
    return float(2.0**-52 * np.sqrt(max(steps, 1)) / RADIUS**2)


def _area(q: np.ndarray, p: np.ndarray) -> float:
    """∮ p dq of `small_loop`, −π times the half axes of each plane: of a cos(θ + k), b sin(θ + k) in the k-th."""
    n = q.shape[1]
    corners = small_loop(q, p, 4, RADIUS) - np.hstack([q, p])
    shift = np.cos(np.arange(n))
    return float(-np.pi * np.sum(corners[0, :n] * corners[1, n:] / shift**2))


def _spectral(points: np.ndarray) -> float:
    return loop_integral(points).value


def _polygon(points: np.ndarray) -> float:
    """Σ (p_k + p_{k+1})/2 · (q_{k+1} − q_k)."""
    n = points.shape[1] // 2
    after = np.roll(points, -1, axis=0)
    return float(np.sum((points[:, n:] + after[:, n:]) / 2 * (after[:, :n] - points[:, :n])))
