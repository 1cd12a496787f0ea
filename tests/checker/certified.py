"""Certificates of claims stated as text, for the checker's tests; they are data, to be changed by copies only."""

import json
from collections.abc import Iterator
from functools import cache
from typing import Any

from canon.checker.check import checksum
from canon.claims import document
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.reader import read_tables
from canon.claims.verify import verify


@cache
def _written(text: str) -> str:
    tables = document.parse(text)
    (claim,) = read_tables(tables).claims
    return json.dumps(certificate(claim, verify(claim), statement_tables(tables, 0)))


def certified(text: str, keys: str) -> Any:
    """The certificate of the single claim with these keys, beside the other tables of a file; a copy of one's own."""
    return json.loads(_written(f"{text}\n[[claim]]\n{keys}"))


def resealed(data: Any) -> Any:
    """The certificate with the checksum that it now has."""
    return {**data, "checksum": checksum(data)}


def places(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The path of every table, list and leaf."""
    if path:
        yield path
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, item in items:
        yield from places(item, (*path, key))
