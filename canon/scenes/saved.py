"""A run as arrays that can be kept on disk and gone on with, nothing in them but numbers and one line of JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.engines import Engine
from canon.numeric.progress import Begin, Packed, Progress, engine_of, pack, unpack
from canon.scenes.identity import check_same
from canon.version import __version__

FORMAT: Final = 1
KEY: Final = "resume"
Arrays = Mapping[str, np.ndarray]


def saved(progress: Progress, identity: dict[str, Any]) -> dict[str, np.ndarray]:
    """The arrays of a run that is not finished: its states until now, and what it can be gone on with."""
    run = progress.shown
    q, p = (np.asarray(slot) for slot in run.states[:2])
    return {"times": run.times[: run.completed], "q": q, "p": p, **resumable(progress, identity)}


def resumable(progress: Progress, identity: dict[str, Any]) -> dict[str, np.ndarray]:
    """What a run can be gone on with: a line of JSON under `KEY`, and the arrays that it speaks of."""
    packed = pack(progress)
    header = {"format": FORMAT, "versions": versions(progress.engine), "identity": identity, **packed.figures}
    return {KEY: np.array(json.dumps(header)), **packed.arrays}


def restored(arrays: Arrays, identity: dict[str, Any], begin: Begin) -> Progress:
    """The progress that was saved. **Raises:** `InputError` where it is damaged, or of another scene."""
    header = header_of(arrays)
    check_same(header.get("identity"), identity)
    return unpack(Packed(header, arrays), begin)


def integrator_of(arrays: Arrays) -> str | None:
    """The name of the integrator that a run was begun with, where it says so."""
    identity = header_of(arrays).get("identity")
    name = identity.get("integrator") if isinstance(identity, dict) else None
    return name if isinstance(name, str) else None


def engine_for(arrays: Arrays, wanted: Engine) -> Engine:
    """The engine that a run was begun with. **Raises:** `InputError` where another is wanted, or it's not installed."""
    begun = engine_of(header_of(arrays))
    if wanted not in ("auto", begun):
        raise InputError(f"it was begun with the engine {begun}, and this is the engine {wanted}: leave --engine out")
    return begun


def differing_versions(arrays: Arrays) -> str:
    """The versions that a run was begun with, where they are others than today's; nothing where they are the same."""
    header = header_of(arrays)
    then, now = header.get("versions"), versions(engine_of(header))
    if not isinstance(then, dict) or then == now:
        return ""
    return ", ".join(f"{name} {str(then.get(name))[:40]}" for name in now)


def versions(engine: str | None = None) -> dict[str, str]:
    """The programs on which every bit of a run by this engine depends."""
    names = ("jax", "jaxlib", "numpy", *(("llvmlite",) if engine == "native" else ()))
    return {"canon": __version__, **{name: _version(name) for name in names}}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:  # it is there, without what an installer writes about it
        return "unknown"


def header_of(arrays: Arrays) -> dict[str, Any]:
    """The line of JSON of a run. **Raises:** `InputError` where there is none, or of another format."""
    if KEY not in arrays:
        raise InputError("it holds states, but nothing to go on with: was it written by `canon simulate --out`?")
    try:
        header = json.loads(str(arrays[KEY][()]))
    except (ValueError, RecursionError) as error:
        raise InputError("what it holds of the run is damaged") from error
    if not isinstance(header, dict) or header.get("format") != FORMAT:
        raise InputError(f"it is not of format {FORMAT}, which this version of canon reads")
    return header
