"""A hard case: a quantity, the points at which it is asked for, and the routes to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

SHAPE: Final = 8

Number = Any
"""A float, or a number of mpmath's."""

Point = tuple[float, ...]
"""The inputs, exactly as these doubles are."""

Quantities = tuple[tuple[Number, ...], ...]
"""Vectors, a scalar being one of one component. Each is measured by its own length."""

Formula = Callable[..., Quantities]
"""Takes a module of numerical functions (mpmath's `mp`, or `plain` for doubles) and the inputs."""


@dataclass(frozen=True)
class Answer:
    """What a route gives at a point: the quantities and, where it states them, bounds of their errors."""

    values: Quantities
    bounds: tuple[float, ...] | None = None


Route = Callable[[Sequence[Point]], Sequence[Answer]]
"""Takes all points of a case at once."""


@dataclass(frozen=True)
class HardCase:
    """A quantity that naive formulas lose digits of.

    **Fields:** `name`; `family`; `states`, what is computed, in words; `inputs`, their names; `points`; `reference`,
    the formula that is right in `digits` digits; `ours`; `naive`, the same formula in double precision where it is left
    out; `peers`, routes of other packages by their names ("scipy.special"), of which the first part is what has to be
    installed; `held`, inputs that are taken as exact when the conditioning is measured (the number of steps, a
    constant's value); `open`, why digits are missing, where they are; `slow` for cases of the thorough profile.
    """

    name: str
    family: str
    states: str
    inputs: tuple[str, ...]
    points: tuple[Point, ...]
    reference: Formula
    ours: Route
    naive: Route | None = None
    peers: Mapping[str, Route] = field(default_factory=dict)
    digits: int = 50
    held: frozenset[int] = frozenset()
    open: str = ""
    slow: bool = False


def each(function: Callable[..., Any]) -> Route:
    """The route that takes the points one by one; `function` returns a number, a vector, or `Quantities`."""
    return lambda points: [Answer(quantities(function(*point))) for point in points]


def together(function: Callable[..., Any]) -> Route:
    """The route by a function of arrays, called once: it returns arrays (N,) or (components, N), or a tuple of them."""
    import numpy as np

    def route(points: Sequence[Point]) -> Sequence[Answer]:
        found = function(*np.array(points, dtype=float).T)
        parts = found if isinstance(found, tuple) else (found,)
        rows = [np.atleast_2d(np.asarray(part, dtype=float)) for part in parts]
        return [Answer(tuple(tuple(float(x) for x in row[:, k]) for row in rows)) for k in range(len(points))]

    return route


def compiled(function: Callable[..., Any]) -> Route:
    """The same for a function that jax can trace; cases of one function, with up to `SHAPE` points, share a program."""

    def route(points: Sequence[Point]) -> Sequence[Answer]:
        import jax

        more = [points[-1]] * (-len(points) % SHAPE)
        return together(jax.jit(function))([*points, *more])[: len(points)]

    return route


def quantities(value: Any) -> Quantities:
    """A number, a vector or several of them as `Quantities`."""
    import numpy as np

    if isinstance(value, tuple) and value and isinstance(value[0], tuple):
        return value
    if isinstance(value, (tuple, list, np.ndarray)):
        return (tuple(value),)
    return ((value,),)
