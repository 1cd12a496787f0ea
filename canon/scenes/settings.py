"""The section [run] of a scene file."""

from __future__ import annotations

from typing import Any, Final

from canon.claims import document
from canon.claims.document import key
from canon.errors import InputError
from canon.scenes.scene import DEFAULT_ACCURACY, DEFAULT_SAMPLES, MONITORS, MOST_SAMPLES, Settings
from canon.scenes.values import double, needed
from canon.vocabulary import nearest

KEYS: Final = ("duration", "accuracy", "step", "integrator", "samples", "monitor")
WHERE: Final = "[run]"


def read_settings(value: Any) -> Settings:
    """How the run is to be made. **Raises:** `InputError` with the place."""
    table = document.table(value, WHERE)
    document.only(table, KEYS, WHERE)
    duration = double(needed(table, "duration", WHERE), key("duration", WHERE), positive=True)
    step = double(table["step"], key("step", WHERE), positive=True) if "step" in table else None
    if step is not None and "accuracy" in table:
        raise InputError("both 'accuracy' and 'step' are given: the step is chosen for the accuracy, or fixed", WHERE)
    accuracy = double(table.get("accuracy", str(DEFAULT_ACCURACY)), key("accuracy", WHERE), positive=True)
    return Settings(
        duration,
        accuracy=checked_accuracy(accuracy, key("accuracy", WHERE)) if step is None else None,
        step=step,
        integrator=document.text(table["integrator"], key("integrator", WHERE)) if "integrator" in table else None,
        samples=_samples(table.get("samples", DEFAULT_SAMPLES)),
        monitors=_monitors(table.get("monitor", [])),
    )


def checked_accuracy(accuracy: float, where: str) -> float:
    """An accuracy between rounding and 1. **Raises:** `InputError`."""
    if not 1e-15 <= accuracy < 1:
        raise InputError(f"an accuracy from 1e-15 to 1 is expected, not {accuracy:g}", where)
    return accuracy


def _samples(value: Any) -> int:
    where = key("samples", WHERE)
    count = document.whole(value, where)
    if not 2 <= count <= MOST_SAMPLES:
        raise InputError(f"from 2 to {MOST_SAMPLES} samples can be stored, not {count}", where)
    return count


def _monitors(value: Any) -> tuple[str, ...]:
    where = key("monitor", WHERE)
    for item in document.listing(value, where):
        name = document.text(item, where)
        if name not in MONITORS:
            advice = nearest(name, MONITORS) or f": the monitors are {', '.join(MONITORS)}"
            raise InputError(f"unknown monitor {name[:80]!r}{advice}", where)
    return document.names(value, where)
