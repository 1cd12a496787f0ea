"""Claims on the workers of a Dask cluster: its executor does what processes here would do."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.worker import Entry, Settings

Record = dict[str, Any]
SECONDS = 10
"""How long a scheduler may take to answer."""


def answers_of(address: str, entries: Sequence[Entry], settings: Settings) -> Iterator[tuple[int, Record]]:
    """(position, answer) of the entries, as they come from the cluster whose scheduler is at this address.

    **Raises:** `InputError` where Dask isn't installed, or nobody answers there.
    """
    try:
        from distributed import Client  # pyright: ignore[reportMissingImports]
    except ImportError:
        raise InputError("clusters need Dask: pip install 'canon-mechanics[cluster]'", "--cluster") from None
    from canon.claims.many import verify_many
    from canon.report.record import claim_record

    claims = [entry.claim for entry in entries if entry.claim is not None]
    try:
        client = Client(address, timeout=SECONDS, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise InputError(f"no scheduler of Dask answers at {address!r}: {error}"[:300], "--cluster") from None
    with client:
        found = verify_many(
            claims,
            executor=client.get_executor(),
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
