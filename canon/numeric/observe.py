"""Formulas along an orbit: their values at its stored states."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
import sympy as sp

from canon.numeric.lower import lower
from canon.numeric.rows import lower_rows

MANY: Final = 24
"""Variables from which on formulas of one shape are computed together."""


def observe(
    formulas: Sequence[sp.Expr],
    symbols: tuple[Sequence[sp.Symbol], Sequence[sp.Symbol], sp.Symbol],
    times: np.ndarray,
    q: np.ndarray,
    p: np.ndarray,
) -> np.ndarray:
    """The formulas' values (k, samples) at states q (samples, n) and p (samples, n), `symbols` being (q, p, t)."""
    coordinates, momenta, t = symbols
    if not formulas:
        return np.zeros((0, len(times)))
    z = np.concatenate([np.transpose(q), np.transpose(p)]).astype(float)
    # by numpy: to compile a formula takes longer than to evaluate it at a few thousand states
    with np.errstate(all="ignore"):
        if len(z) > MANY:
            return lower_rows(formulas, (*coordinates, *momenta), (t,))(z, times, numbers=np)
        found = lower(tuple(formulas), (*coordinates, *momenta, t))(*z, times, numbers=np)
    return np.array([np.broadcast_to(value, times.shape) for value in found], dtype=float)
