"""How far a regularised run has come, as figures and arrays: enough to go on from, bit for bit, in another process.

Of the runs that are finished it is the states at the scene's times; of the one that was interrupted also what its steps
go on from, in the fictitious time. Its programs, and whatever follows from the scene, are made anew.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.engines import ENGINES, Settled
from canon.numeric.integrate import Run
from canon.numeric.progress import DAMAGED, Trial, engine_of, leaves, with_leaves
from canon.numeric.regularised_orbit import MOST_KEPT
from canon.scenes.identity import check_same
from canon.scenes.saved import FORMAT, KEY, Arrays, header_of, versions

FINISHED: Final = 2
"""Runs whose states are kept."""
LONGEST: Final = 64 * MOST_KEPT
"""States that an interrupted run may have kept, at most."""


@dataclass(frozen=True)
class Halfway:
    """The last finished `runs`, all `trials`, the step of the run that is next or under way, and that run in the
    fictitious time, if it has begun. `over`: no further run will be made. One `engine` makes all of them.
    """

    engine: Settled
    step: float
    runs: tuple[Run, ...] = ()
    trials: tuple[Trial, ...] = ()
    current: Run | None = None
    over: bool = False


def kept(halfway: Halfway, shown: Run, identity: dict[str, Any]) -> dict[str, np.ndarray]:
    """The arrays of a run that is not finished: the states that are `shown`, and what it can be gone on with."""
    q, p = shown.states
    return {"times": shown.times[: shown.completed], "q": q, "p": p, **resumable(halfway, identity)}


def resumable(halfway: Halfway, identity: dict[str, Any]) -> dict[str, np.ndarray]:
    """What it can be gone on with: a line of JSON, and the arrays that it speaks of."""
    arrays: dict[str, np.ndarray] = {}
    for index, run in enumerate(halfway.runs):
        arrays |= {_name(index, k): np.asarray(slot)[: run.completed] for k, slot in enumerate(run.stored)}
    current = halfway.current
    if current is not None:
        arrays |= {_name("current", k): leaf for k, leaf in enumerate(leaves(current))}
    figures = {
        "regularised": {
            "step": halfway.step.hex(),
            "runs": [{"steps": run.steps, "ended": run.ended, "engine": run.engine} for run in halfway.runs],
            "current": None if current is None else {"done": current.done, "ended": current.ended},
            "trials": [[trial.steps, trial.difference.hex(), trial.seconds] for trial in halfway.trials],
            "over": halfway.over,
        },
        "engine": halfway.engine,
    }
    header = {"format": FORMAT, "versions": versions(halfway.engine), "identity": identity, **figures}
    return {KEY: np.array(json.dumps(header)), **arrays}


def restored(arrays: Arrays, identity: dict[str, Any], blank: Run, begin: Any) -> Halfway:
    """What was saved. `blank` is a run of the scene without states, and `begin` makes, of a step, the run in the
    fictitious time before its first one.

    **Raises:** `InputError` where it is damaged, of another scene, or of an engine that is not installed.
    """
    header = header_of(arrays)
    check_same(header.get("identity"), identity)
    engine = engine_of(header)
    try:
        return _restored(header["regularised"], arrays, engine, blank, begin)
    except (LookupError, TypeError, ValueError, OverflowError, AttributeError) as error:
        raise InputError(DAMAGED) from error


def _restored(figures: Mapping[str, Any], arrays: Arrays, engine: Settled, blank: Run, begin: Any) -> Halfway:
    trials = tuple(Trial(int(n), float.fromhex(off), float(spent)) for n, off, spent in figures["trials"])
    runs = tuple(_finished(index, entry, arrays, blank) for index, entry in enumerate(figures["runs"]))
    step, entry, over = float.fromhex(figures["step"]), figures["current"], figures["over"]
    sound = (
        0 < step < math.inf
        and len(runs) == min(len(trials), FINISHED)
        and over in (True, False)
        and all(trial.steps > 0 and math.isfinite(trial.seconds) and trial.difference >= 0 for trial in trials)
        and not (over and (entry is not None or not runs))
    )
    if not sound:
        raise InputError(DAMAGED)
    current = None if entry is None else _current(entry, arrays, begin(step), engine)
    return Halfway(engine, step, runs, trials, current, over)


def _finished(index: int, entry: Mapping[str, Any], arrays: Arrays, blank: Run) -> Run:
    found = tuple(arrays[_name(index, k)] for k in range(2))
    good, steps = len(found[0]), int(entry["steps"])
    shape = (good, np.shape(blank.stored[0])[1])
    if not 1 <= good <= blank.samples or steps < 1 or any(x.shape != shape or x.dtype != float for x in found):
        raise InputError(DAMAGED)
    if entry["ended"] is not (good < blank.samples) or entry["engine"] not in ENGINES:
        raise InputError(DAMAGED)
    rows = tuple(np.concatenate([x, np.full((blank.samples - good, shape[1]), np.nan)]) for x in found)
    mean = blank.duration / steps
    return replace(
        blank, step=mean, done=good - 1, stored=rows, ended=good < blank.samples, taken=steps, engine=entry["engine"]
    )


def _current(entry: Mapping[str, Any], arrays: Arrays, fresh: Run, engine: Settled) -> Run:
    """The run under way: as it would begin, but for its arrays, with as many states as these have."""
    begun, states = leaves(fresh), len(fresh.stored)
    found = [arrays[_name("current", k)] for k in range(len(begun))]
    rows, done = len(found[-1]), int(entry["done"])
    shapes = [x.shape for x in begun[:-states]] + [(rows, *x.shape[1:]) for x in begun[-states:]]
    sound = (
        fresh.samples <= rows <= max(LONGEST, fresh.samples)
        and 0 <= done <= rows - 1
        and entry["ended"] in (True, False)
        and all(x.shape == shape and x.dtype == old.dtype for x, shape, old in zip(found, shapes, begun, strict=True))
    )
    if not sound:
        raise InputError(DAMAGED)
    run = with_leaves(fresh, found)
    duration = fresh.duration * (rows - 1) / (fresh.samples - 1)
    return replace(run, samples=rows, duration=duration, done=done, ended=entry["ended"], engine=engine)


def _name(run: int | str, leaf: int) -> str:
    return f"resume_{run}_{leaf}"
