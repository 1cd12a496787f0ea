"""Files that are there as a whole or not at all: written to a neighbour first, and put in place when they are whole."""

from __future__ import annotations

import contextlib
import io
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any


def atomically(path: str | os.PathLike[str], write: Callable[[IO[bytes]], object]) -> None:
    """Let `write` write a file; what was at `path` before stays where it can't. A link stays one.

    **Raises:** `OSError`, as where the disk is full.
    """
    target = Path(os.path.realpath(path))
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name[:100]}.", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            write(file)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(name, 0o666 & ~umask)
        os.replace(name, target)
    except BaseException:
        with contextlib.suppress(OSError):  # it may be in its place already
            os.unlink(name)
        raise


def written(path: str | os.PathLike[str], text: str) -> None:
    """Write a text, in UTF-8, as a whole. **Raises:** `OSError`."""
    atomically(path, lambda file: file.write(text.encode("utf-8")))


def figure_written(path: str | os.PathLike[str], figure: Any) -> None:
    """Write matplotlib's figure as a whole, in the format that the ending of its name says. **Raises:** `OSError`.

    It is drawn in memory first: where the disk is full in the middle of a PDF, its compressor has an error of its own.
    """
    ending = os.path.splitext(path)[1].removeprefix(".").lower()
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=150, format=ending)
    atomically(path, lambda file: file.write(drawn.getbuffer()))
