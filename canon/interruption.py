"""Ctrl-C that is heard at once, whatever compiled code is running.

Python hears a signal between two of its own steps, and raises `KeyboardInterrupt` wherever that happens to be. A
compiled loop, or the compiler, is one step, however long it takes; and an exception that is raised inside a callback of
a library is lost, or worse. So a command's work is done in a thread (`heeding`), and compiled programs in threads of
their own (`interruptible`), which can be left: they go on, and nobody looks at what they find.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final, TypeVar

from canon.turns import handed_on

T = TypeVar("T")
ABANDONED: Final = "canon: nobody waits for this"
LOOK: Final = 0.02
"""Seconds between two looks at whether Ctrl-C was pressed."""
PATIENCE: Final = (0.5, 5.0)
"""Seconds after Ctrl-C until work is left that has nothing to report yet, and work that has; where the processor was
busy with other things, and the work had less than half of them, `STARVED` times as many."""
STARVED: Final = 4.0
HEARD: Final = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""Ctrl-C, what a system sends to those that it ends, and a terminal that is closed."""
STACK: Final = 64 << 20
"""Bytes of stack of a thread: sympy's recursion is deep, and threads have little on some systems."""


class Late(Exception):
    """There was no answer in time."""


class Left(Exception):
    """Ctrl-C was pressed, and the work did not end in time."""


class Listener:
    """A handler of signals that raises nothing: it remembers that Ctrl-C was `pressed`, and how often in all.

    `underway` says that there is something to report.
    """

    def __init__(self) -> None:
        self.pressed = self.underway = False
        self.times = 0
        self.last = self.spent = 0.0

    def __call__(self, *_: object) -> None:
        self.pressed = True
        self.times += 1
        self.last, self.spent = time.monotonic(), time.process_time()

    def overdue(self) -> bool:
        """Whether the work has had its time since Ctrl-C was pressed, or it was pressed again."""
        if self.times != 1:
            return self.times > 1
        waited, patience = time.monotonic() - self.last, PATIENCE[self.underway]
        starved = time.process_time() - self.spent < patience / 2
        return waited > patience * (STARVED if starved else 1)


def heeding(work: Callable[[], T]) -> T:
    """What `work` returns, or raises; it is done in another thread, in which `interruptible` raises `KeyboardInterrupt`
    soon after Ctrl-C (or SIGTERM, or SIGHUP). Called in the main thread.

    **Raises:** `Left` where the work didn't end soon after that.
    """
    listener = Listener()
    wanted = [n for n in HEARD if signal.getsignal(n) is not signal.SIG_IGN]
    before = {number: signal.signal(number, listener) for number in wanted}
    try:
        return _in_a_thread(work, listener.overdue, Left)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class Raiser:
    """A handler of signals that raises `KeyboardInterrupt`, and remembers it: a library's callback may lose it."""

    def __init__(self) -> None:
        self.pressed = False

    def __call__(self, *_: object) -> None:
        self.pressed = True
        raise KeyboardInterrupt


class _Continued:
    """A handler that counts how often this program was stopped, as by Ctrl-Z, and continued."""

    def __init__(self) -> None:
        self.times = 0

    def __call__(self, *_: object) -> None:
        self.times += 1


_CONTINUED: Final = _Continued()


def continued() -> int:
    """How often this program was stopped and continued while `raising` listened: what was asked meanwhile has lost
    time."""
    return _CONTINUED.times


def raising(work: Callable[[], T]) -> T:
    """What `work` returns; SIGTERM and SIGHUP raise `KeyboardInterrupt` in it, as Ctrl-C does. Called in the main
    thread, for work that is done in other processes and is never long in one step of Python's."""
    raiser = Raiser()
    before = {number: signal.getsignal(number) for number in HEARD}
    try:
        for number, handler in before.items():
            if handler is not signal.SIG_IGN:
                signal.signal(number, raiser)
        if hasattr(signal, "SIGCONT"):
            before[signal.SIGCONT] = signal.signal(signal.SIGCONT, _CONTINUED)
        return work()
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def raise_again() -> None:
    """**Raises:** `KeyboardInterrupt` where `raising` has raised one that didn't arrive; once."""
    for number in HEARD:
        handler = signal.getsignal(number)
        if isinstance(handler, Raiser) and handler.pressed:
            handler.pressed = False
            raise KeyboardInterrupt


@contextmanager
def held() -> Iterator[None]:
    """Signals that are heard wait until this is over: for a process that begins as a copy of this one, and would raise
    what is meant for this one. It begins with them held, and lets them go (`let_go`)."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, HEARD)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def let_go() -> None:
    """Signals that were held back arrive from now on, and so does an alarm."""
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {*HEARD, signal.SIGALRM})


def interruptible(work: Callable[[], T], until: float | None = None) -> T:
    """What `work` returns, or raises.

    **Raises:** `KeyboardInterrupt` as soon as somebody presses Ctrl-C, `Late` at the time `until` (of the monotonic
    clock); the work is left then. Where no signal arrives, the work is simply done.
    """
    listener = _listener()
    if listener is None:
        if threading.current_thread() is not threading.main_thread():
            return work()
        return _in_a_thread(work, lambda: until is not None and time.monotonic() >= until, Late)
    listener.underway = True

    def over() -> bool:
        if listener.pressed:
            listener.pressed = False
            raise KeyboardInterrupt
        return until is not None and time.monotonic() >= until

    return _in_a_thread(work, over, Late)


def _listener() -> Listener | None:
    """Who hears Ctrl-C, or the others where Ctrl-C is ignored, as in a shell's background."""
    handlers = (signal.getsignal(number) for number in HEARD)
    return next((each for each in handlers if isinstance(each, Listener)), None)


def underway() -> Callable[[], bool]:
    """Whether Ctrl-C has been pressed, for work that has something to report and looks for it between its own steps.

    The answer yes is given once: what comes after it may be interrupted anew. Without a listener it is always no.
    """
    listener = _listener()
    if listener is None:
        return lambda: False
    listener.underway = True

    def heard() -> bool:
        pressed, listener.pressed = listener.pressed, False
        return pressed

    return heard


def _in_a_thread(work: Callable[[], T], over: Callable[[], bool], error: type[Exception]) -> T:
    """What `work` returns, or raises. **Raises:** what `over` raises, or `error` where it says so."""
    answer: list[Any] = []
    failure: list[BaseException] = []

    def run() -> None:
        try:
            answer.append(work())
        except BaseException as raised:
            failure.append(raised)

    thread = started(run)
    try:
        while thread.is_alive():
            if over():
                raise error
            thread.join(LOOK)
    except BaseException:
        thread.name = ABANDONED
        raise
    if failure:
        raise failure[0]
    return answer[0]


def started(run: Callable[[], None]) -> threading.Thread:
    """A thread with a deep stack that is doing this, and that a program doesn't wait for at its end."""
    usual = threading.stack_size(STACK)
    try:
        thread = threading.Thread(target=handed_on(run), daemon=True)
        thread.start()
    finally:
        threading.stack_size(usual)
    return thread


def left_behind() -> bool:
    """Whether something is still running for which nobody waits."""
    return any(thread.name == ABANDONED for thread in threading.enumerate())
