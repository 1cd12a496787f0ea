"""How far the search for a step has come, as figures and arrays: enough to go on from, bit for bit, in another process.

A run's programs are made anew from its problem; what is kept is what they work on: the carry of the integrator
(the state, and what its additions rounded away), the number of chunks that are done, and the stored states.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.numeric.engines import ENGINES, Settled, settled
from canon.numeric.integrate import Run

DAMAGED: Final = "what it holds of the run is damaged"

Begin = Callable[[int, bool], Run]
"""From a number of steps, and whether rounding is kept, to the run before its first step."""


@dataclass(frozen=True)
class Trial:
    """A run that was made: its number of steps, how far its states were from those of the one before, its CPU time."""

    steps: int
    difference: float
    seconds: float


@dataclass(frozen=True)
class Progress:
    """The last `runs` that are finished, the `current` one if there is one, and what was seen of all before it.

    `agreed` counts, for each run, the samples in which it agrees with the one before; `compensated` says whether
    rounding is to be kept from now on, None where that is left to the number of steps. `engine` computes all runs.
    """

    runs: tuple[Run, ...] = ()
    current: Run | None = None
    trials: tuple[Trial, ...] = ()
    agreed: tuple[int, ...] = ()
    compensated: bool | None = None
    engine: Settled | None = None

    @property
    def shown(self) -> Run:
        """The run to be shown: the last finished one, unless the current one has come further."""
        if self.current is None or (self.runs and self.current.completed <= self.runs[-1].completed):
            return self.runs[-1]
        return self.current


@dataclass(frozen=True)
class Packed:
    """A progress as `figures` that JSON can hold, and `arrays` by name."""

    figures: Mapping[str, Any]
    arrays: Mapping[str, np.ndarray]


def leaves(run: Run) -> list[np.ndarray]:
    """What a run goes on from, and after that its stored states, as arrays."""
    import jax

    return [np.asarray(leaf) for leaf in jax.tree.leaves((run.carry, run.stored))]


def with_leaves(run: Run, found: Sequence[np.ndarray]) -> Run:
    """The run with these arrays in place of its own."""
    import jax

    carry, stored = jax.tree.unflatten(jax.tree.structure((run.carry, run.stored)), found)
    return replace(run, carry=carry, stored=stored)


def pack(progress: Progress) -> Packed:
    """The progress without its problem."""
    import jax

    runs = [*progress.runs, *((progress.current,) if progress.current is not None else ())]
    arrays: dict[str, np.ndarray] = {}
    for index, run in enumerate(runs):
        for word, tree in (("carry", run.carry), ("stored", run.stored)):
            arrays |= {_name(index, word, k): np.asarray(leaf) for k, leaf in enumerate(jax.tree.leaves(tree))}
    figures = {
        "runs": [
            {
                "steps": run.total,
                "compensated": run.compensated,
                "done": run.done,
                "ended": run.ended,
                "engine": run.engine,
            }
            for run in runs
        ],
        "finished": len(progress.runs),
        "trials": [[trial.steps, trial.difference.hex(), trial.seconds] for trial in progress.trials],
        "agreed": list(progress.agreed),
        "compensated": progress.compensated,
        "engine": progress.engine,
    }
    return Packed(figures, arrays)


def unpack(packed: Packed, begin: Begin) -> Progress:
    """The progress of the problem whose runs `begin` makes.

    **Raises:** `InputError` where the figures or arrays are no progress of that problem, or were computed by an engine
    that is not installed.
    """
    engine_of(packed.figures)
    try:
        return _unpacked(packed, begin)
    except (LookupError, TypeError, ValueError, OverflowError, AttributeError) as error:
        raise InputError(DAMAGED) from error


def engine_of(figures: Mapping[str, Any]) -> Settled:
    """The engine that computed the runs of a progress; those of before there were two are XLA's.

    **Raises:** `InputError` where it isn't installed: another one's bits would be others.
    """
    engine = figures.get("engine") or "xla"
    if engine not in ("native", "xla"):
        raise InputError(DAMAGED)
    try:
        return settled(engine)
    except InputError as error:
        raise InputError(f"it was begun with the native engine, whose bits XLA's are not: {error.message}") from None


def _unpacked(packed: Packed, begin: Begin) -> Progress:
    figures = packed.figures
    runs = [_run(index, entry, packed.arrays, begin) for index, entry in enumerate(figures["runs"])]
    finished = figures["finished"]
    trials = tuple(Trial(int(n), float.fromhex(off), float(spent)) for n, off, spent in figures["trials"])
    agreed = tuple(map(int, figures["agreed"]))
    kept = figures["compensated"]
    sound = (
        finished in (len(runs), len(runs) - 1)
        and 0 <= finished <= len(trials) == len(agreed)
        and (finished > 0) == (len(trials) > 0)
        and kept in (None, True, False)
        and all(run.ended or run.done == run.chunks for run in runs[:finished])
        and all(trial.steps > 0 and math.isfinite(trial.seconds) for trial in trials)
    )
    if not sound:
        raise InputError(DAMAGED)
    return Progress(
        tuple(runs[:finished]), runs[-1] if finished < len(runs) else None, trials, agreed, kept, engine_of(figures)
    )


def _run(index: int, entry: Mapping[str, Any], arrays: Mapping[str, np.ndarray], begin: Begin) -> Run:
    import jax

    if (
        entry["compensated"] not in (True, False)
        or entry["ended"] not in (True, False)
        or entry.get("engine", "xla") not in ENGINES
    ):
        raise InputError(DAMAGED)
    run = begin(int(entry["steps"]), entry["compensated"])
    done = int(entry["done"])
    if not 0 <= done <= run.chunks or run.total != entry["steps"]:
        raise InputError(DAMAGED)
    restored = {}
    for word, tree in (("carry", run.carry), ("stored", run.stored)):
        leaves, structure = jax.tree.flatten(tree)
        found = [arrays[_name(index, word, k)] for k in range(len(leaves))]
        if any(a.shape != np.shape(b) or a.dtype != np.asarray(b).dtype for a, b in zip(found, leaves, strict=True)):
            raise InputError(DAMAGED)
        restored[word] = jax.tree.unflatten(structure, found)
    return replace(run, done=done, ended=entry["ended"], engine=entry.get("engine", "xla"), **restored)


def _name(index: int, word: str, leaf: int) -> str:
    return f"resume_{index}_{word}_{leaf}"
