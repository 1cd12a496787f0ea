"""An answer in bounded time and memory, whatever is in a certificate: what takes longer isn't confirmed.

The checker's steps are bounded one by one; how many there are is the certificate's choice. So processor time is
limited as a whole, by a timer of the system's, where there is one, and the memory of the process, too.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from canon.checker.check import Answer, check

SECONDS = 120
"""Processor time for one certificate; the longest of the catalogue's takes some 10."""
MEMORY = 4 << 30
"""Bytes that the process may come to have besides those that it has."""


class Late(BaseException):
    """The time is over: nothing that merely goes wrong, which the rules would pass over."""


def checked(certificate: Any, seconds: float = SECONDS) -> Answer:
    """The answer about a certificate, as `check` gives it; "not confirmed" where it takes too long, or too much.

    Raises Unreadable.
    """
    try:
        with _timed(seconds), _sized():
            return check(certificate)
    except Late:
        return Answer("not confirmed", (f"it takes longer than {seconds:g} seconds to check",))
    except MemoryError:
        return Answer("not confirmed", ("it takes more memory than there is to check",))


@contextmanager
def _timed(seconds: float) -> Iterator[None]:
    """Raise Late after so much processor time; in another thread than the first one there is no timer."""
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def late(number: int, frame: FrameType | None) -> None:
        raise Late

    before = signal.signal(signal.SIGVTALRM, late)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, 1)  # and again, should the first one be caught
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


@contextmanager
def _sized() -> Iterator[None]:
    """Let memory end with a MemoryError, not with the machine's."""
    try:
        import resource

        with open("/proc/self/statm", encoding="ascii") as file:
            size = int(file.read().split()[0]) * resource.getpagesize()
        soft, hard = resource.getrlimit(resource.RLIMIT_AS)
        least = [limit for limit in (soft, hard, size + MEMORY) if limit != resource.RLIM_INFINITY]
        resource.setrlimit(resource.RLIMIT_AS, (min(least), hard))
    except (ImportError, OSError, ValueError):
        yield
        return
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
