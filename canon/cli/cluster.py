"""Claims read and decided by the workers of a Dask cluster, whose executor does what processes here would do.

Files are opened here, since a worker may not see the same folders; what is in them goes there as text.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.worker import Entry, Settings

Record = dict[str, Any]
SECONDS = 10
"""How long a scheduler may take to answer."""
_ADDRESS: Final = re.compile(r"[a-z]+://\S+|[^\s/:]+:[0-9]+")
"""Of one without a port Dask makes a client that can't be closed again."""


def readings_of(address: str, paths: Sequence[Path]) -> list[tuple[list[Any], list[dict[str, str]], str]]:
    """What each of these files holds, read here as text and by the workers of the cluster at this address as claims:
    those, the file's faults, and the name of what it says.

    **Raises:** `InputError` where Dask isn't installed, or nobody answers there.
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
    with _client(address) as client:
        for place, read in read_many(texts(), Reaching(client)):
            found[sent[place]] = read
    return [(read.claims, read.problems, digest) for read, digest in zip(found, digests, strict=True)]


def answers_of(address: str, entries: Sequence[Entry], settings: Settings) -> Iterator[tuple[int, Record]]:
    """(position, answer) of the entries, as they come from the cluster whose scheduler is at this address.

    **Raises:** `InputError` where Dask isn't installed, or nobody answers there.
    """
    from canon.claims.many import verify_many
    from canon.claims.read_many import Sent
    from canon.report.record import claim_record

    claims = [entry.claim for entry in entries if entry.claim is not None]
    messages = [entry.message for entry in entries]
    given = [claim if m is None else Sent(claim, m) for claim, m in zip(claims, messages, strict=True)]
    with _client(address) as client:
        found = verify_many(
            given,
            executor=Reaching(client),
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
    """The executor of a client of Dask's that takes nothing once its scheduler is gone: what it took then would never
    be answered."""

    def __init__(self, client: Any) -> None:
        self.client, self.inner = client, client.get_executor()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Send a call to the cluster. **Raises:** `RuntimeError` where there is none any more."""
        if self.client.status not in ("running", "connecting"):
            raise RuntimeError("the scheduler of the cluster is gone")
        return self.inner.submit(fn, *args, **kwargs)


def _client(address: str) -> Any:
    try:
        from distributed import Client  # pyright: ignore[reportMissingImports]
    except ImportError:
        raise InputError("clusters need Dask: pip install 'canon-mechanics[cluster]'", "--cluster") from None
    if not _ADDRESS.fullmatch(address):
        raise InputError(f"an address of a scheduler is one like tcp://host:8786, not {address[:100]!r}", "--cluster")
    logging.getLogger("concurrent.futures").disabled = True  # it tells of calls that a closed client can't take back
    try:
        return Client(address, timeout=SECONDS, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise InputError(f"no scheduler of Dask answers at {address!r}: {error}"[:300], "--cluster") from None
