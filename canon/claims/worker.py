"""One worker process: it verifies the claims that it is told to, one at a time, and can be killed at any moment.

Positions come in and records go out over a pipe as JSON. A worker ignores Ctrl-C (its parent decides), is silent
on the terminal, keeps within a limit of memory, and ends by itself when its parent is gone.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any, Literal

from canon.claim import Claim
from canon.errors import InputError
from canon.interruption import let_go
from canon.verdict import Verdict

Record = dict[str, Any]
ENDED = "stopped: its worker process "
"""How it is said of a claim whose worker ended, not of its own accord: nobody has answered it, another run may."""
CERTIFICATE_SECONDS = 10.0
"""What the identities of one certificate may take."""


@dataclass(frozen=True)
class Entry:
    """A claim, and where it was read: `file` as shown, `path` as opened, `index` counted from 0 in the file.

    `claim` is None only in a worker that was spawned rather than forked: it reads the file again. Where workers of a
    cluster have read it, `claim` is what a report needs of it, and `message` the whole, which they alone open.
    `digest` names what the file said when the claim was read: answers are kept, and certificates made, of that alone.
    """

    file: str
    index: int
    claim: Claim | None
    path: str = ""
    message: bytes | None = None
    digest: str = ""


@dataclass(frozen=True)
class Settings:
    """What holds for every claim of a run: seconds for each, random seed, method, and bytes of memory a worker.

    `certificates` is the folder into which a certificate of each proof and refutation goes (None: nowhere); `proof`,
    the notation of the proofs that are to be written out (None: none); `accuracy`, what sampled residuals are to be
    bounded by (None: what double precision shows); `recording`, whether its record may take as long
    again as the verdict.
    """

    budget: float = 10.0
    seed: int = 0
    method: Literal["symbolic", "numeric", "all"] = "symbolic"
    memory: int | None = None
    certificates: str | None = None
    proof: str | None = None
    accuracy: float | None = None
    recording: bool = False

    def seconds(self, entry: Entry) -> float:
        """Return the budget of this claim; its own wins."""
        own = entry.claim.budget if entry.claim is not None else None
        return self.budget if own is None else float(own)

    def grace(self, entry: Entry) -> float:
        """Return how many seconds past its budget a claim is left alone before its worker is killed."""
        writing = 0.0 if self.certificates is None and self.proof is None else CERTIFICATE_SECONDS + 2.0
        writing += self.seconds(entry) if self.recording else 0.0
        return writing + self.grace_of(self.seconds(entry))

    @staticmethod
    def grace_of(seconds: float) -> float:
        """Return the same for a budget, if nothing is to be written."""
        return min(5.0, max(1.0, 0.2 * seconds))


Recorder = Callable[[Entry, Claim, Verdict], Record]


def without_verdict(claim: Claim, note: str, seconds: float) -> Verdict:
    """Return the verdict `undecided` for a claim whose verification was cut short, with the reason."""
    return Verdict(
        status="undecided", kind=claim.kind, title=claim.title, method="", seconds=seconds, detail={"note": note}
    )


def serve(
    connection: Connection,
    entries: Sequence[Entry],
    settings: Settings,
    recorder: Recorder,
    inherited: Sequence[Connection] = (),
) -> None:
    """Answer the positions that come over `connection` until it is closed or memory runs out.

    **Arguments**: `inherited` are the parent's ends of pipes that a fork has copied; they are closed here, so that
    each worker learns of its parent's end.
    """
    for other in inherited:
        other.close()
    isolate(settings.memory)
    while True:
        try:
            position = json.loads(connection.recv_bytes())
        except (EOFError, OSError):
            return
        reply = _answer(entries[position], settings, recorder)
        try:
            connection.send_bytes(json.dumps(reply).encode())
        except OSError:
            return
        if reply["retire"]:
            return


def _answer(entry: Entry, settings: Settings, recorder: Recorder) -> Record:
    """Return {"claim": record} or {"error": record}, and whether this worker should be replaced afterwards."""
    from canon.claims.verify import verify

    start = time.monotonic()
    try:
        claim = entry.claim if entry.claim is not None else _read_again(entry)
    except InputError as error:
        return {"error": {"file": entry.file, "where": error.where, "message": error.message}, "retire": False}
    budget = settings.seconds(Entry(entry.file, entry.index, claim))
    alarm(budget + 3 * settings.grace(entry))
    retire = False
    try:
        verdict = verify(claim, budget=budget, seed=settings.seed, method=settings.method, accuracy=settings.accuracy)
    except InputError as error:
        own = f"claim {entry.index + 1}"
        where = error.where if error.where.startswith("claim ") else error.at(own).where
        return {"error": {"file": entry.file, "where": where, "message": error.message}, "retire": False}
    except MemoryError:
        retire = True
        verdict = without_verdict(claim, "stopped: out of memory", time.monotonic() - start)
    except Exception as error:
        note = f"stopped by an internal error, {type(error).__name__}: {error} {_place(error)}".strip()
        verdict = without_verdict(claim, note, time.monotonic() - start)
    finally:
        alarm(0)
    return {"claim": recorder(entry, claim, verdict), "retire": retire}


def _place(error: Exception) -> str:
    """Return the file and line where an unexpected exception was raised, so that it can be reported."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    if trace is None:
        return ""
    return f"({os.path.basename(trace.tb_frame.f_code.co_filename)}, line {trace.tb_lineno})"


def _read_again(entry: Entry) -> Claim:
    """Return the claim of an entry that came without it. Raises InputError where its file says something else now."""
    from canon.claims.reader import read_text

    text = text_of(entry)
    return next(claim for claim in read_text(text).claims if claim.index == entry.index)


def text_of(entry: Entry) -> str:
    """Return what an entry's file says. Raises InputError where that isn't what it said when the claim was read."""
    from canon.claims import document

    text = document.content(entry.path)
    if entry.digest and document.digest(text) != entry.digest:
        raise InputError("has changed since it was read")
    return text


def cause_of_death(code: int | None) -> str:
    """Return what is said of a claim whose worker ended with this status (negative: by that signal)."""
    if code is None or code >= 0:
        return f"{ENDED}ended with status {code}"
    name = signal.Signals(-code).name if -code in {s.value for s in signal.Signals} else f"signal {-code}"
    likely = " (out of memory, most likely)" if name in {"SIGABRT", "SIGKILL", "SIGSEGV"} else ""
    return f"{ENDED}was ended by {name}{likely}"


def isolate(memory: int | None) -> None:
    """Leave Ctrl-C, and a terminal that is closed, to the parent, be silent (libraries in C print as they abort), and
    limit memory where it can be."""
    for name, handler in (("SIGINT", signal.SIG_IGN), ("SIGHUP", signal.SIG_IGN), ("SIGTERM", signal.SIG_DFL)):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), handler)
    let_go()
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
    if memory is None or sys.platform == "win32":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    limit = memory if hard == resource.RLIM_INFINITY else min(memory, hard)
    with contextlib.suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))


def alarm(seconds: float) -> None:
    """Let the system end this process after so many seconds (0: never), in case the parent is no longer there."""
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, min(seconds, 1e8))
