"""Many claims at once: worker processes that are fed one claim at a time and killed when one overstays its budget.

A claim that hangs, exhausts its memory or crashes a library in C costs its own answer only: it is `undecided`, with
a note that says what happened, and its worker is replaced. What a worker had that was ended by somebody else, or whose
time was over while nobody ran (Ctrl-Z), is asked again.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from canon.claims.worker import Entry, Record, Recorder, Settings, cause_of_death, serve, without_verdict
from canon.interruption import continued, held, raise_again

Watcher = Callable[[int, Sequence[int]], None]
GIB = 1 << 30


class NoWorkers(Exception):
    """The system starts no worker process, and there is none, with the reason."""


@dataclass
class _Worker:
    """A process, the parent's end of its pipe, and what it is busy with since when (None: idle)."""

    process: BaseProcess
    connection: Connection
    position: int | None = None
    started: float = 0.0
    deadline: float = float("inf")
    stops: int = 0
    """How often this program had been stopped and continued when the claim was handed over."""


def run(
    entries: Sequence[Entry],
    settings: Settings,
    recorder: Recorder,
    *,
    jobs: int | None = None,
    watch: Watcher | None = None,
    start_method: str | None = None,
) -> Iterator[tuple[int, Record]]:
    """Verify the claims in worker processes and yield (position, reply) in the order in which they are answered.

    **Arguments**: `recorder` makes the record of a verdict (data that JSON can hold); `jobs` is the number of workers
    (default: the cores that this process may use); `watch(done, running)` is called now and then, with the number of
    answers and the positions in work; `start_method` is "fork" or "spawn" (default: fork where that is safe).

    **Yields**: the position in `entries` and {"claim": record}, or {"error": {file, where, message}} where the claim
    turned out to be ill-posed. Leaving the loop early, also by Ctrl-C, ends all workers.

    **Raises**: `NoWorkers` where the system starts none (any more); where it starts fewer, those do the work.
    """
    if not entries:
        return
    count = min(jobs or available_cores(), len(entries))
    if settings.memory is None:
        settings = replace(settings, memory=memory_limit(count))
    team = _Team(entries, settings, recorder, start_method or _start_method())
    waiting = deque(range(len(entries)))
    done = 0
    try:
        while done < len(entries):
            while waiting and len(team.workers) < count:
                try:
                    team.hire()
                except OSError as error:
                    if not team.workers:
                        raise NoWorkers(f"the system starts no process: {error.strerror or error}") from None
                    count = len(team.workers)  # those that there are do the rest
            for worker in team.workers:
                if worker.position is None and waiting:
                    team.give(worker, waiting.popleft())
            for position, reply in team.answers(until=time.monotonic() + 0.25 if watch else float("inf")):
                done += 1
                yield position, reply
            waiting.extendleft(team.to_ask_again())
            raise_again()
            if watch:
                watch(done, [worker.position for worker in team.workers if worker.position is not None])
    finally:
        team.dismiss()


class _Team:
    """The workers of one run."""

    def __init__(self, entries: Sequence[Entry], settings: Settings, recorder: Recorder, start_method: str) -> None:
        self.entries = entries
        self.settings = settings
        self.recorder = recorder
        self.forked = start_method == "fork"
        self.context: Any = multiprocessing.get_context(start_method)
        self.workers: list[_Worker] = []
        self.again: list[int] = []
        self.lost: set[int] = set()
        if self.forked:
            import canon.claims.verify  # noqa: F401  imported once, before the forks share it

    def hire(self) -> None:
        """Start a worker. A spawned one gets the places of the claims and reads the files again."""
        mine, its = self.context.Pipe()
        try:
            process = self._started(mine, its)
        except OSError:
            mine.close()
            raise
        finally:
            its.close()
        self.workers.append(_Worker(process, mine))

    def _started(self, mine: Connection, its: Connection) -> BaseProcess:
        if self.forked:
            entries: Sequence[Entry] = self.entries
            inherited = [*(worker.connection for worker in self.workers), mine]
        else:
            entries = [replace(entry, claim=None) for entry in self.entries]
            inherited = []
        process = self.context.Process(
            target=serve, args=(its, entries, self.settings, self.recorder, inherited), daemon=True
        )
        with held():
            process.start()
        return process

    def give(self, worker: _Worker, position: int) -> None:
        """Hand a claim to an idle worker."""
        entry = self.entries[position]
        worker.position = position
        worker.stops = continued()
        worker.started = time.monotonic()
        worker.deadline = worker.started + self.settings.seconds(entry) + self.settings.grace(entry)
        if not self.forked:
            worker.deadline += 20.0  # a spawned worker first imports the package, on a machine that may be busy
        try:
            worker.connection.send_bytes(json.dumps(position).encode())
        except OSError:
            worker.deadline = worker.started  # it has died: `answers` will find the end of its pipe

    def answers(self, until: float) -> list[tuple[int, Record]]:
        """Wait for an answer, a death or a deadline (or the time `until`), and return what has come in."""
        busy = [worker for worker in self.workers if worker.position is not None]
        nearest = min([until, *(worker.deadline for worker in busy)])
        ready = wait([worker.connection for worker in busy], timeout=min(3600.0, max(0.0, nearest - time.monotonic())))
        found: list[tuple[int, Record]] = []
        for worker in busy:
            position = worker.position
            assert position is not None
            if worker.connection in ready:
                try:
                    reply = json.loads(worker.connection.recv_bytes())
                except (EOFError, OSError):
                    cause = self._cause_of_death(worker)
                    if position in self.lost:
                        found.append((position, self._lost(worker, cause)))
                    else:  # whoever ended it may not have meant the claim
                        self.lost.add(position)
                        self.again.append(position)
                    self._drop(worker)
                    continue
                if worker.stops != continued() and _is_open(reply):
                    self.again.append(position)
                else:
                    found.append((position, reply))
                worker.position, worker.deadline = None, float("inf")
                if reply["retire"]:
                    self._drop(worker)
            # a wait that is interrupted may be over without a look at what has come
            elif time.monotonic() >= worker.deadline and not worker.connection.poll():
                if worker.stops != continued():
                    self.again.append(position)
                    self._drop(worker)
                    continue
                budget = self.settings.seconds(self.entries[position])
                found.append(
                    (position, self._lost(worker, f"stopped: still busy well past its budget of {budget:g} s"))
                )
                self._drop(worker)
        return found

    def to_ask_again(self) -> list[int]:
        """The positions to which nobody has had the time to answer; they are forgotten here."""
        positions, self.again = self.again, []
        return positions

    def dismiss(self) -> None:
        """End all workers at once."""
        for worker in self.workers:
            worker.process.kill()
        for worker in self.workers:
            worker.process.join()
            worker.connection.close()
        self.workers.clear()

    def _drop(self, worker: _Worker) -> None:
        worker.process.kill()
        worker.process.join()
        worker.connection.close()
        self.workers.remove(worker)

    def _lost(self, worker: _Worker, note: str) -> Record:
        assert worker.position is not None
        entry = self.entries[worker.position]
        assert entry.claim is not None
        verdict = without_verdict(entry.claim, note, time.monotonic() - worker.started)
        return {"claim": self.recorder(entry, entry.claim, verdict), "retire": False}

    def _cause_of_death(self, worker: _Worker) -> str:
        worker.process.join(10.0)  # it has closed its pipe; what the system writes down of its end may take a while
        return cause_of_death(worker.process.exitcode)


def _is_open(reply: Record) -> bool:
    """Whether more time might have brought another answer."""
    return "claim" in reply and reply["claim"]["verdict"] not in ("proved", "refuted")


def _start_method() -> str:
    """Return "fork" where the platform has it and no other thread could hold a lock across it, else "spawn"."""
    alone = threading.active_count() == 1 and "jax" not in sys.modules  # jax has threads of its own
    forkable = "fork" in multiprocessing.get_all_start_methods() and alone
    return "fork" if forkable else "spawn"


def available_cores() -> int:
    """Return the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def memory_limit(workers: int) -> int | None:
    """Return how many bytes of address space each worker may have: its share of four fifths, at least 2 GiB."""
    try:
        total = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return None
    return max(2 * GIB, int(0.8 * total / workers))
