"""How far two runs of one problem are apart, at the times that both have stored."""

from __future__ import annotations

from typing import Final

import numpy as np

from canon.numeric.integrate import Run

AGREED: Final = 1e-3
"""Two runs that differ by more than this part of their size have nothing in common any more."""


def agreement(run: Run, other: Run) -> int:
    """How many samples, from the first on, two runs agree in: each slot to a part of its largest size until then."""
    import jax

    count = min(run.completed, other.completed)
    good = np.ones(count, dtype=bool)
    for slot, against in zip(run.states, other.states, strict=True):
        pairs = list(zip(jax.tree.leaves(slot), jax.tree.leaves(against), strict=True))
        sizes = np.maximum.accumulate(
            np.max([np.abs(b[:count]).reshape(count, -1).max(axis=1, initial=0.0) for _, b in pairs], axis=0)
        )
        off = np.max(
            [np.abs(a[:count] - b[:count]).reshape(count, -1).max(axis=1, initial=0.0) for a, b in pairs], axis=0
        )
        good &= off <= AGREED * sizes
    return count if good.all() else int(np.argmin(good))


def distance(run: Run, other: Run, upto: int | None = None) -> float:
    """The largest difference of two runs' states, each slot in units of its largest component, where both got to."""
    import jax

    count = min(run.completed, other.completed, upto or run.samples)
    worst = 0.0
    for slot, against in zip(run.states, other.states, strict=True):
        pairs = list(zip(jax.tree.leaves(slot), jax.tree.leaves(against), strict=True))
        size = max(float(np.abs(a[:count]).max(initial=0.0)) for a, _ in pairs)
        off = max(float(np.abs(a[:count] - b[:count]).max(initial=0.0)) for a, b in pairs)
        worst = max(worst, off / size if size > 0 else off)
    return worst
