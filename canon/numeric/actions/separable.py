"""Actions of many orbits in a Stäckel potential that is given by its function G, with bounds.

Conditioning: the bounds take the state as exact. Radial and vertical actions are as the squares of the oscillations'
sizes, so that relative errors ε of the state are some ε/e of an action, with e the size of its oscillation beside the
orbit's.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from canon.numeric.actions import staeckel
from canon.numeric.actions.oscillation import Narrow, Scalar
from canon.numeric.actions.staeckel_orbits import Parts, sums_of


class StaeckelActions(NamedTuple):
    """J_λ, J_ν and J_φ = 2πL_z of each orbit, in the plane's terms radial, vertical and azimuthal, with two bounds."""

    radial: Any
    vertical: Any
    azimuthal: Any
    radial_bound: Any
    vertical_bound: Any


def staeckel_actions(
    G: Any,
    delta: float,
    R: Any,
    z: Any,
    p_R: Any,
    p_z: Any,
    L_z: Any,
    *,
    m: float = 1.0,
    variable: str = "t",
    parameters: Mapping[str, Any] | None = None,
) -> StaeckelActions:
    """The actions of orbits in V = −[l G(l) − n G(n)]/(l − n), in spheroidal coordinates with foci at z = ±`delta`.

    **Arguments:** `G`, a formula in `variable`: Kuzmin's and Kutuzov's −GM/(√λ + √ν) with ν ≥ c² is GM/(c + √(t + c²));
    `R` > 0, `z` and their momenta, and `L_z` ≠ 0, arrays of one shape; `m`, the mass.

    **Raises:** `InputError` where G is no such formula, or an orbit is not bound or on the axis, with its index.
    """
    found = sums_of(PARTS, (2, 2), G, delta, (R, z, p_R, p_z, L_z), m, variable, parameters)
    rows = (found.along[0], found.across[0], 2 * np.pi * found.state[4], found.along[1], found.across[1])
    return StaeckelActions(*(x.reshape(found.shape) for x in rows))


def _near(G: Scalar, D2: Any, orbit: Narrow, m: Any, place: staeckel.Place) -> tuple[Any, Any]:
    action, rounding = staeckel.narrow_action(orbit, m, place)
    return 2 * action, rounding


def _wide(G: Scalar, D2: Any, m: Any, place: staeckel.Place, low: Any, high: Any, count: int) -> tuple[Any, Any]:
    action, rounding = staeckel.wide_radial(G, D2, m, place, low, high, count)
    return 2 * action, rounding


PARTS = Parts(_near, _wide, staeckel.vertical, 1)
"""The integrals there and back, with their rounding."""
