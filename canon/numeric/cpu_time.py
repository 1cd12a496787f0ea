"""CPU time of a piece of work, without the garbage collector's: that one comes when it is due, whatever runs then."""

from __future__ import annotations

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class Spent:
    """The `seconds` of CPU time of this process until now, and in the end from the beginning to the end."""

    def __init__(self) -> None:
        self.begun = time.process_time()
        self.collecting = self.began_to_collect = 0.0
        self.ended: float | None = None

    @property
    def seconds(self) -> float:
        """CPU seconds since the beginning, of all threads."""
        until = time.process_time() if self.ended is None else self.ended
        return max(until - self.begun - self.collecting, 0.0)

    def heard(self, phase: str, _: dict[str, Any]) -> None:
        """Told by the collector that it begins, or ends."""
        if phase == "start":
            self.began_to_collect = time.process_time()
        else:
            self.collecting += time.process_time() - self.began_to_collect


@contextmanager
def cpu_time() -> Iterator[Spent]:
    """As `with cpu_time() as spent: work()`; then `spent.seconds`."""
    spent = Spent()
    gc.callbacks.append(spent.heard)
    try:
        yield spent
    finally:
        spent.ended = time.process_time()
        gc.callbacks.remove(spent.heard)
