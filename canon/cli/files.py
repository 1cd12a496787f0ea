"""From the arguments of a command to the claim files that are meant."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Final

ADVISED: Final = 10
"""Of so many names that are no file's it is said which one may be meant."""
COMPARED: Final = 2_000
"""With so many files of its folder such a name is compared: ten times that takes half a second."""


@dataclass(frozen=True)
class ClaimFile:
    """A file to be read, and the name by which it is shown."""

    name: str
    path: Path


@dataclass(frozen=True)
class Missing:
    """Something that was asked for and holds no claim file, with the reason."""

    name: str
    message: str


def claim_files(names: Iterable[str]) -> tuple[list[ClaimFile], list[Missing]]:
    """Return the files named, and every `*.toml` below the folders named, each folder in alphabetical order.

    A file that is reached more than once, by whatever path, is taken once, by its first name.
    """
    found: list[ClaimFile] = []
    missing: list[Missing] = []
    absent = 0
    for name in names:
        if "\0" in name:
            missing.append(Missing(name, "no file's name has the character NUL in it"))
        elif os.path.isdir(name):
            below, unreadable = _below(name)
            if not below and not unreadable:
                missing.append(Missing(name, "no claim file (*.toml) in this folder or below it"))
            found += below
            missing += unreadable
        elif os.path.lexists(name) or _refused(name):
            found.append(ClaimFile(name, Path(name)))
        else:
            absent += 1
            missing.append(Missing(name, f"no such file or folder{_nearest(name) if absent <= ADVISED else ''}"))
    return _once(found), list(dict.fromkeys(missing))


def same_file(path: str, others: Iterable[str | None]) -> bool:
    """Whether a file that is to be written is one of the others, which are read or written, too, by whatever name."""
    return any(other is not None and os.path.realpath(path) == os.path.realpath(other) for other in others)


def is_protected(path: str) -> bool:
    """Whether there is such a file that may not be written, though its folder may: it could be replaced by another."""
    return os.path.exists(path) and not os.access(path, os.W_OK)


def _refused(name: str) -> bool:
    """Whether something is in the way of even looking: the reader says what."""
    try:
        os.stat(name)
    except (FileNotFoundError, NotADirectoryError):
        return False
    except (OSError, ValueError):
        return True
    return True


def _once(files: list[ClaimFile]) -> list[ClaimFile]:
    first: dict[str, ClaimFile] = {}
    for file in files:
        first.setdefault(os.path.realpath(file.path), file)
    return list(first.values())


def _below(folder: str) -> tuple[list[ClaimFile], list[Missing]]:
    """Return the claim files below a folder, and the folders that could not be read. Links to folders are left out."""
    missing: list[Missing] = []

    def unreadable(error: OSError) -> None:
        missing.append(Missing(str(error.filename), f"this folder can't be read: {error.strerror}"))

    found = [ClaimFile(path, Path(path)) for path in files_below(folder, ".toml", unreadable)]
    return found, missing


def files_below(folder: str, ending: str, unreadable: Callable[[OSError], object]) -> Iterator[str]:
    """The files below a folder whose names end so, each folder's in alphabetical order before those of the folders in
    it; links to folders are left out. Folders that can't be read are told to `unreadable`.

    However deep folders lie in folders: `os.walk` of Python 3.11 calls itself for each.
    """
    waiting = [folder]
    while waiting:
        parent = waiting.pop()
        try:
            with os.scandir(parent) as entries:
                inside = sorted(entries, key=lambda entry: entry.name)
        except OSError as error:
            error.filename = parent
            unreadable(error)
            continue
        yield from (entry.path for entry in inside if entry.name.endswith(ending) and not _is_folder(entry, True))
        waiting += [entry.path for entry in reversed(inside) if _is_folder(entry, False)]


def _is_folder(entry: os.DirEntry[str], through_links: bool) -> bool:
    try:
        return entry.is_dir(follow_symlinks=through_links)
    except OSError:
        return False


def _nearest(name: str) -> str:
    """Return a hint at the file of the same folder whose name is nearest, if there is one."""
    from difflib import get_close_matches

    parent, base = os.path.split(name)
    try:
        with os.scandir(parent or os.curdir) as entries:
            others = sorted(entry.name for entry in islice(entries, COMPARED))
    except (OSError, ValueError):
        return ""
    near = get_close_matches(base, others, n=1, cutoff=0.7)
    return f"; is {os.path.join(parent, near[0])!r} meant?" if near else ""
