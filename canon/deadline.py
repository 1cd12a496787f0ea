"""A call that looks at no clock, ended at a deadline.

Sympy's rules for integrals, its quotients of polynomials and its solver don't always end, and can't be asked to stop.
So such a call is made in a thread, for which its caller waits no longer than its budget allows. A thread can't be
killed, but an exception can be raised in it, between two of Python's own steps; it undoes what sympy has begun, and the
thread ends. Nothing of canon's own runs there, so that nothing of it is left half done.
"""

from __future__ import annotations

import ctypes
import math
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
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

    def run() -> None:
        try:
            answer.append(work())
        except _Stop:
            pass
        except BaseException as raised:
            failure.append(raised)

    thread = started(run)
    try:
        thread.join(budget.left())
    finally:
        if thread.is_alive():
            _stop(thread)
    if failure:
        raise failure[0]
    if not answer:
        raise BudgetExceeded(f"the budget of {budget.seconds:g} s is spent")
    return answer[0]


def _stop(thread: threading.Thread) -> None:
    """End a thread; one that is busy in a library in C hears it when it comes back from there."""
    raising: Any = getattr(ctypes, "pythonapi", None)
    if raising is None or thread.ident is None:
        thread.name = ABANDONED
        return
    with _lost() as lost:
        start = time.monotonic()
        for end in (start + ENDING / 2, start + ENDING):  # what is caught by everything is raised once more, too
            lost.set()
            while thread.is_alive() and time.monotonic() < end:
                if lost.is_set():
                    lost.clear()
                    raising.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(_Stop))
                thread.join(LOOK)
    if thread.is_alive():
        thread.name = ABANDONED


@contextmanager
def _lost() -> Iterator[threading.Event]:
    """Set where the exception was raised in a callback whose errors Python only prints, as those of weak references
    and of `__del__`. It isn't printed; what others lose there is told as ever."""
    before, lost = sys.unraisablehook, threading.Event()

    def hook(told: Any) -> None:
        if told.exc_type is not None and issubclass(told.exc_type, _Stop):
            lost.set()
        else:
            before(told)

    sys.unraisablehook = hook
    try:
        yield lost
    finally:
        if sys.unraisablehook is hook:
            sys.unraisablehook = before
