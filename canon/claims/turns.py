"""Claims are decided one after the other: the precision of the balls belongs to a process, not to a thread of it."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_TURN = threading.RLock()


@contextmanager
def in_turn() -> Iterator[None]:
    """Wait until no other thread of this process reads or decides claims; what is done here may ask for it again."""
    with _TURN:
        yield


def _renew() -> None:
    """In a child after a fork: whoever had the turn there isn't here."""
    global _TURN
    _TURN = threading.RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_renew)
