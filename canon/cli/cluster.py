"""Claims read and decided by the workers of a Dask cluster, whose executor does what processes here would do.

Files are opened here, since a worker may not see the same folders; what is in them goes there as text.
"""

from __future__ import annotations

import asyncio
import logging
import re
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, Executor, Future, InvalidStateError
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.worker import Entry, Settings

Record = dict[str, Any]
SECONDS = 10
"""How long a scheduler may take to answer, and a worker to come."""
PATIENCE: Final = 30.0
"""Seconds for which a cluster may be without a worker in the middle of a run: new ones may be on their way."""
GLANCE: Final = 2.0
"""Seconds between two looks at who is there."""
_ADDRESS: Final = re.compile(r"[a-z]+://\S+|[^\s/:]+:[0-9]+")


def readings_of(address: str, paths: Sequence[Path]) -> list[tuple[list[Any], list[dict[str, str]], str]]:
    """What each of these files holds, read here as text and by the workers of the cluster at this address as claims:
    those, the file's faults, and the name of what it says.

    **Raises:** `InputError` where Dask isn't installed, nobody answers there, or no worker is there.
    """
    from canon.claims import document
    from canon.claims.read_many import Found, read_many

    found: list[Found] = [Found([], [])] * len(paths)
    digests = [""] * len(paths)

    def texts() -> Iterator[str]:
        for number, path in enumerate(paths):
            try:
                text = document.content(path)
            except InputError as error:
                found[number] = Found([], [{"where": error.where, "message": error.message}])
                continue
            sent.append(number)
            digests[number] = document.digest(text)
            yield text

    sent: list[int] = []
    with _cluster(address) as executor:
        for place, read in read_many(texts(), executor):
            found[sent[place]] = read
    return [(read.claims, read.problems, digest) for read, digest in zip(found, digests, strict=True)]


def answers_of(address: str, entries: Sequence[Entry], settings: Settings) -> Iterator[tuple[int, Record]]:
    """(position, answer) of the entries, as they come from the cluster whose scheduler is at this address.

    **Raises:** `InputError` where Dask isn't installed, nobody answers there, or no worker is there.
    """
    from canon.claims.many import verify_many
    from canon.claims.read_many import Sent
    from canon.report.record import claim_record

    claims = [entry.claim for entry in entries if entry.claim is not None]
    messages = [entry.message for entry in entries]
    given = [claim if m is None else Sent(claim, m) for claim, m in zip(claims, messages, strict=True)]
    with _cluster(address) as executor:
        found = verify_many(
            given,
            executor=executor,
            budget=settings.budget,
            seed=settings.seed,
            method=settings.method,
            accuracy=settings.accuracy,
        )
        for position, answer in found:
            entry = entries[position]
            if isinstance(answer, InputError):
                own = f"claim {entry.index + 1}"
                where = answer.where if answer.where.startswith("claim ") else answer.at(own).where
                yield position, {"error": {"file": entry.file, "where": where, "message": answer.message}}
            else:
                yield position, {"claim": claim_record(entry, claims[position], answer)}


class Reaching(Executor):
    """The executor of a client of Dask's that takes nothing once its scheduler is gone or silent, or has been without a
    worker for as long as `patience`: what it took then would never be answered. What was out ends as lost."""

    def __init__(self, client: Any, patience: float, glance: float) -> None:
        self.client, self.inner = client, client.get_executor()
        self.gone = ""
        self._out: set[Future[Any]] = set()
        self._over = threading.Event()
        threading.Thread(target=self._watch, args=(patience, glance), daemon=True).start()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Send a call to the cluster. **Raises:** `RuntimeError` where there is none any more."""
        if self.gone or self.client.status not in ("running", "connecting"):
            raise RuntimeError(self.gone or "the scheduler of the cluster is gone")
        # a future of our own, as one of Dask's can't be ended without a word from its scheduler
        sent, own = self.inner.submit(fn, *args, **kwargs), Future()
        self._out.add(own)

        def answered(done: Future[Any]) -> None:
            with suppress(InvalidStateError):  # it has been called off
                if done.cancelled():
                    own.set_exception(CancelledError("it was called off"))
                elif (error := done.exception()) is not None:
                    own.set_exception(error)
                else:
                    own.set_result(done.result())
            self._out.discard(own)

        sent.add_done_callback(answered)
        own.add_done_callback(lambda done: done.cancelled() and sent.cancel())
        return own

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Look at nothing any more."""
        self._over.set()

    def _watch(self, patience: float, glance: float) -> None:
        """Give up where nobody has been there to work for too long; a scheduler that is silent has nobody."""
        alone, last = 0.0, time.monotonic()
        while not self._over.wait(glance):
            there, now = _is_manned(self.client), time.monotonic()
            # a process that was stopped for a while has looked away, and no worker is missing for that
            alone, last = 0.0 if there else alone + min(now - last, glance + SECONDS), now
            if alone > patience:
                self.gone = f"the cluster has had no worker for {alone:.0f} s"
                break
        while self.gone and not self._over.wait(glance):  # and again: one may have been on its way to it
            for own in tuple(self._out):
                with suppress(InvalidStateError):
                    own.set_exception(RuntimeError(self.gone))


def _is_manned(client: Any) -> bool:
    """Whether the scheduler answers, and has a worker."""
    with suppress(Exception):  # of Dask's many ways to say that nobody answers
        return bool(client.sync(client.scheduler.ncores, callback_timeout=SECONDS))
    return False


@contextmanager
def _cluster(address: str) -> Iterator[Reaching]:
    client = _client(address)
    try:
        end = time.monotonic() + SECONDS
        while not _is_manned(client):
            if time.monotonic() > end:
                what = f"the scheduler at {address!r} has no worker, and none has come in {SECONDS} s: start one"
                raise InputError(f"{what}, as by `dask worker {address}`"[:300], "--cluster")
            time.sleep(0.1)
        with Reaching(client, PATIENCE, GLANCE) as executor:
            yield executor
    finally:
        try:
            client.close(timeout=SECONDS)
        except Exception:  # nobody is there to take leave of
            client.status = "closed"  # else it tries again while Python ends, and says that it couldn't


def _client(address: str) -> Any:
    try:
        from distributed import Client  # pyright: ignore[reportMissingImports]
    except ImportError:
        raise InputError("clusters need Dask: pip install 'canon-mechanics[cluster]'", "--cluster") from None
    if not _ADDRESS.fullmatch(address):
        raise InputError(f"an address of a scheduler is one like tcp://host:8786, not {address[:100]!r}", "--cluster")
    for logger in ("concurrent.futures", "asyncio"):  # of calls that a closed client can't take back, and the like
        logging.getLogger(logger).disabled = True
    try:
        asyncio.run(_knock(address))  # a client of Dask's that couldn't begin can't be closed again
        return Client(address, timeout=SECONDS, set_as_default=False)
    except Exception as error:  # what is there may be anything, and say anything
        words = " ".join(str(error).split()) or f"it said nothing in {SECONDS} s"
        raise InputError(f"no scheduler of Dask answers at {address!r}: {words}"[:300], "--cluster") from None


async def _knock(address: str) -> None:
    from distributed import Security  # pyright: ignore[reportMissingImports]
    from distributed.comm.core import connect  # pyright: ignore[reportMissingImports]

    security = Security().get_connection_args("client")
    comm = await asyncio.wait_for(connect(address, timeout=SECONDS, **security), SECONDS)
    await comm.close()
