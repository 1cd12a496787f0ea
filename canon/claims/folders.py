"""Folders that are made to write into, however deep they lie."""

from __future__ import annotations

import os
from errno import ENOENT


def make_folder(path: str | os.PathLike[str]) -> None:
    """Make a folder, and those that it lies in, where they aren't there yet. Raises OSError.

    `os.makedirs` calls itself for each of them, and a thousand are too many for it. One whose name is too long for the
    system is refused before any other is made.
    """
    missing = [os.fspath(path)]
    while not _made(missing[-1]):
        above = os.path.dirname(missing[-1].rstrip(os.sep))
        if not above or above == missing[-1]:
            raise _absent(missing[-1])
        missing.append(above)
    for folder in reversed(missing[:-1]):
        if not _made(folder):  # a file system in which nothing can be made, as /proc, says that it isn't there
            raise _absent(folder)


def _made(folder: str) -> bool:
    """Make a folder, if it isn't there; False where the one that it lies in isn't there. Raises OSError."""
    try:
        os.mkdir(folder)
    except FileNotFoundError:
        return False
    except OSError:
        if not os.path.isdir(folder):
            raise
    return True


def _absent(folder: str) -> FileNotFoundError:
    return FileNotFoundError(ENOENT, os.strerror(ENOENT), folder)
