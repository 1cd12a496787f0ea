"""Reversibility: the run's steps, backwards from its last state, lead to its first one."""

from __future__ import annotations

from typing import Final

import numpy as np

from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading, judged

SAFETY: Final = 100.0
FLOOR: Final = 1e-13


def read_reversibility(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """The largest distance of a coordinate, or momentum, from where it began, in units of the largest one."""
    steps = max(flow.steps, 1)
    last = np.concatenate([q[-1], p[-1]])[None]
    back, n = flow.neighbours.back(last)[0], q.shape[1]
    drifts = []
    for found, x in ((back[:n], q), (back[n:], p)):
        size = max(float(np.abs(x).max(initial=0.0)), 1e-300)
        drifts.append(float(np.abs(found - x[0]).max(initial=0.0)) / size)
    drift = max(drifts)
    bound = None if flow.error is None else SAFETY * (2 * flow.error + FLOOR * np.sqrt(steps))
    return judged("reversibility", "conserved", 0.0, drift, drift, bound)
