"""A point in the plane or in space by what a central problem needs: radius, angular momentum, and the orbit's angles.

Exact algebraic numbers of the given doubles, so that a nearly circular orbit is as nearly circular as they say.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.numeric.actions.balls import ball_of, precision
from canon.numeric.actions.bounded import Bounded, bounded


@dataclass(frozen=True)
class Place:
    """`radius` and `radial_momentum`; the `momentum` L > 0, its part `along_axis` and the `sense` of going round;

    `in_plane`, the angle from the ascending node (in the plane: from the x axis), and that of the `node`, in turns.
    """

    radius: Any
    radial_momentum: Any
    momentum: Any
    along_axis: Any
    sense: int
    in_plane: Any
    node: Bounded


def angles_in_space(q: Sequence[float], p: Sequence[float]) -> Place:
    """The place of a phase point in Cartesian coordinates, two or three of them."""
    x = [sp.Rational(value) for value in (*q, *[0.0] * (3 - len(q)))]
    v = [sp.Rational(value) for value in (*p, *[0.0] * (3 - len(p)))]
    radius = sp.sqrt(sum(a * a for a in x))
    M = [x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]]
    L = sp.sqrt(sum(a * a for a in M))
    radial = sum(a * b for a, b in zip(x, v, strict=True)) / radius
    sense = -1 if M[2] < 0 else 1
    if M[0] == 0 and M[1] == 0:
        # in the plane z = 0 the node is the x axis
        return Place(radius, radial, L, M[2], sense, sp.atan2(sense * x[1], x[0]), Bounded(0.0, 0.0))
    # the ascending node points along (−M_y, M_x, 0)
    along = -M[1] * x[0] + M[0] * x[1]
    across = L * x[2]
    with precision(200):
        node = bounded(ball_of(sp.atan2(M[0], -M[1]) / (2 * sp.pi)))
    return Place(radius, radial, L, M[2], sense, sp.atan2(across, along), node)
