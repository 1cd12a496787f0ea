"""The stored states of a run as a file: written to a neighbour first, and put in its place when it is whole."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import numpy as np

from canon.scenes.simulate import Result
from canon.scenes.states import named_states


def write_states(result: Result, path: str | os.PathLike[str]) -> None:
    """Write times, q and p (samples, n), and the bodies' positions and velocities, as an npz file."""
    arrays: dict[str, Any] = {"times": result.times, "q": result.q, "p": result.p}
    for word, table in named_states(result).items():
        arrays |= {f"{word}_{name}": rows for name, rows in table.items()}
    atomically(path, lambda file: np.savez(file, **arrays))


def atomically(path: str | os.PathLike[str], write: Callable[[IO[bytes]], None]) -> None:
    """Write a file so that it is there as a whole or not at all."""
    target = Path(path)
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            write(file)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(name, 0o666 & ~umask)
        os.replace(name, target)
    except BaseException:
        os.unlink(name)
        raise
