"""A call that looks at no clock, ended at a deadline.

Sympy's rules for integrals, its quotients of polynomials and its solver don't always end, and can't be asked to stop.
So such a call is made in a thread, for which its caller waits no longer than its budget allows. A thread can't be
killed, but an exception can be raised in it, between two of Python's own steps; it undoes what sympy has begun, and the
thread ends. Nothing of canon's own runs there, so that nothing of it is left half done; what sympy itself leaves half
done is forgotten before it is asked again (`canon.mechanics.unfinished_integrals`).
"""

from __future__ import annotations

import ctypes
import math
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import Any, Final, TypeVar

from canon.budget import Budget
from canon.errors import BudgetExceeded
from canon.interruption import ABANDONED, started

T = TypeVar("T")
ENDING: Final = 0.5
"""Seconds that a thread is given to undo what it has begun, before it is left to itself."""
LOOK: Final = 0.01
"""Seconds between two looks at whether it has ended, or has not heard."""


class _Stop(BaseException):
    """Raised in a thread for which nobody waits any more. No error: nothing that catches errors is to catch it."""


@dataclass(frozen=True)
class _Ending:
    """A thread that is to end, whether the exception was `lost` in it, and whether its work is `over`.

    Nothing is raised in it once it is: its identity may be another thread's by then, one of the program's that asks.
    """

    lost: threading.Event = field(default_factory=threading.Event)
    over: threading.Event = field(default_factory=threading.Event)
    gate: Any = field(default_factory=threading.Lock)


_ENDINGS: Final[dict[int, _Ending]] = {}
"""Threads that are being ended, by their identity."""
_HOOK: Final = threading.Lock()
_BEFORE: Final[list[Any]] = []
"""What Python prints such errors with, while our own hook is in its place."""


def within(budget: Budget, work: Callable[[], T]) -> T:
    """What `work` returns, or raises.

    **Arguments:** `budget`, the time that it may take (without an end, it is simply done); `work`, a call that nothing
    depends on if it is given up in its middle.

    **Raises:** `BudgetExceeded` where that time is over.
    """
    if math.isinf(budget.seconds):
        return work()
    budget.check()
    answer: list[T] = []
    failure: list[BaseException] = []
    ending = _Ending()

    def run() -> None:
        with suppress(_Stop):  # one that comes when all is done
            try:
                answer.append(work())
            except _Stop:
                pass
            except BaseException as raised:
                failure.append(raised)
            with ending.gate:
                ending.over.set()

    thread = started(run)
    try:
        thread.join(min(budget.left(), threading.TIMEOUT_MAX))
    finally:
        if thread.is_alive():
            _stop(thread, ending)
    if failure:
        raise failure[0]
    if not answer:
        raise BudgetExceeded(f"the budget of {budget.seconds:g} s is spent")
    return answer[0]


def _stop(thread: threading.Thread, ending: _Ending) -> None:
    """End a thread; one that is busy in a library in C hears it when it comes back from there."""
    raising: Any = getattr(ctypes, "pythonapi", None)
    if raising is None or thread.ident is None:
        thread.name = ABANDONED
        return
    with _told(thread.ident, ending):
        start = time.monotonic()
        for end in (start + ENDING / 2, start + ENDING):  # what is caught by everything is raised once more, too
            ending.lost.set()
            while thread.is_alive() and time.monotonic() < end:
                if ending.lost.is_set() and ending.gate.acquire(timeout=LOOK):
                    try:
                        if not ending.over.is_set():
                            ending.lost.clear()
                            stop = ctypes.py_object(_Stop)
                            raising.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), stop)
                    finally:
                        ending.gate.release()
                thread.join(LOOK)
    if thread.is_alive():
        thread.name = ABANDONED


@contextmanager
def _told(thread: int, ending: _Ending) -> Iterator[None]:
    """Told, while this lasts, where the exception was raised in a callback whose errors Python only prints, as those of
    weak references and of `__del__`. It isn't printed; what others lose there is told as ever."""
    with _HOOK:
        _ENDINGS[thread] = ending
        if not _BEFORE:
            _BEFORE.append(sys.unraisablehook)
            sys.unraisablehook = _heard
    try:
        yield
    finally:
        with _HOOK:  # of threads that end at once the last one puts back what was there
            if _ENDINGS.get(thread) is ending:
                del _ENDINGS[thread]
            if not _ENDINGS and sys.unraisablehook is _heard:
                sys.unraisablehook = _BEFORE.pop()


def _heard(told: Any) -> None:
    """What Python calls in the thread in which an error is lost."""
    ending = _ENDINGS.get(threading.get_ident())
    if told.exc_type is not None and issubclass(told.exc_type, _Stop):
        if ending is not None:
            ending.lost.set()
    else:
        (_BEFORE[0] if _BEFORE else sys.__unraisablehook__)(told)
