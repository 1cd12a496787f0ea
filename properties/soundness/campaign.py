"""Many random cases decided, and what became of them."""

from __future__ import annotations

import multiprocessing
import resource
import signal
import statistics
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError
from properties.soundness.cases import Case, case

BUDGET = 3.0
HARD_LIMIT = 60
"""Seconds of a processor after which a case is given up."""
MEMORY = 3 << 30


@dataclass(frozen=True)
class Record:
    """What became of one case: its verdict, whether that is `wrong`, and in what time.

    `outcome` is a verdict, "refused" (an input error where the oracle saw points of the domain), "no claim" (nothing
    to decide), "crash", or "killed" (its process died: of memory, most likely).
    """

    seed: int
    family: str
    truth: bool | None
    outcome: str
    wrong: str = ""
    confirmed: bool | None = None
    cause: str = ""
    note: str = ""
    seconds: float = 0.0
    text: str = ""


class _TooLong(Exception):
    """A case that ran far beyond its budget."""


def _alarm(*_: Any) -> None:
    raise _TooLong


def run_one(seed: int, make: Callable[[int], Case | None] = case) -> Record:
    """The case that `make` makes of a seed, decided and judged."""
    signal.signal(signal.SIGPROF, _alarm)
    signal.setitimer(signal.ITIMER_PROF, HARD_LIMIT)
    found = None
    try:
        found = make(seed)
        return Record(seed, "none", None, "no claim") if found is None else judged(seed, found)
    except Exception as error:
        text = found.text if found else ""
        family = found.family if found else "oracle"
        return Record(seed, family, None, "crash", cause=f"{type(error).__name__}: {error}"[:300], text=text)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def judged(seed: int, found: Case) -> Record:
    """The verdict on a case beside its truth."""
    start = time.perf_counter()
    reading = read_text(found.text)
    if reading.problems:
        message = reading.problems[0]["message"]
        return Record(seed, found.family, found.truth, "refused", cause=message[:200], note=found.note, text=found.text)
    try:
        verdict = verify(reading.claims[0], budget=BUDGET, seed=seed)
    except InputError as error:
        return Record(
            seed, found.family, found.truth, "refused", cause=str(error)[:200], note=found.note, text=found.text
        )
    seconds = time.perf_counter() - start
    confirmed, wrong = None, ""
    if verdict.status == "proved" and found.truth is False:
        wrong = "proved"
    if verdict.status == "refuted":
        confirmed = found.confirm(verdict.witness) if verdict.witness else None
        if found.truth is True or confirmed is False:
            wrong = "refuted"
    cause = str(verdict.detail.get("note", ""))[:300] if verdict.status in ("supported", "undecided") else ""
    decided = verdict.status in ("proved", "refuted")
    return Record(
        seed, found.family, found.truth, verdict.status, wrong, confirmed, cause, found.note, seconds,
        "" if decided and not wrong else found.text,
    )  # fmt: skip


def limit_memory() -> None:
    """Rather let one case fail than the machine."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def run(seeds: Sequence[int], jobs: int, make: Callable[[int], Case | None] = case) -> Iterator[Record]:
    """Records of the cases that `make` makes of these seeds, as they come.

    With two jobs or more they are decided in processes of their own, which may die: a library in C ends its process
    when memory is refused. The case that did it is recorded as such, and the others go on.
    """
    if jobs <= 1:
        yield from (run_one(seed, make) for seed in seeds)
        return
    waiting, at_work = deque(seeds), dict[Connection, _Worker]()
    try:
        while waiting or at_work:
            while waiting and len(at_work) < jobs:
                worker = _hired([waiting.popleft() for _ in range(min(CHUNK, len(waiting)))], make)
                at_work[worker.pipe] = worker
            for pipe in wait(list(at_work)):
                worker = at_work[pipe]  # type: ignore[index]
                try:
                    record = Record(**worker.pipe.recv())
                    worker.left.popleft()
                    yield record
                except EOFError:
                    del at_work[worker.pipe]
                    worker.process.join()
                    if worker.left:
                        cause = f"its process ended with status {worker.process.exitcode}"
                        yield Record(worker.left.popleft(), "killed", None, "killed", cause=cause)
                        waiting.extendleft(reversed(worker.left))
    finally:
        for worker in at_work.values():
            worker.process.kill()


CHUNK = 200
"""Cases for which a process is started."""


@dataclass(frozen=True)
class _Worker:
    """A process, the end of its pipe, and the seeds that it hasn't answered."""

    process: BaseProcess
    pipe: Connection
    left: deque[int]


def _hired(seeds: list[int], make: Callable[[int], Case | None]) -> _Worker:
    context = multiprocessing.get_context("fork")
    mine, its = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(its, seeds, make), daemon=True)
    process.start()
    its.close()
    return _Worker(process, mine, deque(seeds))


def _work(pipe: Connection, seeds: list[int], make: Callable[[int], Case | None]) -> None:
    limit_memory()
    for seed in seeds:
        pipe.send(asdict(run_one(seed, make)))


def summary(records: list[Record]) -> dict[str, Any]:
    """The figures of a campaign."""
    cases = [r for r in records if r.outcome != "no claim"]
    decided = [r for r in cases if r.outcome in ("proved", "refuted")]
    times = sorted(r.seconds for r in cases if r.seconds)
    families: dict[str, dict[str, int]] = {}
    for record in cases:
        truth = {True: "true", False: "false", None: "open"}[record.truth]
        families.setdefault(f"{record.family}, {truth}", Counter())[record.outcome] += 1
    return {
        "cases": len(cases),
        "no_claim": len(records) - len(cases),
        "wrong_proved": sum(r.wrong == "proved" for r in cases),
        "wrong_refuted": sum(r.wrong == "refuted" for r in cases),
        "crashes": sum(r.outcome == "crash" for r in cases),
        "killed": [r.seed for r in cases if r.outcome == "killed"],
        "witnesses_confirmed": sum(r.confirmed is True for r in cases),
        "decided_share": round(len(decided) / max(1, len(cases)), 4),
        "outcomes": dict(Counter(r.outcome for r in cases)),
        "families": {name: dict(found) for name, found in sorted(families.items())},
        "seconds": _percentiles(times),
        "causes": dict(Counter(_short(r) for r in cases if r.outcome not in ("proved", "refuted")).most_common(12)),
        "wrong": [asdict(r) for r in cases if r.wrong],
        "crashed": [asdict(r) for r in cases if r.outcome == "crash"][:20],
    }


def _short(record: Record) -> str:
    cause = record.cause.split(":")[0].split("(")[0].split(";")[0].strip()[:60]
    return f"{record.family}, {record.outcome}: {cause}"


def _percentiles(times: list[float]) -> dict[str, float]:
    if len(times) < 2:
        return {}
    cuts = statistics.quantiles(times, n=100)
    return {
        "median": round(cuts[49], 4),
        "p90": round(cuts[89], 4),
        "p99": round(cuts[98], 4),
        "max": round(times[-1], 3),
    }
