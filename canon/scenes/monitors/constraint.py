"""How far the bodies are off their constraints: the largest value that should vanish, along the run."""

from __future__ import annotations

from typing import Final

import numpy as np

from canon.numeric.observe import observe
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading, judged

SAFETY: Final = 1e-13


def read_constraint(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """|g(q, t)|, at most what rounding makes of it: the steps solve for the constraint."""
    model = flow.model
    symbols = (model.q, model.p, model.t)
    formulas = [g for _, g in model.constraints]
    values = observe(formulas, symbols, times, q, p)
    # a string may be shorter
    slack = np.isin(np.arange(len(values)), model.strings)[:, None]
    values = np.where(slack, np.maximum(values, 0.0), np.abs(values)).max(axis=0)
    slopes = observe([g.diff(x) for g in formulas for x in model.q], symbols, times, q, p)
    bound = SAFETY * float(np.abs(slopes).max() * max(np.abs(q).max(), 1e-300)) * len(model.q)
    # a state that is given in decimals may be off by as much as it was allowed to be
    bound += float(values[0])
    return judged("constraint", "conserved", float(values[0]), float(values[-1]), float(values.max()), bound)
