"""Large angles: what a whole number of turns leaves of 1e8 radians.

The angle is taken as exact: as an input with a rounding it would leave eight digits to anyone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities, compiled, each


def _swing(m: Any, q: Number, p: Number, t: Number) -> Quantities:
    """The momentum of a pendulum that began at (q, p), below the separatrix. Whittaker (1937), 44."""
    S, P = m.sin(q / 2), p / 2
    k = m.sqrt(S * S + P * P)
    side = 1 if m.cos(q / 2) > 0 else -1
    u = m.ellipf(m.atan2(side * S / k, P / k), k * k) + t
    cn = m.ellipfun("cn", u, k * k)
    return ((2 * k * getattr(cn, "real", cn),),)


def _naive_swing(q: float, p: float, t: float) -> Quantities:
    """The angle less whole turns, then the same."""
    from canon.hard import plain

    return _swing(plain, math.remainder(q, 2 * math.pi), p, t)


def _our_swing(q: Any, p: Any, t: Any) -> Any:
    from canon.numeric.exact.pendulum import pendulum

    return pendulum(q, p, t)[1]


def _sine(m: Any, x: Number) -> Quantities:
    return ((m.sin(x),),)


def _our_sine(points: Sequence[Point]) -> list[Answer]:
    """The sines of compiled maps: a few multiplications."""
    import numpy as np

    from canon.numeric.sines import VectorSines

    found = VectorSines(np).sin(np.array([x for (x,) in points]))
    return [Answer(((float(value),),)) for value in found]


CASES = (
    HardCase(
        "a pendulum at 1e8 radians",
        "angles",
        "its momentum a little later",
        ("q", "p", "t"),
        tuple((q, 0.3, 2.0) for q in (1e3, 1e6, 1e8, 123456789.0)),
        _swing,
        compiled(_our_swing),
        each(_naive_swing),
        digits=80,
        held=frozenset({0}),
    ),
    HardCase(
        "sines next to multiples of π",
        "angles",
        "sin x of doubles that are close to one, up to 1e6",
        ("x",),
        tuple((float(n),) for n in (355, 710, 103993, 833719)),
        _sine,
        _our_sine,
        each(lambda x: math.sin(math.remainder(x, 2 * math.pi))),
        held=frozenset({0}),
    ),
)
