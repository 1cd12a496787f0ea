"""Formulas along an orbit: their values at its stored states."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sp

from canon.numeric.lower import lower
from canon.numeric.precision import double


def observe(
    formulas: Sequence[sp.Expr],
    symbols: tuple[Sequence[sp.Symbol], Sequence[sp.Symbol], sp.Symbol],
    times: np.ndarray,
    q: np.ndarray,
    p: np.ndarray,
) -> np.ndarray:
    """The formulas' values (k, samples) at states q (samples, n) and p (samples, n), `symbols` being (q, p, t)."""
    import jax.numpy as jnp

    coordinates, momenta, t = symbols
    if not formulas:
        return np.zeros((0, len(times)))
    with double():
        function = lower(tuple(formulas), (*coordinates, *momenta, t))
        columns = [jnp.asarray(column, dtype=float) for column in (*np.transpose(q), *np.transpose(p), times)]
        values: list[Any] = [np.broadcast_to(np.asarray(value), times.shape) for value in function(*columns)]
    return np.array(values, dtype=float)
