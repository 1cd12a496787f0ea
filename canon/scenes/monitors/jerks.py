"""The energy of a scene with strings: it falls at every jerk by what the jerk takes away, and is kept between."""

from __future__ import annotations

import numpy as np

from canon.numeric.observe import observe
from canon.scenes.monitors.conserved import breakers, drift_bound
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading, judged


def read_jerked(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """The energy, beside what the jerks of strings that became taut have left of it."""
    model = flow.model
    (values,) = observe((model.H,), (model.q, model.p, model.t), times, q, p)
    lost, when = np.zeros(0), np.zeros(0)
    if flow.events is not None:
        count = min(int(flow.events.count), len(flow.events.times))
        when, lost = np.asarray(flow.events.times)[:count], np.asarray(flow.events.lost)[:count]
    # the first state is that before a jerk at the very beginning
    predicted = values[0] - np.array([0.0, *(lost[when <= t].sum() for t in times[1:])])
    drift = float(np.abs(values - predicted).max())
    breaking = [*breakers((model.H,), model, q, p), *(["string"] if lost.any() else [])]
    expected = f"broken by {', '.join(dict.fromkeys(breaking))}" if breaking else "conserved"
    first, last = float(values[0]), float(values[-1])
    if breaking and breaking != ["string"]:
        return Reading("energy", expected, first, last, float(np.abs(values - values[0]).max()))
    bound = drift_bound((model.H,), flow, times, q, p, values[None])
    extra = {"predicted": float(predicted[-1])} if breaking else {}
    return judged("energy", expected, first, last, drift, bound, **extra)
