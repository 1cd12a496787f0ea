"""One orbit of a motion in one dimension."""

from __future__ import annotations

from dataclasses import dataclass

from canon.numeric.actions.bounded import Bounded


@dataclass(frozen=True)
class Orbit:
    """One orbit of a motion in one dimension, its numbers with bounds.

    `kind` is "libration" or "rotation"; `ends` are the turning points, or where a rotation's period begins and ends;
    `action` J = ∮ p dq; `period` and `frequency` ν = dE/dJ = 1/T, None on a separatrix; `angle` w in [0, 1) of the
    point that was asked about, 0 at the lower end on the way up; `rule`, the quadrature, and its number of `nodes`, or
    of steps of the mean.
    """

    kind: str
    energy: Bounded
    ends: tuple[Bounded, Bounded]
    action: Bounded
    period: Bounded | None
    frequency: Bounded | None
    angle: Bounded | None
    rule: str
    nodes: int
    note: str = ""
