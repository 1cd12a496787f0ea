"""Folders that are made to write into, however deep they lie."""

from __future__ import annotations

import os


def make_folder(path: str | os.PathLike[str]) -> None:
    """Make a folder, and those that it lies in, where they aren't there yet. Raises OSError.

    `os.makedirs` calls itself for each of them, and a thousand are too many for it. One whose name is too long for the
    system is refused before any other is made.
    """
    missing = [os.fspath(path)]
    while missing:
        try:
            os.mkdir(missing[-1])
        except FileNotFoundError:
            above = os.path.dirname(missing[-1].rstrip(os.sep))
            if not above or above == missing[-1]:
                raise
            missing.append(above)
            continue
        except OSError:
            if not os.path.isdir(missing[-1]):
                raise
        missing.pop()
