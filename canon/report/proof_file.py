"""Proofs written to one file: a section for each claim, made beside its verdict, in the notation of the file's name."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from types import ModuleType
from typing import Any, Final

from canon.claim import Claim
from canon.claims.worker import Entry, Recorder, Settings
from canon.report.record import claim_record
from canon.report.words import duration, name, visible
from canon.verdict import STATUSES, Verdict

Record = dict[str, Any]
NOTATIONS: Final = {".html": "html", ".htm": "html", ".tex": "latex", ".md": "markdown", ".txt": "plain"}
"""The endings of a file of proofs, and the notations that they stand for."""


def notation_of(name: str) -> str | None:
    """The notation that a file's name asks for, None where it has no such ending."""
    return NOTATIONS.get(os.path.splitext(name)[1].lower())


def recorder(settings: Settings) -> Recorder:
    """What makes the record of a verdict: with a certificate, with a section of proofs, where they are asked for."""
    if settings.certificates is None and settings.proof is None:
        return claim_record
    return partial(_record, settings.certificates, settings.proof)


def _record(folder: str | None, notation: str | None, entry: Entry, claim: Claim, verdict: Verdict) -> Record:
    """The record. A verdict is worth more than what is written of it, and stands whatever happens meanwhile."""
    from canon.report.certificate_file import certified

    record = None
    try:
        record, tables, data = certified(folder, entry, claim, verdict)
        if notation is not None and tables:
            record["proof"] = rendered(notation, record, tables, data)
    except Exception as error:
        record = claim_record(entry, claim, verdict) if record is None else record
        words = f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"
        record["detail"]["certificate_error"] = f"{entry.file}: stopped by an internal error, {words}"
    return record


def rendered(
    notation: str, record: Record, tables: Mapping[str, Any], data: Mapping[str, Any] | None
) -> tuple[str, str, str]:
    """The section of one claim in a notation: its heading, its setting, and the rest."""
    from canon.report.proof.section import section

    return _module(notation).section(section(record, tables, data))


def _module(notation: str) -> ModuleType:
    from importlib import import_module

    return import_module(f"canon.report.proof.{notation}")


def document(notation: str, title: str, claims: Sequence[Record], seconds: float) -> str:
    """The whole document: the sections that the claims' records hold, with a summary above them."""
    counts = [(word, sum(claim["verdict"] == word for claim in claims)) for word in STATUSES]
    said = ", ".join(f"{count} {word}" for word, count in counts if count) or "none"
    summary = f"{len(claims)} claim{'s' * (len(claims) != 1)}: {said}. Checked by canon in {duration(seconds)}."
    sections = list(_without_repeats(claims))
    make: Callable[..., str] = _module(notation).document
    title = visible(title)
    if notation == "html":
        entries = [(name(claim), claim["verdict"]) for claim in claims]
        return make(title, sections, entries, summary)
    return make(title, sections, summary)


def _without_repeats(claims: Sequence[Record]) -> Iterator[str]:
    """The sections; a setting that is that of the claim before isn't said again."""
    last = ""
    for heading, setting, rest in (claim["proof"] for claim in claims if "proof" in claim):
        yield "\n".join([heading, rest] if setting == last else [heading, setting, rest])
        last = setting
