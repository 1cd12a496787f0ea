"""An answer in bounded time and memory, whatever is in a certificate: what takes longer isn't confirmed.

The checker's steps are bounded one by one; how many there are is the certificate's choice. So processor time is
limited as a whole, by a timer of the system's, where there is one, and the memory of the process, too. Both belong to a
process and its first thread: elsewhere a process of its own gives the answer.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from canon.checker import alone_together, refutations
from canon.checker.check import Answer, check
from canon.checker.functions import Unreadable

SECONDS = 120
"""Processor time for one certificate; the longest of the catalogue's takes some 10."""
MEMORY = 4 << 30
"""Bytes that the process may come to have besides those that it has."""
SLACK, START = 20, 60
"""A process that answers is waited for so many times its processor time, and so many seconds besides."""


class Late(BaseException):
    """The time is over: nothing that merely goes wrong, which the rules would pass over."""


def checked(certificate: Any, seconds: float = SECONDS) -> Answer:
    """The answer about a certificate, as `check` gives it; "not confirmed" where it takes too long, or too much.

    `check` itself has no limits. In a thread that isn't the first one, or without timers, `checked_apart` is asked.
    Raises Unreadable.
    """
    if not _has_timer() or threading.current_thread() is not threading.main_thread():
        return checked_apart(certificate, seconds)
    return _limited(certificate, seconds)


def checked_apart(certificate: Any, seconds: float = SECONDS) -> Answer:
    """The answer about a certificate by a process of its own, which has these limits, and costs its start.

    Raises Unreadable.
    """
    try:
        data = json.dumps(certificate)
    except (TypeError, ValueError, RecursionError):
        raise Unreadable("this is no certificate: it can't be written as JSON") from None
    command = [sys.executable, "-m", "canon.checker.limits", str(float(seconds))]
    surroundings = {**os.environ, "PYTHONPATH": os.pathsep.join(path or os.getcwd() for path in sys.path)}
    wait = SLACK * seconds + START if _has_timer() else seconds + START
    try:
        done = subprocess.run(
            command, input=data, capture_output=True, text=True, encoding="utf-8", timeout=wait, env=surroundings
        )
        found = json.loads(done.stdout)
    except subprocess.TimeoutExpired:
        return _late(seconds)
    except (OSError, ValueError):  # it couldn't be started, or was killed
        return Answer("not confirmed", ("the process that was to check it gave no answer",))
    if "unreadable" in found:
        raise Unreadable(str(found["unreadable"]))
    return Answer(found["status"], tuple(found["reasons"]))


def checked_alone(certificate: Any, seconds: float = SECONDS) -> Answer:
    """The answer of the small checker of proofs (`canon.checker.alone`, `alone_together`), or of that of refutations
    (`refutations`): "shown", "not shown" or "wrong"."""
    answer = _limited(certificate, seconds, _alone)
    return Answer("not shown", answer.reasons) if answer.status == "not confirmed" else answer


def _alone(certificate: Any) -> Answer:
    by = refutations if isinstance(certificate, dict) and certificate.get("verdict") == "refuted" else alone_together
    status, reason = by.checked(certificate)
    return Answer(status, (reason,) if reason else ())


def _limited(certificate: Any, seconds: float, by: Callable[[Any], Answer] = check) -> Answer:
    try:
        with _timed(seconds), _sized():
            return by(certificate)
    except Late:
        return _late(seconds)
    except MemoryError:
        return Answer("not confirmed", ("it takes more memory than there is to check",))


def _late(seconds: float) -> Answer:
    return Answer("not confirmed", (f"it takes longer than {seconds:g} seconds to check",))


def _has_timer() -> bool:
    return hasattr(signal, "setitimer")


@contextmanager
def _timed(seconds: float) -> Iterator[None]:
    """Raise Late after so much processor time, where there is a timer."""
    if not _has_timer():
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


def _answer() -> None:
    """Read a certificate from the standard input, and write the answer, both as JSON."""
    sys.stdin.reconfigure(encoding="utf-8")  # type: ignore[union-attr]
    try:
        answer = _limited(json.load(sys.stdin), float(sys.argv[1]))
        found: dict[str, Any] = {"status": answer.status, "reasons": answer.reasons}
    except (Unreadable, RecursionError) as error:
        found = {"unreadable": str(error)}
    print(json.dumps(found))


if __name__ == "__main__":
    _answer()
