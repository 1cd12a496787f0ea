"""The closed forms of the action of a libration, tried in turn."""

from collections.abc import Iterator
from itertools import tee

import sympy as sp

from canon.mechanics.action_angle import ClosedAction, OneDegree, Test, nowhere
from canon.mechanics.elliptic_actions import elliptic
from canon.mechanics.quartic_wells import quartic_wells
from canon.mechanics.residues import by_residues
from canon.mechanics.separatrix_actions import separatrix
from canon.mechanics.standard_actions import pendulum_like, power_well
from canon.mechanics.substitutions import integrands


def librations(motion: OneDegree, positive: Test = nowhere, well: sp.Expr | None = None) -> Iterator[ClosedAction]:
    """Those that suit the square of the momentum: by residues, elliptic integrals, Euler's beta function.

    **Arguments:** `positive`, whether an expression in the constants certainly is, by which roots are put in order;
    `well`, a point inside the orbit that is meant.
    """
    first, second, third = tee(integrands(motion), 3)
    yield from by_residues(motion, first)
    yield from pendulum_like(motion)
    yield from power_well(motion)
    yield from quartic_wells(motion, positive, well)
    yield from elliptic(motion, second, positive, well)
    yield from separatrix(motion, third, positive, well)
