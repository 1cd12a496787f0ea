"""Where a run of `canon verify` goes: the terminal, as text or JSON, a file of proofs, a folder of certificates."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from typing import Any, Final

from canon.cli.files import is_protected, same_file
from canon.cli.spoken import notation

Record = dict[str, Any]
NUL: Final = "no file's name has the character NUL in it"


def no_proof_file(name: str, others: Iterable[str | None] = ()) -> str:
    """Return why proofs can't go into a file of this name, as it is one of the others, or nothing."""
    from canon.report.proof_file import NOTATIONS, notation_of

    if notation_of(name) is None:
        return f"{name!r} has none of the endings {', '.join(NOTATIONS)}"
    if "\0" in name:
        return NUL
    if same_file(name, others):
        return f"{name!r} would be written over what is read from it, or written to it as well"
    folder = os.path.dirname(name) or "."
    if os.path.isdir(name) or not os.path.isdir(folder):
        return f"{name!r} is a folder" if os.path.isdir(name) else f"there is no folder {folder!r}"
    if os.path.exists(name) and not os.path.isfile(name):
        return f"{name!r} is no regular file"
    if is_protected(name):
        return f"{name!r} is there, and is protected against being written over"
    return "" if os.access(folder, os.W_OK) else f"{folder!r} can't be written to"


def write_proofs(name: str, claims: list[Record], seconds: float) -> str:
    """Write the sections that the claims' records hold, take them out of these, and return what went wrong, if so."""
    from canon.report.proof_file import document, notation_of
    from canon.report.whole_file import written

    files = list(dict.fromkeys(claim["file"] for claim in claims))
    title = f"Proofs of {files[0]}" if len(files) == 1 else f"Proofs of {len(files)} claim files"
    text = document(str(notation_of(name)), title, claims, seconds)
    for claim in claims:
        claim.pop("proof", None)
    try:
        written(name, text)
    except OSError as error:
        return f"{name!r} can't be written: {error.strerror}"
    return ""


def not_a_folder(name: str, journal: str | None) -> str:
    """Make the folder for certificates, and return why that isn't possible, or nothing.

    A journal has no place in it under a name that a certificate may have, which would be written over it.
    """
    if "\0" in name:
        return NUL
    inside = os.path.join(os.path.realpath(name), "")
    if journal and journal.endswith(".json") and os.path.realpath(journal).startswith(inside):
        return f"a certificate might be written over the journal {journal!r}: call that otherwise, or keep it elsewhere"
    from canon.claims.folders import make_folder

    try:
        make_folder(name)
    except OSError as error:
        return f"{name!r} is no folder and can't be made one: {error.strerror}"
    return "" if os.access(name, os.W_OK) else f"{name!r} can't be written to"


def print_report(record: Record, *, json: bool, terminal: bool, seconds: float, interrupted: int) -> None:
    """Print the report of the run in the form that the reader of it can use."""
    if json:
        from canon.report.words import MATTERS

        claims = [{key: value for key, value in claim.items() if key != MATTERS} for claim in record["claims"]]
        print(notation({**record, "claims": claims}, indent=1))
    elif terminal:
        from canon.report.console import print_record
        from canon.report.console import terminal as here

        print_record(record, here(), seconds=seconds, interrupted=interrupted)
    else:
        from canon.report.plain import print_rest

        print_rest(record, sys.stdout, seconds=seconds, interrupted=interrupted)
