"""Certificates in files, read with limits on what they may ask for."""

from __future__ import annotations

import json
import os
from typing import Any

from canon.checker.functions import Unreadable

BIGGEST = 8_000_000
"""The most bytes that a certificate may have."""


def load(path: str) -> Any:
    """The JSON of a file. Raises Unreadable, with the reason."""
    try:
        if not os.path.isfile(path):
            raise Unreadable("no such file" if not os.path.lexists(path) else "not a regular file")
        if os.path.getsize(path) > BIGGEST:
            raise Unreadable(f"more than {BIGGEST} bytes")
        with open(path, encoding="utf-8") as file:
            return json.load(file, object_pairs_hook=_once)
    except OSError as error:
        raise Unreadable(f"can't be read: {error.strerror}") from None
    except (ValueError, RecursionError) as error:
        raise error if isinstance(error, Unreadable) else Unreadable("not JSON in UTF-8") from None


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise Unreadable("a key stands twice in one table")
    return found
