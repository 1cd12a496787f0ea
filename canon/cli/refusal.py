"""How a command that takes one file says that its input is bad: a line for people, or the errors of its JSON record."""

from __future__ import annotations

from typing import Any

from canon.cli.parser import BAD_INPUT
from canon.cli.spoken import complain, notation


def refused(command: str, file: str | None, error: Any, *, as_json: bool) -> int:
    """Print an `InputError` with its place, and return the exit status of bad input."""
    if as_json:
        record = {"format": 1, "errors": [{"file": file, "where": error.where, "message": error.message}]}
        print(notation(record, indent=1))
    else:
        place = ", ".join(part for part in (file, error.where) if part)
        complain(f"canon {command}: {place}: {error.message}")
    return BAD_INPUT
