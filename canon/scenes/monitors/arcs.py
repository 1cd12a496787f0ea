"""Monitors of the flow in a scene with strings: between two events the motion is that of its taut strings as rods.

There it has a derivative, carries loops along and can be undone, as any flow on a constraint surface. A string that
becomes taut takes away a velocity, a whole one of the degrees of freedom: no invariant goes through that, and no way
leads back. So each arc is looked at by itself, and the events are what breaks the invariants of the whole run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from canon.numeric.integrators.strings import LOGGED
from canon.numeric.observe import observe
from canon.scenes.model import Model
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading
from canon.scenes.problem import constrained_problem

STRING: Final = "string"
MOST: Final = 4
"""Arcs that are looked at, the longest ones: each is compiled anew."""
TAUT: Final = 1e-9
"""By so much of its squared length a taut string may be off it."""


class Arc(NamedTuple):
    """The motion between two events, from the stored state `first` to the stored state `last`."""

    flow: Flow
    first: int
    last: int


def read_arcs(read: Callable[..., Reading], flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """The reading of the arc that drifts most beside what it may; of the whole run where no string has an event."""
    happened = 0 if flow.events is None else int(flow.events.count)
    arcs = list(_arcs(flow, times, q, p))
    if not arcs:
        note = "a string goes slack or taut between any two stored states: ask for more samples"
        return Reading("", f"broken by {STRING}", None, None, None, extra={"note": note})
    rows = [slice(arc.first, arc.last + 1) for arc in arcs]
    found = [read(arc.flow, times[row], q[row], p[row]) for arc, row in zip(arcs, rows, strict=True)]
    worst = max(range(len(found)), key=lambda k: _weight(found[k]))
    reading, arc = found[worst], arcs[worst]
    if not happened:
        return reading
    span = f"from t = {times[arc.first]:.6g} to {times[arc.last]:.6g}"
    note = f"of {len(arcs)} arcs without an event the worst, {span}, where it is {reading.expected}"
    if "note" in reading.extra:
        note = f"{note}; {reading.extra['note']}"
    broken = [STRING] if reading.expected == "conserved" else [reading.expected.removeprefix("broken by "), STRING]
    return replace(reading, expected=f"broken by {', '.join(broken)}", extra={**reading.extra, "note": note})


def _weight(reading: Reading) -> tuple[bool, float]:
    """Alarms first, then what comes nearest to its bound."""
    return bool(reading.alarm), (reading.max_drift or 0.0) / (reading.bound or 1.0)


def _arcs(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Iterator[Arc]:
    """The longest pieces of the run in which no string goes slack or taut, in their order."""
    events = np.zeros(0)
    if flow.events is not None:
        events = np.asarray(flow.events.times)[: min(int(flow.events.count), LOGGED)]
    # stored states with the same number of events before them; one at an event itself is in no arc
    place = np.searchsorted(events, times, side="left")
    place = np.where(np.isin(times, events), -1, place)
    pieces = [np.flatnonzero(place == k) for k in range(len(events) + 1)]
    pieces = [(int(rows[0]), int(rows[-1])) for rows in pieces if len(rows) > 1]
    chosen = sorted(pieces, key=lambda ends: ends[0] - ends[1])[:MOST]
    for first, last in sorted(chosen):
        yield _arc(flow, first, last, times, q, p)


def _arc(flow: Flow, first: int, last: int, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Arc:
    run, model, rows = flow.run, flow.model, slice(first, last + 1)
    held = _held(model, times[rows], q[rows], p[rows])
    own = replace(model, constraints=tuple(model.constraints[k] for k in held), strings=())
    if held:
        problem = constrained_problem(own).value
    else:
        # the method for constraints goes on where none acts: it is the very steps that are looked at
        problem = replace(flow.problem, strings=(), active=(0.0,) * len(model.constraints))
    passed = run.per_sample * run.per_chunk * run.step
    piece = replace(
        run,
        t0=run.t0 + first * passed,
        duration=(last - first) * passed,
        samples=last - first + 1,
        done=(last - first) * run.per_sample,
        carry=None,
        stored=tuple(slot[rows] for slot in run.stored),
    )
    return Arc(replace(flow, model=own, problem=problem, run=piece, good=last - first + 1), first, last)


def _held(model: Model, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> list[int]:
    """The constraints that act along an arc: all but strings that are shorter than their length somewhere."""
    symbols = (model.q, model.p, model.t)
    values = observe([g for _, g in model.constraints], symbols, times, q, p)
    slopes = observe([g.diff(x) for _, g in model.constraints for x in model.q], symbols, times, q, p)
    squares = (slopes.reshape(len(values), len(model.q), -1) ** 2).sum(axis=1)
    slack = (values < -TAUT * squares).any(axis=1)
    return [k for k in range(len(values)) if k not in model.strings or not slack[k]]
