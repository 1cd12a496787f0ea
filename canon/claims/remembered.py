"""Verdicts of the catalogue that are remembered: by the content of a file, of the deciders, and of the settings.

An entry holds what a file's claims were answered, as JSON with a checksum. It is written whole or not at all, never
unpickled, and ignored when it is damaged. Whatever may change an answer is in its name: the file, every module of the
package, the versions of what computes, the seed, budget and method. What stayed undecided is asked again.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import platform
import re
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

from canon.claim import Claim
from canon.claims import document
from canon.claims.folders import make_folder
from canon.claims.worker import Entry, Settings
from canon.errors import InputError

Record = dict[str, Any]
FORMAT: Final = 2
LARGEST: Final = 4_000_000
KEPT: Final = 3
"""So many states of the deciders have their verdicts kept."""
_STATE: Final = re.compile("[0-9a-f]{32}")
"""How the folder of a state is called."""


@dataclass(frozen=True)
class Memory:
    """Where the verdicts of one state of the deciders are kept, and what they depend on besides the file."""

    folder: Path
    settings: str

    def entry(self, digest: str) -> Path:
        """The place of the verdicts about a file that says this."""
        return self.folder / (hashlib.sha256(f"{self.settings}\0{digest}".encode()).hexdigest() + ".json")

    def name(self, digest: str) -> str:
        """What the verdicts about such a file are called within the entry, too: one that lies in another's place is
        none."""
        return f"{self.folder.name}/{self.entry(digest).stem}"


def memory(settings: Settings) -> Memory | None:
    """The memory of this state of the deciders; None where there is no folder for it, or more is asked for."""
    root = cache_folder()
    if root is None or settings.certificates is not None or settings.proof is not None:
        return None
    words = f"{settings.budget!r} {settings.seed} {settings.method} {settings.accuracy!r}"
    return Memory(root / "verdicts" / fingerprint(), words)


def cache_folder() -> Path | None:
    """The user's folder for caches of this program; None where there is no home."""
    given = os.environ.get("XDG_CACHE_HOME", "")
    if given and os.path.isabs(given):
        return Path(given) / "canon"
    with contextlib.suppress(RuntimeError):
        return Path.home() / ".cache" / "canon"
    return None


def fingerprint() -> str:
    """A name for the state of the deciders: every module of the package, and the versions of what they compute with."""
    package = Path(__file__).resolve().parents[1]
    digest = hashlib.sha256(f"{FORMAT} {platform.python_version()} {platform.machine()}".encode())
    for name in ("sympy", "python-flint", "mpmath", "numpy"):
        with contextlib.suppress(Exception):
            digest.update(f"{name} {version(name)}".encode())
    for path in sorted(package.rglob("*.py")):
        digest.update(str(path.relative_to(package)).encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:32]


def recall(kept: Memory, path: str | os.PathLike[str], name: str) -> tuple[list[Claim], list[Record]] | None:
    """The claims of a file, by what a report needs of them, and their records; None where they aren't remembered."""
    from canon.claims.journal import fits  # which names its answers by the same fingerprint

    try:
        digest = document.digest(document.content(path))
        data = _content(kept.entry(digest))
        if data is None:
            return None
        whole = json.loads(data)
        body = whole["body"]
        if whole["checksum"] != _checksum(body) or (body["format"], body["name"]) != (FORMAT, kept.name(digest)):
            return None
        claims = [
            Claim(c["kind"], None, title=c["title"], source=c["source"], expect=c["expect"], index=c["index"])
            for c in body["claims"]
        ]
        records = [{**record, "file": name} for record in body["records"]]
        sound = len(claims) == len(records) and all(
            all(
                value is None or isinstance(value, str)
                for value in (claim.kind, claim.title, claim.source, claim.expect)
            )
            and fits("claim", record, Entry(name, claim.index, claim))
            for claim, record in zip(claims, records, strict=True)
        )
    except (InputError, OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return (claims, records) if sound else None


def _content(place: Path) -> bytes | None:
    """What is in an entry, for which nobody waits; None where that is too large."""
    with open(os.open(place, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)), "rb") as file:
        data = file.read(LARGEST + 1)
    return data if len(data) <= LARGEST else None


def remember(kept: Memory, digest: str, claims: Sequence[Claim], records: Sequence[Record]) -> None:
    """Keep what the claims of a file that said this (`digest`) were answered, where all of them were and it can be
    written; else nothing happens."""
    if len(records) != len(claims) or any(record["verdict"] == "undecided" for record in records):
        return
    shown = [
        {"kind": c.kind, "title": c.title, "source": c.source, "expect": c.expect, "index": c.index} for c in claims
    ]
    body = {"format": FORMAT, "name": kept.name(digest), "claims": shown, "records": list(records)}
    text = json.dumps({"checksum": _checksum(body), "body": body}, allow_nan=False)
    with contextlib.suppress(OSError, ValueError):
        place = kept.entry(digest)
        make_folder(kept.folder)
        handle, name = tempfile.mkstemp(dir=kept.folder, prefix=".new-")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(text)
            os.replace(name, place)
        except OSError:
            with contextlib.suppress(OSError):
                os.unlink(name)


def forget_the_oldest(kept: Memory) -> None:
    """Remove the verdicts of all but the last few states of the deciders."""
    with contextlib.suppress(OSError):
        states = [state for state in kept.folder.parent.iterdir() if _is_ours(state) and state != kept.folder]
        for folder in sorted(states, key=lambda state: state.stat().st_mtime, reverse=True)[KEPT - 1 :]:
            with contextlib.suppress(OSError):  # what isn't ours stays, and its folder with it
                for file in folder.iterdir():
                    if file.suffix == ".json" or file.name.startswith(".new-"):
                        file.unlink()
                folder.rmdir()


def _is_ours(folder: Path) -> bool:
    """Whether a folder is one of those that are made here: not a link to another one."""
    return _STATE.fullmatch(folder.name) is not None and folder.is_dir() and not folder.is_symlink()


def _checksum(body: Any) -> str:
    return hashlib.sha256(json.dumps(body, sort_keys=True).encode()).hexdigest()
