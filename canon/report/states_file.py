"""The stored states of a run as a file of arrays, and such a file read again, which is not trusted."""

from __future__ import annotations

import math
import os
import zipfile
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from canon.errors import InputError
from canon.report.whole_file import atomically
from canon.scenes.simulate import Result
from canon.scenes.states import named_states, own_states


def write_states(result: Result, path: str | os.PathLike[str]) -> None:
    """Write times, q and p (samples, n), what bodies do by name, and what the run can be gone on with."""
    arrays: dict[str, Any] = {"times": result.times, "q": result.q, "p": result.p, **own_states(result)}
    for word, table in named_states(result).items():
        arrays |= {f"{word}_{name}": rows for name, rows in table.items()}
    write_arrays({**arrays, **result.resumable}, path)


def write_arrays(arrays: Mapping[str, np.ndarray], path: str | os.PathLike[str]) -> None:
    """Write arrays as an npz file."""
    atomically(path, lambda file: np.savez(file, **arrays))  # pyright: ignore[reportArgumentType]


def read_arrays(path: str | os.PathLike[str]) -> dict[str, np.ndarray]:
    """The arrays of an npz file. No object is ever made from it: it holds numbers and text alone.

    **Raises:** `InputError` where there is no such file, or it is no sound npz file.
    """
    if os.path.lexists(path) and not os.path.isfile(path):
        raise InputError("it is not a regular file")
    try:
        size = os.stat(path).st_size
        if size > _memory():
            raise InputError(f"it has {size} bytes, more than the memory of this machine")
        with zipfile.ZipFile(path) as archive:
            found: dict[str, np.ndarray] = {}
            if sum(member.file_size for member in archive.infolist()) > size:
                raise ValueError("members that share their bytes")
            for member in archive.infolist():
                if member.compress_type != zipfile.ZIP_STORED or not member.filename.endswith(".npy"):
                    raise InputError("it is not a file that `canon simulate --out` wrote")
                with archive.open(member) as file:
                    found[member.filename[:-4]] = np.lib.format.read_array(file, allow_pickle=False)
                    if file.read(1):
                        raise ValueError("more than an array")
        return found
    except FileNotFoundError:
        raise InputError("there is no such file") from None
    except (zipfile.BadZipFile, zlib.error, ValueError, KeyError, EOFError, NotImplementedError, MemoryError,
            OverflowError, SyntaxError, RuntimeError) as error:  # fmt: skip
        raise InputError("it is damaged, or no file that `canon simulate --out` wrote") from error
    except OSError as error:
        raise InputError(f"it can't be read: {error.strerror or error}") from None


def _memory() -> float:
    """The bytes of this machine's memory; infinity where they aren't told."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return math.inf
