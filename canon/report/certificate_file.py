"""Certificates written to files, one for each claim that is proved or refuted."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from canon.claim import Claim
from canon.claims.certificate_path import certificate_path
from canon.claims.folders import make_folder
from canon.claims.worker import Entry, text_of
from canon.errors import InputError
from canon.report.record import claim_record
from canon.verdict import Verdict


def certified(
    folder: str | None, entry: Entry, claim: Claim, verdict: Verdict
) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any] | None]:
    """The record of a verdict, the claim file's tables with this claim, and the certificate where there is one.

    With a `folder` the certificate is written there, and its path is in the record; where it can't be written null is,
    and the reason under `certificate_error` in the detail. So is it where the file isn't what it was any more: a
    certificate quotes it. Then the tables are empty.
    """
    from canon.claims.certificate_data import certificate, statement_tables

    record = claim_record(entry, claim, verdict)
    try:
        tables = statement_tables(_tables(text_of(entry)), entry.index)
    except InputError as error:
        record["detail"]["certificate_error"] = f"{entry.file}: {error.message}"
        return record, {}, None
    if verdict.status not in ("proved", "refuted"):
        return record, tables, None
    data = certificate(claim, verdict, tables)
    if folder is not None:
        path = certificate_path(folder, entry)
        try:
            write_certificate(path, data)
            record["certificate"] = str(path)
        except OSError as error:
            record["detail"]["certificate_error"] = f"{path} can't be written: {error.strerror or error}"
    return record, tables, data


@lru_cache(maxsize=1)
def _tables(text: str) -> Mapping[str, Any]:
    """What a file says, as tables: of its claims, which come one after the other, each asks for them."""
    from canon.claims import document

    return document.parse(text)


def write_certificate(path: Path, data: dict[str, Any]) -> None:
    """Write the certificate, all of it or nothing. Raises OSError."""
    make_folder(path.parent)
    handle, temporary = tempfile.mkstemp(prefix=".", suffix=".tmp", dir=path.parent)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            json.dump(data, file, indent=1, ensure_ascii=False, allow_nan=False)
            file.write("\n")
        os.chmod(temporary, 0o666 & ~_mask())
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise


def _mask() -> int:
    """The process's mask of permissions, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
