"""Monitors of systems that do not act on each other: the flow's derivative is block diagonal, and ∮ p dq is a sum."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading

SUMS: Final = ("loop", "cartan")
LARGEST: Final = ("symplecticity", "reversibility")


def read_beside(read: Callable[..., Reading], flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """The readings of each of the flow's independent parts, put together."""
    readings = []
    for part in flow.beside:
        rows = slice(part.rows[0], part.rows[0] + part.model.n), slice(part.rows[1], part.rows[1] + len(part.model.p))
        readings.append(read(part.flow, times, q[:, rows[0]], p[:, rows[1]]))
    return put_together(readings)


def put_together(readings: Sequence[Reading]) -> Reading:
    """One reading: loops add up, 1 + (det M − 1) multiplies, of others the largest counts."""
    first = readings[0]
    broken = [each.expected.removeprefix("broken by ") for each in readings if each.expected != "conserved"]
    expected = f"broken by {', '.join(dict.fromkeys(broken))}" if broken else "conserved"
    initial, final, drift, predicted = (
        _joined(first.name, [_value(each, word) for each in readings])
        for word in ("initial", "final", "max_drift", "predicted")
    )
    if first.name == "volume":
        drift = _joined("symplecticity", [each.max_drift for each in readings])
    bounds = [each.bound for each in readings]
    bound = None if None in bounds else _joined(first.name if first.name in SUMS else "symplecticity", bounds)
    alarmed = next((each for each in readings if each.alarm), None)
    if alarmed is not None:
        drift, bound = alarmed.max_drift, alarmed.bound
    told = any("predicted" in each.extra for each in readings)
    extra: dict[str, Any] = {} if predicted is None or not told else {"predicted": predicted}
    for name in ("nodes", "resolved_until"):
        values = [each.extra[name] for each in readings if name in each.extra]
        if values:
            extra[name] = max(values) if name == "nodes" else min(values)
    notes = list(dict.fromkeys(each.extra["note"] for each in readings if "note" in each.extra))
    if notes:
        extra["note"] = "; ".join(notes)
    return Reading(first.name, expected, initial, final, drift, bound, alarmed.alarm if alarmed else "", extra)


def _value(reading: Reading, word: str) -> float | None:
    """A figure of a reading; what is predicted of a conserved quantity is its first value, or 0."""
    if word != "predicted":
        return getattr(reading, word)
    if "predicted" in reading.extra or reading.expected != "conserved":
        return reading.extra.get("predicted")
    return reading.initial


def _joined(name: str, values: Sequence[float | None]) -> float | None:
    """None where one of them is not known."""
    known = [value for value in values if value is not None]
    if len(known) < len(values):
        return None
    if name == "volume":
        return float(np.prod([1 + value for value in known]) - 1)
    return sum(known) if name in SUMS else max(known)
