"""Ends of ranges and limits as a claim file writes them: an expression, "infinity" or "-infinity"."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, Literal

from canon.errors import InputError

Infinity = Literal["infinity", "-infinity"]
INFINITIES: Final[tuple[Infinity, ...]] = ("infinity", "-infinity")


def read_end(value: Any, where: str, declares: Callable[[str], bool]) -> Infinity | None:
    """The infinity that a value is; None for an expression.

    **Raises:** `InputError` for other words for it, and where the file `declares` a name that is written so.
    """
    if not isinstance(value, str):
        return None
    text = value.strip().replace(" ", "")
    for infinity in INFINITIES:
        if text in (infinity, f"+{infinity}"):
            if declares("infinity"):
                raise InputError("'infinity' is a name of the file: call it otherwise, or write (infinity)", where)
            return infinity
    if (word := text.lstrip("+-")) in ("oo", "inf", "Infinity", "∞") and not declares(word):
        raise InputError(f"write 'infinity' or '-infinity', not {text!r}", where)
    return None


def read_side(value: Any, where: str) -> str:
    """ "+" or "-": from above or from below. **Raises:** `InputError`."""
    if value not in ("+", "-"):
        raise InputError("one of + - is expected: from above or from below", where)
    return value
