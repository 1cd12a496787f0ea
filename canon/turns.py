"""What is computed in balls is computed in turn: their precision, and how long their series are, belong to a process.

Two threads that set them would compute with each other's: a series that was cut short makes a wrong number with a small
bound. So whoever sets them has the turn meanwhile, and a claim that is decided has it all along. A thread that is
started by one that has the turn, and waits for it, has it too.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from types import TracebackType
from typing import Any, Final

_TURN = threading.RLock()
_HERE: Final = threading.local()
"""Of each thread: how often it has the turn now, and whether it has that of the thread that started it."""


class in_turn:  # noqa: N801 - it is used as a function is
    """Wait until no other thread of this process has the turn; what is done meanwhile may ask for it again."""

    def __init__(self) -> None:
        self._lock: Any = None

    def __enter__(self) -> None:
        if getattr(_HERE, "given", False):
            return
        lock = _TURN
        lock.acquire()
        self._lock = lock
        _HERE.depth = getattr(_HERE, "depth", 0) + 1

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        lock, self._lock = self._lock, None
        if lock is not None:
            _HERE.depth -= 1
            lock.release()


def handed_on(run: Callable[[], None]) -> Callable[[], None]:
    """The same work for a thread that is waited for: it has the turn if the one that starts it has."""
    if not (getattr(_HERE, "given", False) or getattr(_HERE, "depth", 0)):
        return run

    def with_the_turn() -> None:
        _HERE.given = True
        run()

    return with_the_turn


def _renew() -> None:
    """In a child after a fork: whoever had the turn there isn't here."""
    global _TURN
    _TURN = threading.RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_renew)
