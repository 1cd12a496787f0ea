"""A claim decided in a process of its own, which is killed where it overstays its budget of time or of memory.

The workers of an executor that isn't ours (Dask's, or those of `concurrent.futures`) can't be killed by who asks them.
So each of them keeps a process beside it, in which the claims are decided one after the other: a call into C that looks
at no clock, or memory that runs out, costs one answer and not the worker. The process is kept for the next claims, as
importing takes a second; it ends when the worker does.
"""

from __future__ import annotations

import subprocess
import sys
import threading
from multiprocessing.connection import Connection, Pipe
from pickle import PicklingError
from typing import Final

from canon.claim import Claim
from canon.claims.worker import Settings, alarm, cause_of_death, isolate, without_verdict
from canon.errors import InputError
from canon.verdict import Verdict

Answer = Verdict | InputError
START: Final = 60.0
"""Seconds in which a process has to have imported what it needs."""
_PROGRAM: Final = "import sys; sys.path[:] = {path!r}; from canon.claims.apart import serve; serve({fd}, {memory})"
_IDLE: Final[dict[int | None, list[Companion]]] = {}
_LOCK: Final = threading.Lock()


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
        except (PicklingError, AttributeError, TypeError):
            return None
        try:
            if not self.connection.poll(seconds + settings.grace_of(seconds)):
                self.end()
                return without_verdict(claim, f"stopped: still busy well past its budget of {seconds:g} s", seconds)
            return self.connection.recv()
        except (EOFError, OSError):
            self.connection.close()
            return without_verdict(claim, cause_of_death(self.process.wait(START)), 0.0)
        except BaseException:
            self.end()
            raise

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
    if sys.platform == "win32":
        return None
    with _LOCK:
        idle = _IDLE.setdefault(settings.memory, [])
        companion = idle.pop() if idle else None
    if companion is None or not companion.alive:
        try:
            companion = Companion(settings.memory)
        except OSError:
            return None
    answer = companion.ask(claim, settings, certificates)
    if companion.alive:
        with _LOCK:
            _IDLE[settings.memory].append(companion)
    return answer


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
        try:
            connection.send(answer)
        except OSError:
            return
        except (PicklingError, AttributeError, TypeError):
            connection.send(None)
        if isinstance(answer, Verdict) and answer.detail.get("note") == "stopped: out of memory":
            return
