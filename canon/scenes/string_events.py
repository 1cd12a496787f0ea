"""What became of a scene's strings: when they went slack, when they became taut again, and what the jerk took away."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from canon.scenes.monitors.flow import Flow


@dataclass(frozen=True)
class Event:
    """At `time` the string `index` (from 1 on) became `taut`, and lost energy, or slack."""

    time: float
    index: int
    taut: bool
    lost: float


def events_of(flow: Flow) -> tuple[Event, ...]:
    """The events of a run up to its last good state, in their order; none where there are no strings."""
    found = flow.events
    if found is None:
        return ()
    order = {constraint: index for index, constraint in enumerate(flow.model.strings, 1)}
    count = min(int(found.count), len(found.times))
    rows = zip(*(np.asarray(column)[:count] for column in found[:4]), strict=True)
    end = flow.run.times[flow.good - 1]
    return tuple(
        Event(float(when), order[int(which)], bool(taut), float(lost))
        for when, which, taut, lost in rows
        if when <= end
    )
