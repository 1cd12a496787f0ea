"""Runs of a million and more steps: what their roundings add up to, with and without keeping them.

The reference is the same map, made as many times in fifty digits: a leapfrog step of the oscillator is linear. So no
error of the method is in these digits, nor the step or the number of steps in the conditioning.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from canon.hard.case import Answer, HardCase, Number, Point, Quantities


def _leapfrog(m: Any, q: Number, p: Number, h: Number, n: Number) -> Quantities:
    """n steps (half a drift, a kick, half a drift) of q̈ = −q: turns by nθ, cos θ = 1 − h²/2, with q in units of
    √(1 − h²/4). Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, I.5.
    """
    scale = m.sqrt(1 - h * h / 4)
    turn = n * m.acos(1 - h * h / 2)
    c, s = m.cos(turn), m.sin(turn)
    return ((c * q + s * p * scale, -s * q / scale + c * p),)


def _energy(m: Any, q: Number, p: Number, h: Number, n: Number) -> Quantities:
    """q² + (1 − h²/4) p², which these steps conserve."""
    return ((q * q + (1 - h * h / 4) * p * p,),)


@lru_cache(maxsize=1)
def _oscillator() -> Any:
    from canon.numeric.integrators import separable

    return separable(lambda p: p, lambda q: -q)


def _run(compensated: bool) -> Any:
    def route(points: Sequence[Point]) -> list[Answer]:
        import numpy as np

        from canon.numeric.integrate import integrate
        from canon.numeric.integrators.yoshida import VERLET

        answers = []
        for q, p, h, n in points:
            run = integrate(
                _oscillator(),
                VERLET,
                (np.array([q]), np.array([p])),
                duration=h * n,
                steps=int(n),
                compensated=compensated,
            )
            answers.append(Answer(((float(run.state[0][0]), float(run.state[1][0])),)))
        return answers

    return route


def _energies(compensated: bool) -> Any:
    """The conserved quadratic form of where a run ends, formed exactly."""

    def route(points: Sequence[Point]) -> list[Answer]:
        from fractions import Fraction

        answers = []
        for point, answer in zip(points, _run(compensated)(points), strict=True):
            (q, p), h = map(Fraction, answer.values[0]), Fraction(point[2])
            answers.append(Answer(((float(q * q + (1 - h * h / 4) * p * p),),)))
        return answers

    return route


STEP = 2.0**-10
CHUNK = 2**16
"""Runs are made in whole chunks of so many steps."""

_INPUTS = ("q", "p", "h", "n")
_HELD = frozenset({2, 3})


def _steps(count: int, name: str, *, slow: bool) -> HardCase:
    return HardCase(
        name,
        "integrators",
        "position and momentum after so many leapfrog steps of an oscillator",
        _INPUTS,
        ((1.0, 0.3, STEP, float(count)),),
        _leapfrog,
        _run(True),
        _run(False),
        held=_HELD,
        digits=60,
        slow=slow,
    )


def _drift(chunks: Sequence[int], name: str, *, slow: bool) -> HardCase:
    return HardCase(
        name,
        "integrators",
        "what a leapfrog conserves, at the end of a run",
        _INPUTS,
        tuple((1.0, 0.3, STEP, float(count * CHUNK)) for count in chunks),
        _energy,
        _energies(True),
        _energies(False),
        held=_HELD,
        slow=slow,
    )


CASES = (
    _steps(16 * CHUNK, "1e6 leapfrog steps", slow=False),
    _drift((16, 160), "energy after 1e7 steps", slow=False),
    _steps(1526 * CHUNK, "1e8 leapfrog steps", slow=True),
    _drift((1526,), "energy after 1e8 steps", slow=True),
)
