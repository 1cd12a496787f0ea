"""Sample points of a map, and whether a formula found for it is right at them."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.mechanics.solution_points import Point, real_value, sample_points

if TYPE_CHECKING:
    from canon.mechanics.transformation import Transformation


def points_of(transformation: "Transformation") -> Iterator[Point]:
    """Sample points of the domain, with the values of the old and the new variables."""
    F, space = transformation.generating_function, transformation.space
    if transformation.direction == "implicit" and F is not None:
        return sample_points(F.conjugates(), F.mixed, {}, space.domain.conditions)
    given = {x: formula.expr for x, formula in transformation.mapping.items()}
    unknowns = space.old if transformation.direction == "forward" else space.new
    return sample_points(given, unknowns, {}, space.domain.conditions)


def gives(formulas: Mapping[Any, sp.Expr], point: Point) -> bool:
    """Whether each formula has the value at a point that its variable has there, or no real value."""
    return all(agree(real_value(value, point), real_value(point[name], point)) for name, value in formulas.items())


def agree(one: float | None, other: float | None) -> bool:
    """Whether two values are one, as far as both are there."""
    return one is None or other is None or abs(one - other) <= 1e-9 * (1 + abs(one) + abs(other))
