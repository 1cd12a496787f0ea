"""What acts between all pairs of bodies: written out for a few, one atom for more."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from canon.numeric.pair_sum import PairSum
from canon.scenes.effects.effect import Particle
from canon.scenes.model import Formula

WRITTEN_OUT: Final = 2
"""Bodies up to which the pairs are written out."""


def sum_over_pairs(law: Formula, bodies: Sequence[Particle], weights: Sequence[Any] | None = None) -> Formula:
    """Σ_{i<j} w_i w_j U(r_ij, t), with the law U in `RADIUS`; the weights are 1 where they are left out."""
    whole = PairSum(law, [body.x for body in bodies], weights)
    return whole.written_out() if len(bodies) <= WRITTEN_OUT else whole
