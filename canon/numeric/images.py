"""Integral invariants before and after a map, each beside a bound on its rounding.

How far a map's values are off isn't known of a black box: it is estimated from how much they differ at points a few
roundings away, which shows how the map amplifies rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.loops import Loop, LoopIntegral, loop_integral, real, shortest
from canon.numeric.precision import UNIT
from canon.numeric.surfaces import Surface, SurfaceIntegral, surface_integral

Array = Any  # numpy arrays
Map = Callable[[Array], Array]

ULPS: Final = 8.0
MOVED: Final = 4.0
SAFETY: Final = 4.0
DRAWS: Final = 2


@dataclass(frozen=True)
class Comparison:
    """An integral before and after a map that should multiply it by `factor`."""

    before: LoopIntegral | SurfaceIntegral
    after: LoopIntegral | SurfaceIntegral
    factor: float = 1.0

    @property
    def difference(self) -> float:
        """The integral after the map, less `factor` times that before it."""
        return self.after.value - self.factor * self.before.value

    @property
    def bound(self) -> float:
        """A bound on the difference's rounding; for a map that isn't given by formulas, an estimate."""
        return self.after.bound + abs(self.factor) * self.before.bound

    @property
    def resolved(self) -> bool:
        """Whether the nodes resolve both: otherwise the difference has no meaning."""
        return self.before.resolved and self.after.resolved

    @property
    def preserved(self) -> bool | None:
        """Whether the difference is within its bound; None where it isn't resolved, so that nothing is known."""
        return abs(self.difference) <= self.bound if self.resolved else None


def rounding_of(evaluate: Map, periods: Sequence[float | None] = (), unit: float = UNIT) -> Callable[[Array], Array]:
    """An estimate of the rounding of a map's values at points (N, m), of the same shape as these values."""

    def noise(points: Array) -> Array:
        values = evaluate(points)
        rng = np.random.default_rng(0)
        spread = np.zeros_like(values)
        for _ in range(DRAWS):
            moved = points * (1 + MOVED * unit * rng.choice([-1.0, 1.0], points.shape))
            spread = np.maximum(spread, np.abs(shortest(evaluate(moved) - values, periods)))
        return ULPS * unit * np.abs(values) + SAFETY * spread

    return noise


def compare_loops(
    map: Map,  # noqa: A002 - the field's own word
    loop: Loop | Array,
    *,
    factor: float = 1.0,
    periods: Sequence[float | None] = (),
    new_periods: Sequence[float | None] = (),
    most_nodes: int = 65536,
    unit: float = UNIT,
) -> Comparison:
    """∮ p dq around the loop, and around its image under a map of points (N, 2n) that rounds to `unit`."""
    before = loop_integral(loop, periods=periods, most_nodes=most_nodes)
    noise = rounding_of(map, new_periods, unit)
    if not callable(loop):
        nodes = real(loop)
        after = _of_image(lambda: loop_integral(map(nodes), periods=new_periods, noise=lambda *_: noise(nodes)))
    else:
        after = _of_image(
            lambda: loop_integral(
                lambda s: map(loop(s)),
                periods=new_periods,
                noise=lambda s, _: noise(loop(s)),
                most_nodes=most_nodes,
            )
        )
    return Comparison(before, after, factor)


def compare_surfaces(
    map: Map,  # noqa: A002
    surface: Surface,
    periodic: Sequence[bool],
    *,
    factor: float = 1.0,
    most_points: int | None = None,
    unit: float = UNIT,
) -> Comparison:
    """∫ ωᵏ/k! over a surface of 2k dimensions, and over its image under a map of points that rounds to `unit`."""
    before = surface_integral(surface, periodic, most_points=most_points)
    noise = rounding_of(map, unit=unit)
    after = _of_image(
        lambda: surface_integral(
            lambda u: map(surface(u)), periodic, noise=lambda u, _: noise(surface(u)), most_points=most_points
        )
    )
    return Comparison(before, after, factor)


def _of_image(integral: Callable[[], Any]) -> Any:
    """The integral; an error says that it is the image that is at fault."""
    try:
        return integral()
    except InputError as error:
        if error.where:
            raise
        raise InputError(f"after the map, {error.message}") from error
