"""Certificates in files, read with limits on what they may ask for."""

from __future__ import annotations

import json
import os
import stat
from typing import Any

from canon.checker.functions import Unreadable

BIGGEST = 8_000_000
"""The most bytes that a certificate may have."""


def load(path: str) -> Any:
    """The JSON of a file. Raises Unreadable, with the reason."""
    try:
        if not os.path.isfile(path):
            raise Unreadable("no such file" if not os.path.lexists(path) else "not a regular file")
        with open(path, "rb", opener=_at_once) as file:  # it may be another one, or longer, by now
            data = file.read(BIGGEST + 1) if stat.S_ISREG(os.fstat(file.fileno()).st_mode) else b""
        if data is None or len(data) > BIGGEST:
            raise Unreadable("nothing can be read" if data is None else f"more than {BIGGEST} bytes")
        return json.loads(data.decode("utf-8"), object_pairs_hook=_once)
    except OSError as error:
        raise Unreadable(f"can't be read: {error.strerror}") from None
    except (ValueError, RecursionError) as error:
        raise error if isinstance(error, Unreadable) else Unreadable("not JSON in UTF-8") from None


def _at_once(path: str, flags: int) -> int:
    """Open a file without waiting for one who writes into it."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise Unreadable("a key stands twice in one table")
    return found
