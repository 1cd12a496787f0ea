"""How a command that takes one file says why it has no answer: a line for people, or the errors of its JSON record."""

from __future__ import annotations

from typing import Any

from canon.cli.parser import BAD_INPUT, NOT_FOUND
from canon.cli.spoken import complain, notation


def refused(command: str, file: str | None, error: Any, *, as_json: bool) -> int:
    """Print an `InputError` with its place, and return the exit status of bad input."""
    _say(command, file, error.where, error.message, as_json)
    return BAD_INPUT


def unfinished(command: str, file: str | None, reason: str, *, as_json: bool) -> int:
    """Print why there is no answer though the input is good, and return the exit status of that."""
    _say(command, file, "", reason, as_json)
    return NOT_FOUND


def _say(command: str, file: str | None, where: str, message: str, as_json: bool) -> None:
    if as_json:
        print(notation({"format": 1, "errors": [{"file": file, "where": where, "message": message}]}, indent=1))
    else:
        place = ", ".join(part for part in (file, where) if part)
        complain(f"canon {command}: {place}: {message}")
