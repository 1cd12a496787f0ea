"""The closed forms of the action of a libration, tried in turn."""

from collections.abc import Iterator

from canon.mechanics.action_angle import ClosedAction, OneDegree
from canon.mechanics.quartic_wells import quartic_wells
from canon.mechanics.residues import by_residues
from canon.mechanics.standard_actions import pendulum_like, power_well


def librations(motion: OneDegree) -> Iterator[ClosedAction]:
    """Those that suit the square of the momentum: by residues, elliptic integrals, Euler's beta function."""
    yield from by_residues(motion)
    yield from pendulum_like(motion)
    yield from power_well(motion)
    yield from quartic_wells(motion)
