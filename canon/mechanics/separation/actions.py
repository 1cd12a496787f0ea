"""Actions of a separated system in closed form, one for each coordinate, where a standard integral is recognised."""

from typing import Any

import sympy as sp

from canon.expected import instance_of
from canon.mechanics.action_angle import ClosedAction, OneDegree
from canon.mechanics.residues import by_residues
from canon.mechanics.separation.staeckel import Separation
from canon.mechanics.standard_actions import pendulum_like, power_well, rotation

RANGES: dict[str, tuple[Any, Any]] = {
    "theta": (sp.S.Zero, sp.pi), "nu": (sp.S.Zero, sp.pi),
}  # fmt: skip
_ANGLES = ("phi",)


def separated_actions(separated: Separation) -> dict[sp.Symbol, ClosedAction | None]:
    """J_i = ∮ p_i du_i as a function of E and the separation constants; None where no closed form is recognised.

    Of an azimuth it is the rotation's over 2π, of other coordinates the libration's. Whether the equations separate,
    and what each closed form rests on, is to be verified: see `canon.separates` and claims of kind `action`.
    """
    instance_of(separated, Separation, "separated")
    found: dict[sp.Symbol, ClosedAction | None] = {}
    for u, square in zip(separated.coordinates.u, separated.momentum_squares(), strict=True):
        low: Any = sp.S.Zero if u.is_positive else sp.S.NegativeInfinity
        low, high = RANGES.get(u.name, (low, sp.S.Infinity))
        together: Any = sp.together(square)
        motion = OneDegree(u, together, sp.S.Zero, sp.S.One, low, high)
        if u.name in _ANGLES and not motion.square.has(u):
            found[u] = next(rotation(motion, 2 * sp.pi))
            continue
        ways = (form for way in (by_residues, pendulum_like, power_well) for form in way(motion))
        found[u] = next(ways, None)
    return found
