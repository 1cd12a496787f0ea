"""What a monitor says of a run."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Reading:
    """A monitor's result: what theory expects, the values at the beginning and end, the largest `max_drift` from what
    is expected, the `bound` that it may have where it must be conserved, and an `alarm` where it has more.

    `extra` are further figures of the monitor, such as the value that theory predicts for the end.
    """

    name: str
    expected: str
    initial: Any
    final: Any
    max_drift: float | None
    bound: float | None = None
    alarm: str = ""
    extra: dict[str, Any] = field(default_factory=dict)


def judged(
    name: str, expected: str, initial: Any, final: Any, drift: float | None, bound: float | None, **extra: Any
) -> Reading:
    """The reading, with an alarm where a bound is known and the drift is beyond it; one that isn't finite is none."""
    alarm = ""
    bound = None if bound is None or not np.isfinite(bound) else bound
    if bound is not None and drift is not None and not drift <= bound:
        alarm = f"drifted by {drift:.3g}, and at most {bound:.2g} is expected ({expected})"
    return Reading(name, expected, initial, final, drift, bound, alarm, extra)


def plain(values: np.ndarray) -> Any:
    """One number, or a list of several."""
    return float(values[0]) if len(values) == 1 else [float(value) for value in values]
