"""Bodies in a plane, some of them on skates: the free motion along a heading that turns uniformly, in closed form.

The slots are (q, p): the places of all bodies and then the headings α; for a body on a skate the momentum P along its
heading in place of p_x and p_y, and the momenta p_α of the headings last. A skate's sideways force makes its velocity
turn with the heading: ẋ = (P/m) cos α, ẏ = (P/m) sin α. Neimark and Fufaev (1972), Dynamics of Nonholonomic Systems.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from canon.numeric.integrators.problem import ExactPart, State


@dataclass(frozen=True)
class Gliding:
    """A body of this `mass`: where its place begins in q, where its momentum begins in p, and where the heading and its
    momentum are, with the moment of inertia; None for a body without a skate.
    """

    mass: float
    place: int
    momentum: int
    heading: int | None = None
    turning: int | None = None
    moment: float = 1.0


def gliding_part(bodies: Sequence[Gliding]) -> ExactPart:
    """All bodies' free motion: a chord of the circle that a skate runs along, a straight line for others."""

    def flow(state: State, h: Any, t: Any) -> State:
        import jax.numpy as jnp

        q, p, *others = state
        moved = [q[k] for k in range(q.shape[0])]
        for body in bodies:
            k, j = body.place, body.momentum
            if body.heading is None or body.turning is None:
                moved[k], moved[k + 1] = q[k] + h * p[j] / body.mass, q[k + 1] + h * p[j + 1] / body.mass
                continue
            half = h * p[body.turning] / (2 * body.moment)
            middle = q[body.heading] + half
            chord = h * p[j] / body.mass * jnp.sinc(half / jnp.pi)
            moved[k], moved[k + 1] = q[k] + chord * jnp.cos(middle), q[k + 1] + chord * jnp.sin(middle)
            moved[body.heading] = middle + half
        return (jnp.stack(moved), p, *others)

    return ExactPart(flow, name="gliding")
