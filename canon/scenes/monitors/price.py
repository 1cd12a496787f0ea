"""What the monitors cost after a run, roughly: a budget is one of the whole command."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

COMPILING: Final = 1.0
"""Seconds for the program of a monitor that carries neighbours of the orbit along."""
ALWAYS: Final = 0.5
"""Seconds for what is done after every run: counting operations, formulas along the orbit, printing."""
LOOP: Final = 16.0
"""A loop of 64 nodes costs some that many runs of one orbit, as several orbits are computed at once."""
TANGENT: Final = ("symplecticity", "volume")
LOOPS: Final = ("loop", "cartan")


def price(names: Sequence[str], n: int) -> Callable[[float], float]:
    """From the seconds of a run with n degrees of freedom to those that its monitors will take."""
    asked = {*names}
    fixed = ALWAYS + COMPILING * len(asked & {*LOOPS, "reversibility"}) + COMPILING * bool(asked & {*TANGENT})
    runs = LOOP * len(asked & {*LOOPS}) + (n + 1.0) * bool(asked & {*TANGENT}) + ("reversibility" in asked)
    return lambda seconds: fixed + runs * seconds
