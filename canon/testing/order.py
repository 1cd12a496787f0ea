"""The order of an integrator, measured above the rounding plateau, on a problem that is not linear.

Many step sizes, the slope only where errors tell, and an independent reference if there is one: the habits of
DiffEqDevTools.jl.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import finite_number, function, real_array, whole_number, yes_or_no
from canon.numeric.map_shape import required
from canon.testing.assertions import name_of

Array = np.ndarray

PLATEAU: Final = 1e4
"""Differences of fewer roundings than this tell nothing about an order."""

HIGHEST_ORDER: Final = 1000
MOST_STEPS: Final = 2**28
"""The most steps at the finest level."""
AFFINE: Final = 1e-12
"""A step whose second differences are a smaller part of its values is taken to be linear."""


def assert_order(
    step: Callable[[Array, float], Any],
    order: int,
    *,
    start: Sequence[float] | Array,
    duration: float = 1.0,
    steps: int = 8,
    refinements: int = 5,
    tolerance: float = 0.25,
    exact: Sequence[float] | Array | None = None,
    linear: bool = False,
) -> float:
    """An integrator's order, measured on the user's problem, is at least `order − tolerance`.

    The problem is integrated over `duration` in `steps`, 2·`steps`, 4·`steps`, … steps. The order is the slope of the
    errors, against `exact` or between neighbours (self-convergence), as long as these are above the rounding plateau.
    A problem whose steps are linear is refused, unless `linear` says that it is meant: methods may be better than they
    are on those.

    **Arguments:** `step(z, h)`, one step from z, or `step(q, p, h)`.

    **Returns:** the order measured at the finest steps that tell.

    **Raises:** `AssertionError` where it is less; `InputError` where too few errors are above the plateau, or the
    problem is linear.
    """
    from canon.numeric.precision import double

    function(step, "a step", "step")
    order = whole_number(order, "order", 1, HIGHEST_ORDER)
    steps, refinements = whole_number(steps, "steps", 1), whole_number(refinements, "refinements", 1)
    if steps * 2 ** min(refinements, 64) > MOST_STEPS:
        said = f"{steps} steps, doubled {refinements} times, are more than {MOST_STEPS}: take fewer"
        raise InputError(said, "steps, refinements")
    yes_or_no(linear, "linear")
    finite_number(duration, "duration", nonzero=True)
    finite_number(tolerance, "tolerance", least=0.0)
    duration, tolerance = float(duration), float(tolerance)
    if not tolerance < 1:
        raise InputError(f"an order less by 1 is another order: a tolerance is below 1, not {tolerance!r}", "tolerance")
    point = _numbers(start, "start")
    if point.ndim != 1 or not point.size:
        raise InputError(f"a phase point is a list of numbers, not {start!r}", "start")
    if not np.all(np.isfinite(point)):
        raise InputError(f"a phase point is a list of finite numbers, not {start!r}", "start")
    aim = None if exact is None else _aim(exact, point)
    ends = []
    with double():
        one = _of_points(step, point, duration / steps)
        if not linear and _is_affine(one, point, duration / steps):
            raise InputError(
                "the step is linear in z, and on linear problems methods may be better than they are: "
                "take a non-linear one, or say linear=True"
            )
        for level in range(refinements + 1):
            count = steps * 2**level
            z: Any = point.copy()  # a step may change it in place
            for _ in range(count):
                z = one(z, duration / count)
            ends.append(np.array(real_array(z, "step")))
    if not np.all(np.isfinite(ends)):
        raise AssertionError(f"{name_of(step)} does not stay finite over the duration {duration:g}")
    if aim is None:
        errors = [float(np.linalg.norm(b - a)) for a, b in pairwise(ends)]
    else:
        errors = [float(np.linalg.norm(end - aim)) for end in ends]
    if np.array_equal(ends[-1], point):
        raise InputError("the steps don't move it, as at an equilibrium: start elsewhere", "start")
    plateau = PLATEAU * float(np.finfo(float).eps) * (1 + float(np.linalg.norm(ends[-1])))
    telling = _telling(errors, plateau)
    if len(telling) < 2:
        raise InputError(
            f"{len(telling)} errors are above the rounding plateau {plateau:.2g}, two are needed: take fewer steps"
        )
    measured = float(np.log2(telling[-2] / telling[-1]))
    if measured < order - tolerance:
        shown = ", ".join(f"{error:.3g}" for error in telling)
        raise AssertionError(
            f"{name_of(step)} has order {measured:.2f}, not {order}: at halved steps its errors are {shown}"
        )
    return measured


def _numbers(point: Any, where: str) -> Array:
    try:
        return real_array(point, where)
    except InputError as reason:
        raise InputError(f"a phase point is a list of numbers: {reason.message}", where) from reason


def _aim(exact: Any, point: Array) -> Array:
    """The point that is reached exactly. **Raises** `InputError` for what is none."""
    aim = _numbers(exact, "exact")
    if aim.shape != point.shape or not np.all(np.isfinite(aim)):
        raise InputError(f"a phase point like the start is expected, {point.shape[0]} finite numbers", "exact")
    return aim


def _of_points(step: Callable[..., Any], point: Array, h: float) -> Callable[[Array, float], Any]:
    """The step as a function of z and h, where it may be one of q, p and h.

    **Raises:** `InputError` where neither makes a phase point of a phase point; what the step itself raises.
    """

    def of_pair(z: Any, h: float) -> Any:
        n = point.shape[0] // 2
        return np.concatenate([np.ravel(part) for part in step(z[:n], z[n:], h)])

    try:
        moved = np.shape(step(point.copy(), h))
    except TypeError as reason:
        if required(step) != 3:
            raise
        moved = f"a TypeError ({reason})"
    if moved == point.shape:
        return step
    try:
        if np.shape(of_pair(point.copy(), h)) == point.shape:
            return of_pair
    except Exception:  # it was no step of q, p and h
        pass
    raise InputError(f"a step takes a phase point z and h to a phase point: of {point.shape} it makes {moved}")


def _telling(errors: Sequence[float], plateau: float) -> list[float]:
    """The errors up to the first that is below the plateau."""
    telling = []
    for error in errors:
        if error <= plateau:
            break
        telling.append(error)
    return telling


def _is_affine(step: Callable[[Array, float], Any], point: Array, h: float) -> bool:
    """Whether second differences of a step vanish to rounding, over distances that are not small."""
    rng = np.random.default_rng(0)
    for _ in range(3):
        a, b = rng.uniform(0.3, 1.0, (2, *point.shape)) * np.maximum(np.abs(point), 0.1)
        places = (point.copy(), point + a, point + b, point + a + b)
        corners = [np.array(real_array(step(z, h), "step")) for z in places]
        second = corners[3] - corners[2] - corners[1] + corners[0]
        size = max(float(np.abs(corner).max()) for corner in corners)
        if not np.all(np.isfinite(second)) or float(np.abs(second).max()) > AFFINE * size:
            return False
    return True
