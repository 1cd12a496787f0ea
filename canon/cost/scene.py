"""What accuracy costs in a scene: integrators with more and more steps, against a reference that is none of them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.cost.clock import timed
from canon.cost.reference import distance, ordinary, reference_of
from canon.cost.study import ABOVE, Point, Study
from canon.errors import InputError
from canon.numeric.hamilton_equations import hamilton_equations
from canon.numeric.integrate import integrate
from canon.numeric.integrators import catalogue
from canon.numeric.integrators.constrained import Held
from canon.numeric.integrators.measure import symplectic_defect_of_a_step
from canon.numeric.integrators.problem import Field, Splitting
from canon.numeric.loops import loop_integral
from canon.numeric.observe import observe
from canon.numeric.transport import transported
from canon.scenes.model import Model
from canon.scenes.monitors.loop import RADII, small_loop
from canon.scenes.problem import problem_of
from canon.scenes.scene import Scene

USUAL: Final = (
    "verlet", "blanes_moan4", "nystrom4", "blanes_moan6", "nystrom6a", "kahan_li8", "nystrom8", "gauss4", "gauss6",
    "rk4",
)  # fmt: skip
"""Integrators that are compared where none are named: one or two of each order, and those that are not symplectic."""
FIRST_STEPS: Final = 16
MOST_STEPS: Final = 40_000_000
NODES: Final = 64
LOOP_SHARE: Final = 0.5
"""A loop is carried along where all its nodes together are expected to take less than this part of a run's cap."""

Watch = Callable[[str], None]


def cost_of_scene(
    scene: Scene,
    *,
    integrators: Sequence[str] = (),
    cap: float = 1.0,
    measures: Sequence[str] = ("energy", "symplecticity", "loop"),
    patience: float = 20.0,
    most_steps: int = MOST_STEPS,
    watch: Watch | None = None,
) -> Study:
    """Error at the end against seconds, of integrators with steps that are halved until rounding or the cap is met.

    **Arguments:** `integrators`, by name; left out, the usual ones that fit. `cap`, seconds that one run may take;
    `patience`, those that the reference may; `most_steps`, beyond which no run is made.
    `measures`: "energy", the relative error of H; "symplecticity", max |M J Mᵀ − J| of one step; "loop", the relative
    change of ∮ p dq of a small loop. Each is left out where it has no meaning.

    **Raises:** `InputError` for an integrator that there isn't, or that cannot solve the problem.
    """
    if watch:
        watch("the reference")
    found = reference_of(scene, seconds=patience, compared=integrators)
    points: list[Point] = []
    orders: dict[str, int] = {}
    messages: list[str] = []
    for method, value in _methods(scene, integrators):
        if watch:
            watch(method.name)
        orders[method.name] = method.traits.order
        floor = max(found.off, 2.0**-52)
        curve = list(_curve(scene, method, value, (found.q, found.p), cap, measures, floor, most_steps))
        points += curve
        if not curve:
            messages.append(f"{method.name}: no number of steps within {cap:g} s gets to the end")
    return Study(
        "simulate", scene.title or "scene", "steps", "relative, of the state at the end", found.source, found.off,
        tuple(points), orders, tuple(messages),
    )  # fmt: skip


def _methods(scene: Scene, names: Sequence[str]) -> Iterator[tuple[Any, Any]]:
    """The integrators, each with the form of the problem that it takes."""
    model = scene.model
    value = problem_of(model, exact=False).value
    forms: list[Any] = [value]
    if isinstance(value, Splitting) and ordinary(model):
        forces = tuple(sp.Add(*column) for column in zip(*(f.force for f in model.frictions), strict=True))
        forms.append(hamilton_equations(model.H, model.q, model.p, model.t, forces))
    usual = [each.name for each in catalogue.CONSTRAINED] if isinstance(value, Held) else USUAL
    for name in names or usual:
        method = catalogue.method(name)
        form = next((form for form in forms if _takes(method, form)), None)
        if form is not None:
            yield method, form
        elif names:
            raise InputError(f"{name} cannot solve this problem, which is {_words(value)}", "--integrator")


def _takes(method: Any, form: Any) -> bool:
    if isinstance(form, Field) != (method in catalogue.WHOLE):
        return False
    try:
        method.stepper(form)
    except InputError:
        return False
    return True


def _words(value: Any) -> str:
    if isinstance(value, Splitting):
        return "split into solvable parts"
    return "held by constraints" if isinstance(value, Held) else "a vector field that does not split"


def _curve(
    scene: Scene, method: Any, value: Any, exact: tuple[np.ndarray, np.ndarray], cap: float, measures: Sequence[str],
    floor: float, most_steps: int,
) -> Iterator[Point]:  # fmt: skip
    """Points with twice the steps each, until errors no longer fall or a run would take too long."""
    settings = scene.settings
    state = (np.array(scene.q), np.array(scene.p))
    steps, seen = FIRST_STEPS, list[float]()
    begun = time.perf_counter()
    integrate(value, method, state, duration=settings.duration, steps=steps, t0=settings.start)
    compiling = time.perf_counter() - begun
    while steps <= most_steps:

        def run(steps: int = steps) -> Any:
            return integrate(value, method, state, duration=settings.duration, steps=steps, t0=settings.start)

        result, timing = timed(run, cap=cap)
        if timing.median > cap:
            return
        end = tuple(np.asarray(slot) for slot in result.state) if result.completed == result.samples else None
        error = float("inf") if end is None else distance((end[0], end[1]), exact, state)
        if error < 1:  # beyond, nothing is known of the orbit
            first = timing.first + compiling * (not seen)
            point = Point(method.name, steps, error, timing.median, timing.least, first, timing.runs)
            yield replace(point, measures=_measures(scene, method, value, result, timing.median, cap, measures))
        seen.append(error)
        if _settled(seen, floor) or 2 * timing.median > cap:
            return
        steps *= 2


def _settled(errors: Sequence[float], floor: float) -> bool:
    """Whether rounding is met: near the floor, the last two errors are no better than what was there before."""
    if len(errors) < 4 or not np.isfinite(errors[-3:]).all():
        return False
    return min(errors[:-2]) < max(1e-6, ABOVE * floor) and min(errors[-2:]) > 0.5 * min(errors[:-2])


def _measures(
    scene: Scene, method: Any, value: Any, run: Any, seconds: float, cap: float, wanted: Sequence[str]
) -> dict[str, float | None]:
    model, found = scene.model, dict[str, float | None]()
    canonical = ordinary(model) and not model.frictions
    if "energy" in wanted and not model.frictions and model.t not in model.H.free_symbols:
        found["energy"] = _energy_error(model, run)
    if "symplecticity" in wanted and canonical:
        q, p = (np.asarray(slot)[0] for slot in run.stored)
        found["symplecticity"] = symplectic_defect_of_a_step(value, method, (q, p), run.step, t0=run.t0)
    if "loop" in wanted and canonical:
        found["loop"] = _loop_change(scene, method, value, run) if NODES * seconds < LOOP_SHARE * cap else None
    return found


def _energy_error(model: Model, run: Any) -> float:
    q, p = (np.asarray(slot) for slot in run.states)
    begin, end = observe((model.H,), (model.q, model.p, model.t), run.times[: len(q)], q, p)[0][[0, -1]]
    return float(abs(end - begin) / abs(begin) if begin else abs(end))


def _loop_change(scene: Scene, method: Any, value: Any, run: Any) -> float | None:
    """|∮ p dq after − before| / |before| of the larger loop that is resolved; None where none is."""
    q, p = (np.asarray(slot)[:1] for slot in run.stored)
    noise = 2.0**-52 * np.sqrt(run.total)
    for radius in RADII:
        before = small_loop(q, p, NODES, radius)
        after = transported(value, method, before, steps=run.total, duration=run.duration, t0=run.t0, first=len(q[0]))
        if not np.isfinite(after).all():
            continue
        first, last = (loop_integral(x, noise=lambda _, nodes: noise * np.abs(nodes)) for x in (before, after))
        if last.resolved:
            return float(abs(last.value - first.value) / abs(first.value))
    return None
