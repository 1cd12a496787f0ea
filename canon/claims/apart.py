"""A claim decided in a process of its own, which is killed where it overstays its budget of time or of memory.

A program that calls `verify` has nobody who could kill it, and the workers of an executor that isn't ours (Dask's, or
those of `concurrent.futures`) can't be killed by who asks them. So each of them keeps a process beside it, in which the
claims are decided one after the other: a call into C that looks at no clock, or memory that runs out, costs one answer
and not the worker. The process is kept for the next claims, as importing takes a second; it ends when the worker does.
"""

from __future__ import annotations

import atexit
import os
import subprocess
import sys
import threading
from dataclasses import replace
from multiprocessing.connection import Connection, Pipe
from pickle import PicklingError
from typing import Final

from canon.claim import Claim
from canon.claims.worker import CERTIFICATE_SECONDS, Settings, alarm, cause_of_death, isolate, without_verdict
from canon.errors import InputError
from canon.verdict import Verdict

Answer = Verdict | InputError
START: Final = 60.0
"""Seconds in which a process has to have imported what it needs."""
MOST_IDLE: Final = 16
"""Processes that may wait for claims of other limits of memory."""
LONGEST: Final = 1e6
"""Seconds that are waited for an answer, whatever the budget: a clock of the system's has no more."""
_PROGRAM: Final = "import sys; sys.path[:] = {path!r}; from canon.claims.apart import serve; serve({fd}, {memory})"
_IDLE: Final[dict[int | None, list[Companion]]] = {}
_LOCK = threading.Lock()
_OF_PARENTS: Final[list[Companion]] = []
"""What a fork has copied: it belongs to another process, and is neither asked nor waited for here."""
UNSENT: Final = (PicklingError, AttributeError, TypeError, RecursionError)
"""What is raised where something can't be made a message."""


class NotApart(Exception):
    """A claim can't be decided in another process, with the reason."""


class Companion:
    """A process that decides claims for this one, one at a time, and the pipe to it."""

    def __init__(self, memory: int | None) -> None:
        """Start it, with a limit of memory in bytes, and wait until it is ready; **raises** `OSError` if it isn't."""
        self.connection, its = Pipe()
        program = _PROGRAM.format(path=sys.path, fd=its.fileno(), memory=memory)
        self.process = subprocess.Popen(
            [sys.executable, "-c", program],
            pass_fds=[its.fileno()],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        its.close()
        try:
            ready = self.connection.poll(START) and self.connection.recv() == "ready"
        except (EOFError, OSError):
            ready = False
        if not ready:
            self.end()
            raise OSError("no process could be started")

    def ask(self, claim: Claim, settings: Settings, certificates: bool) -> Answer | None:
        """The answer to a claim; None where it can't be sent. Afterwards the process may have ended: see `alive`."""
        seconds = settings.budget if claim.budget is None else float(claim.budget)
        try:
            self.connection.send((claim, settings, certificates))
        except OSError:  # it was ended while it waited
            self.end()
            return None
        except UNSENT:
            return None
        try:
            if not self.connection.poll(min(seconds + settings.grace_of(seconds), LONGEST)):
                self.end()
                return without_verdict(claim, f"stopped: still busy well past its budget of {seconds:g} s", seconds)
            answer = self.connection.recv()
            if _is_out_of_memory(answer):
                self.end()  # as it does itself, a moment later
            return self._with_certificate(answer) if certificates and isinstance(answer, Verdict) else answer
        except (EOFError, OSError):
            self.connection.close()
            return without_verdict(claim, cause_of_death(self.process.wait(START)), 0.0)
        except BaseException:
            self.end()
            raise

    def _with_certificate(self, answer: Verdict) -> Verdict:
        """The verdict with its certificate, which comes after it, and may take its own time but no more."""
        if not self.connection.closed:
            try:
                if self.connection.poll(CERTIFICATE_SECONDS):
                    return replace(answer, certificate=self.connection.recv())
            except (EOFError, OSError):
                pass
            self.end()
        return answer

    @property
    def alive(self) -> bool:
        """Whether it can be asked again."""
        return not self.connection.closed and self.process.poll() is None

    def end(self) -> None:
        """End it at once."""
        self.process.kill()
        self.process.wait()
        self.connection.close()


def decided_apart(claim: Claim, settings: Settings, certificates: bool) -> Answer | None:
    """The answer to a claim from a process of its own; None where it can't be asked there and has to be decided here.

    **Arguments:** `settings`, the budget, seed, method and bytes of memory; `certificates`, whether the verdict brings
    its certificate along.

    **Returns:** a verdict, `undecided` with the reason where the process had to be killed; or an `InputError`.
    """
    try:
        return asked_apart(claim, settings, certificates)
    except NotApart:
        return None


def asked_apart(claim: Claim, settings: Settings, certificates: bool) -> Answer:
    """The answer to a claim from a process of its own, as `decided_apart`. **Raises:** `NotApart`."""
    if sys.platform == "win32":
        raise NotApart("a process can't be given a limit of memory on this system")
    with _LOCK:
        idle = _IDLE.setdefault(settings.memory, [])
        companion = idle.pop() if idle else None
    if companion is None or not companion.alive:
        _end_others(settings.memory)
        try:
            companion = Companion(settings.memory)
        except OSError:
            limit = "" if settings.memory is None else f" within {settings.memory} bytes"
            raise NotApart(f"no process could be started{limit}") from None
    answer = companion.ask(claim, settings, certificates)
    if companion.alive:
        with _LOCK:
            _IDLE.setdefault(settings.memory, []).append(companion)
    if answer is None:
        raise NotApart("something in the claim, or in the answer, can't be sent to another process")
    return answer


def _end_others(memory: int | None) -> None:
    """End what waits for claims of other limits, where that is many."""
    with _LOCK:
        others = [companion for limit, idle in _IDLE.items() if limit != memory for companion in idle]
        if len(others) < MOST_IDLE:
            return
        kept = _IDLE.get(memory, [])
        _IDLE.clear()
        _IDLE[memory] = kept
    for companion in others:
        companion.end()


def _forget() -> None:
    """Leave what waits to the process that has started it: two that speak over one pipe would get each other's answers.

    Called in a child after a fork, which may have been made while another thread held the lock.
    """
    global _LOCK
    _LOCK = threading.Lock()
    for waiting in _IDLE.values():
        _OF_PARENTS.extend(waiting)
        for companion in waiting:
            companion.connection.close()
    _IDLE.clear()


@atexit.register
def _end_all() -> None:
    for waiting in _IDLE.values():
        for companion in waiting:
            companion.end()
    _IDLE.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)


def serve(descriptor: int, memory: int | None) -> None:
    """Answer the claims that come over a pipe until it is closed, or memory has run out: what a companion does."""
    from canon.claims.many import decided_here

    connection = Connection(descriptor)
    isolate(memory)
    connection.send("ready")
    while True:
        try:
            claim, settings, certificates = connection.recv()
        except (EOFError, OSError):
            return
        except Exception:  # a claim with something in it that only its own program can make
            connection.send(None)
            continue
        seconds = settings.budget if claim.budget is None else float(claim.budget)
        alarm(seconds + 3 * settings.grace_of(seconds))
        answer = decided_here(claim, settings, certificates)
        alarm(0)
        verdict = answer if isinstance(answer, Verdict) else None
        try:
            sent = _send(connection, answer if verdict is None else replace(verdict, certificate=None))
            if certificates and sent and verdict is not None and not _is_out_of_memory(answer):
                alarm(3 * CERTIFICATE_SECONDS)
                _send(connection, verdict.certificate)  # it is made as it is sent
                alarm(0)
        except OSError:
            return
        if _is_out_of_memory(answer):
            return


def _send(connection: Connection, answer: object) -> bool:
    """Send a message, or None in its place where it can't be sent; whether it was."""
    try:
        connection.send(answer)
    except UNSENT:
        connection.send(None)
        return False
    return True


def _is_out_of_memory(answer: Answer | None) -> bool:
    return isinstance(answer, Verdict) and answer.detail.get("note") == "stopped: out of memory"
