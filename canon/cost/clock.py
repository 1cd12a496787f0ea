"""The clock: what a piece of work costs when all is warm, and what its first time adds."""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, TypeVar

Result = TypeVar("Result")

LEAST: Final = 3
"""Runs that are always made, where the cap allows: a median of fewer says nothing of its scatter."""
MOST: Final = 25
ENOUGH: Final = 0.1
"""Seconds of runs after which no further one is made, beyond the least number."""
COMPILES: Final = 10.0


@dataclass(frozen=True)
class Timing:
    """Seconds of wall time: of the `first` run, which may have compiled something, and the `least` and the `median` of
    the `runs` that followed; of the first itself where there was no time for another."""

    first: float
    least: float
    median: float
    runs: int

    @property
    def compiling(self) -> float:
        """What the first run took beyond the others."""
        return max(self.first - self.median, 0.0)


def timed(work: Callable[[], Result], *, cap: float = 10.0) -> tuple[Result, Timing]:
    """The work's result and what it costs, repeated while the repetitions take less than `cap` seconds in all.

    What takes `COMPILES` times the cap at its first time is not done again. The work must have finished when it
    returns: results of jax are waited for. Garbage is not collected meanwhile.
    """
    collecting = gc.isenabled()
    gc.disable()
    try:
        begun = time.perf_counter()
        result = _waited(work())
        first = time.perf_counter() - begun
        seconds: list[float] = []
        while len(seconds) < MOST:
            spent = sum(seconds)
            if spent + seconds[-1] > cap if seconds else first > COMPILES * cap:
                break
            if len(seconds) >= LEAST and spent > ENOUGH:
                break
            begun = time.perf_counter()
            result = _waited(work())
            seconds.append(time.perf_counter() - begun)
    finally:
        if collecting:
            gc.enable()
    counted = seconds or [first]
    return result, Timing(first, min(counted), statistics.median(counted), len(counted))


def _waited(result: Any) -> Any:
    """The result, when jax has it."""
    ready = getattr(result, "block_until_ready", None)
    return ready() if ready is not None else result
