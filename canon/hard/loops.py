"""∮ p dq around loops that chaos stretches: what a canonical map must leave as it is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities, each

_INPUTS = ("radius", "K", "kicks")
CENTRE = (1.0, 2.0)


def _area(m: Any, radius: Number, K: Number, kicks: Number) -> Quantities:
    """∮ p dq = −πr² around a circle, before and after any canonical map. Arnold (1989), section 44."""
    return ((-m.pi * radius * radius,),)


def _image(s: Any, radius: float, K: float, kicks: int) -> Any:
    """The circle after so many kicks of the standard map, p ← p + K sin q, q ← q + p. Chirikov (1979)."""
    import numpy as np

    q, p = CENTRE[0] + radius * np.cos(2 * np.pi * s), CENTRE[1] + radius * np.sin(2 * np.pi * s)
    for _ in range(kicks):
        p = p + K * np.sin(q)
        q = q + p
    return np.stack([q, p], axis=1)


def _ours(points: Sequence[Point]) -> list[Answer]:
    from canon.numeric.loops import loop_integral

    answers = []
    for radius, K, kicks in points:
        found = loop_integral(lambda s, r=radius, K=K, n=int(kicks): _image(s, r, K, n))
        answers.append(Answer(((found.value,),), (found.bound if found.resolved else float("inf"),)))
    return answers


def _polygon(radius: float, K: float, kicks: float) -> Quantities:
    """Σ p Δq around a polygon of a thousand points."""
    import numpy as np

    z = _image(np.arange(1000) / 1000, radius, K, int(kicks))
    q, p = z.T
    return ((float(np.sum((p + np.roll(p, -1)) / 2 * (np.roll(q, -1) - q))),),)


CASES = (
    HardCase(
        "a loop stretched by chaos",
        "loops",
        "∮ p dq around the image of a circle under the standard map",
        _INPUTS,
        tuple((0.1, 2.0, float(n)) for n in (1, 4, 8, 10)),
        _area,
        _ours,
        each(_polygon),
        held=frozenset({1, 2}),
        open="the image's points are doubles: a loop of length l, at momenta p, knows its area A to about l p/A "
        "roundings; the bound that is returned contains the truth",
    ),
)
