"""A journal of a campaign: what each claim was answered, written down as it comes, so that a run can be gone on with.

A line is one answer, as JSON with a checksum, under a name in which is all that the answer depends on: the file's
content, the claim's number, the deciders and the settings. A line is appended in one piece; one that was cut short, or
was changed, is none. Nothing in a journal is ever unpickled or executed.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from canon.claims.certificate_path import certificate_path
from canon.claims.remembered import fingerprint
from canon.claims.worker import Entry, Settings
from canon.errors import InputError

Record = dict[str, Any]
LARGEST: Final = 1_000_000_000
"""The most bytes of a journal that are read."""
STATUSES: Final = ("proved", "refuted", "supported", "undecided")
DEEPEST: Final = 40
"""The most levels of tables in tables that a record has."""
LONGEST: Final = 4_000_000
"""The most bytes of a line."""
BEGINNING: Final = b'{"check": "'
"""How every line begins; where the disk was full, a part of the first one may be all that there is of a journal."""
DAMAGED: Final = 10_000
"""The most lines that may be damaged: of what has more, not every line is looked at."""


@dataclass
class Journal:
    """The file at `path`, and the state of the deciders and the settings (`words`).

    `fault` says why nothing is written any more, where that is so; `others`, how many of the answers that were read
    are of another state of the deciders, or were given with other options; `certificates`, the folder in which a
    certificate of each proof and refutation has to be.
    """

    path: Path
    words: str
    fault: str = ""
    others: int = 0
    certificates: str | None = None

    def name(self, entry: Entry) -> str:
        """What a claim's answer is called: by what its file said when it was read, whatever it says now."""
        said = f"{self.words}\0{entry.digest or entry.path}"
        return f"{hashlib.sha256(said.encode('utf-8', 'surrogatepass')).hexdigest()[:32]} {entry.index}"

    @property
    def by(self) -> str:
        """A name for what answers: the deciders and the settings."""
        return hashlib.sha256(self.words.encode("utf-8", "surrogatepass")).hexdigest()[:16]


def journal(path: str | os.PathLike[str], settings: Settings) -> Journal:
    """The journal at `path`, which is made where there is none. **Raises:** `InputError` where that can't be done."""
    words = f"{fingerprint()} {settings!r}"
    try:
        with open(os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NONBLOCK", 0), 0o666), "rb") as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise InputError("a journal is a regular file", f"--resume {path}")
            if status.st_size > LARGEST:
                reason = f"this journal has {status.st_size} bytes: at most {LARGEST} are read"
                raise InputError(reason, f"--resume {path}")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"can't be used as a journal: {reason}", f"--resume {path}") from None
    return Journal(Path(path), words, certificates=settings.certificates)


def answered(kept: Journal, entries: Sequence[Entry]) -> dict[int, Record]:
    """The answers that are written down, by position in `entries`. **Raises:** `InputError` if it is no journal."""
    places: dict[str, list[int]] = {}
    for position, entry in enumerate(entries):
        places.setdefault(kept.name(entry), []).append(position)
    found: dict[int, Record] = {}
    lines = sound = begun = 0
    for line in _lines(kept.path):
        lines += 1
        if (body := _body(line)) is None:
            begun += line.startswith(BEGINNING[: len(line)]) and not line.endswith(b"\n")
            if lines - sound > DAMAGED:
                raise InputError(f"more than {DAMAGED} lines of this journal are damaged", f"--resume {kept.path}")
            continue
        sound += 1
        if body["name"] not in places:
            kept.others += body.get("by") != kept.by
        for position in places.get(body["name"], ()):
            entry, kind = entries[position], body["kind"]
            record = {**body["record"], "file": entry.file}
            if fits(kind, record, entry) and _is_whole(kept, record, entry):
                found[position] = {kind: record}
    if lines and not (sound or begun):
        raise InputError("this file is no journal of `canon verify --resume`", f"--resume {kept.path}")
    return found


def _lines(path: Path) -> Iterator[bytes]:
    """The lines of a file. **Raises:** `InputError` where they can't be read."""
    try:
        with open(path, "rb", opener=lambda name, flags: os.open(name, flags | getattr(os, "O_NONBLOCK", 0))) as file:
            while line := file.readline(LONGEST):
                yield line
    except OSError as error:
        raise InputError(f"can't be read: {error.strerror or error}", f"--resume {path}") from None


def fits(kind: str, record: Record, entry: Entry) -> bool:
    """Whether a record can be the answer about a claim: it is of that claim, and has all that a report looks at."""
    if kind == "error":
        return all(isinstance(record.get(word), str) for word in ("where", "message"))
    claim, verdict = entry.claim, record.get("verdict")
    return (
        claim is not None
        and verdict in STATUSES
        and "title" in record  # which may be None, as what isn't there is
        and (record.get("index"), record.get("kind"), record.get("title")) == (entry.index, claim.kind, claim.title)
        and isinstance(record.get("expected"), bool)
        and (claim.is_met_by(verdict) or not record["expected"])
        and isinstance(record.get("method"), str)
        and isinstance(record.get("detail"), dict)
        and isinstance(record.get("seconds"), (int, float))
        and 0 <= record["seconds"] < 1e9  # nan is not
        and all(record.get(word, 0) is None or isinstance(record.get(word), dict) for word in ("numeric", "witness"))
        and (record["numeric"] is None or _is_evidence(record["numeric"]))
        and _levels(record) <= DEEPEST
        and (record.get("certificate", 0) is None or isinstance(record.get("certificate"), str))
        and isinstance(record["detail"].get("certificate_error", ""), str)
        and all(isinstance(name, str) for name in _listed(record.get("matters")))
    )


def _listed(names: Any) -> list[Any]:
    """The names on which a refutation depends, where they are stated; of what is no list, one that is no name."""
    return [] if names is None else names if isinstance(names, list) else [None]


def _is_whole(kept: Journal, record: Record, entry: Entry) -> bool:
    """Whether the certificate that goes with an answer is there, where one is asked for: under this claim's name."""
    if kept.certificates is None or record.get("verdict") not in ("proved", "refuted"):
        return True
    path = certificate_path(kept.certificates, entry)
    return record["certificate"] == str(path) and path.is_file() and path.stat().st_size > 0


def _is_evidence(numeric: Record) -> bool:
    return isinstance(numeric.get("points"), int) and all(
        isinstance(numeric.get(word), (int, float, str)) for word in ("max_residual", "bound")
    )


def _levels(data: Any) -> int:
    """How deep data are nested; no more than is asked for is found out."""
    level, here = 0, [data]
    while here and level <= DEEPEST:
        level += 1
        inner = (d.values() if isinstance(d, dict) else d for d in here if isinstance(d, (dict, list)))
        here = [item for items in inner for item in items]
    return level


def write(kept: Journal, entry: Entry, answer: Record) -> None:
    """Append an answer. Where that fails, `fault` says why, and nothing further is written."""
    if kept.fault:
        return
    kind = "claim" if "claim" in answer else "error"
    body = {"name": kept.name(entry), "kind": kind, "record": answer[kind], "by": kept.by}
    line = json.dumps({"check": _checksum(body), "body": body}).encode()
    try:
        handle = os.open(kept.path, os.O_RDWR | os.O_APPEND)
        try:
            end = os.fstat(handle).st_size
            cut = end > 0 and os.pread(handle, 1, end - 1) != b"\n"  # a line that an earlier run didn't finish
            data = b"\n" * cut + line + b"\n"
            if os.write(handle, data) < len(data):
                raise OSError(0, "no space was left in the middle of a line")
        finally:
            os.close(handle)
    except OSError as error:
        kept.fault = error.strerror or str(error)


def _body(line: bytes) -> Record | None:
    """What a line says; None where it is cut short or changed."""
    try:
        whole = json.loads(line)
        body = whole["body"]
        sound = whole["check"] == _checksum(body) and body["kind"] in ("claim", "error")
        return body if sound and isinstance(body["name"], str) and isinstance(body["record"], dict) else None
    except (ValueError, KeyError, TypeError, RecursionError):
        return None


def _checksum(body: Any) -> str:
    return hashlib.sha256(json.dumps(body, sort_keys=True).encode()).hexdigest()[:32]
