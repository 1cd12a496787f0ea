"""A call that looks at no clock, ended at a deadline.

Sympy's rules for integrals, its quotients of polynomials and its solver don't always end, and can't be asked to stop.
So such a call is made in a thread, for which its caller waits no longer than its budget allows. A thread can't be
killed, but an exception can be raised in it, between two of Python's own steps; it undoes what sympy has begun, and the
thread ends. Nothing of canon's own runs there, so that nothing of it is left half done.
"""

from __future__ import annotations

import ctypes
import math
import threading
from collections.abc import Callable
from typing import Any, Final, TypeVar

from canon.budget import Budget
from canon.errors import BudgetExceeded
from canon.interruption import ABANDONED, started

T = TypeVar("T")
ENDING: Final = 0.5
"""Seconds that a thread is given to undo what it has begun, before it is left to itself."""


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
    for _ in range(2):  # what is raised where errors are only printed is lost
        if raising is not None and thread.ident is not None:
            raising.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(_Stop))
        thread.join(ENDING / 2)
        if not thread.is_alive():
            return
    thread.name = ABANDONED
