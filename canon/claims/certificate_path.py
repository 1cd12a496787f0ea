"""What the file of a claim's certificate is called."""

from __future__ import annotations

import hashlib
import os
import re
from pathlib import Path
from typing import Final

from canon.claims.worker import Entry

PLAIN: Final = re.compile(r"(?:[\w][\w .-]*/)*[\w][\w .-]*")
LONGEST: Final = 400
"""Characters of a name that is kept: the folders of a longer one would be too many, or their names too long."""
WIDEST: Final = 200
"""Bytes of its last word: with a number and `.json` behind it, it has to be the name of a file still."""


def certificate_path(folder: str, entry: Entry) -> Path:
    """Where a claim's certificate goes: as its file is called, with the claim's number, below `folder`.

    Of a file that isn't named by plain words below the working folder, or by many, the last word, and a hash of the
    whole name.
    """
    name = entry.file.removesuffix(".toml")
    if (
        len(name) > LONGEST
        or len(os.path.basename(name).encode("utf-8", "surrogateescape")) > WIDEST
        or not PLAIN.fullmatch(name)
        or ".." in name.split("/")
    ):
        mark = hashlib.sha256(entry.file.encode("utf-8", "surrogateescape")).hexdigest()[:8]
        name = f"{re.sub(r'[^A-Za-z0-9_.-]', '-', os.path.basename(name))[:80].lstrip('.')}-{mark}"
    return Path(folder) / f"{name}.{entry.index + 1}.json"
