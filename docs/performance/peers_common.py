"""What the benchmarks against other packages share: the cheapest setting for an error, and fair clocks."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

ROUNDS = 9
LEAST = 0.02
"""Seconds of CPU time of one measurement, at least: shorter runs are repeated."""


@dataclass(frozen=True)
class Setting:
    """A way to solve a task: `run` returns the end positions."""

    label: str
    run: Callable[[], np.ndarray]


@dataclass(frozen=True)
class Side:
    """One package in one row: its setting, the CPU time of a run in seconds (a median), and the error."""

    label: str
    seconds: float
    error: float


@dataclass(frozen=True)
class Row:
    """A task at an accuracy: each package's side, None where it does not get there, and the ratios asked for."""

    task: str
    target: str
    sides: Mapping[str, Side | None]
    goals: Mapping[str, float]


def cpu(run: Callable[[], object], repeat: int = 1) -> float:
    """The CPU time of a run."""
    begun = time.process_time()
    for _ in range(repeat):
        run()
    return (time.process_time() - begun) / repeat


def cheapest(
    settings: Sequence[Setting], error: Callable[[np.ndarray], float], target: float
) -> tuple[Setting, float] | None:
    """The fastest of the settings that reach the target, each run twice; None where none does."""
    found: list[tuple[float, int, float]] = []
    for k, setting in enumerate(settings):
        reached = error(setting.run())
        if reached <= target:
            found.append((min(cpu(setting.run), cpu(setting.run)), k, reached))
    if not found:
        return None
    _, k, reached = min(found)
    return settings[k], reached


def compared(
    task: str, target: str, chosen: Mapping[str, tuple[Setting, float] | None], goals: Mapping[str, float]
) -> Row:
    """The medians of interleaved runs."""
    runs = {name: found[0].run for name, found in chosen.items() if found is not None}
    medians = interleaved(runs)
    sides = {
        name: None if found is None else Side(found[0].label, medians[name], found[1]) for name, found in chosen.items()
    }
    return Row(task, target, sides, goals)


def interleaved(runs: Mapping[str, Callable[[], object]], rounds: int = ROUNDS) -> dict[str, float]:
    """The median CPU time of each, in turns: what else the machine does slows all of them alike."""
    repeats = {name: max(int(LEAST / max(cpu(run), 1e-7)), 1) for name, run in runs.items()}
    times: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            times[name].append(cpu(run, repeats[name]))
    return {name: float(np.median(values)) for name, values in times.items()}
