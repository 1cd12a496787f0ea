"""All integrators by name."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Final

from canon.errors import InputError
from canon.numeric.integrators import (
    blanes_moan,
    boris,
    compositions,
    corrected,
    gauss,
    multistep,
    near_integrable,
    nystrom,
    nystrom_8,
    rattle,
    runge_kutta,
    yoshida,
)
from canon.numeric.integrators.composed import OneStep, composed
from canon.numeric.integrators.stepper import Method
from canon.numeric.integrators.strings import WithStrings

_GAMMAS: Final = (
    (4, compositions.SUZUKI_4_GAMMA, compositions.SUZUKI_4.source),
    (6, compositions.KAHAN_LI_6_GAMMA, compositions.KAHAN_LI_6.source),
    (8, compositions.KAHAN_LI_8_GAMMA, compositions.KAHAN_LI_8.source),
)


def _with_compositions(base: OneStep) -> tuple[OneStep, ...]:
    return (base, *(composed(base, gamma, order, source) for order, gamma, source in _GAMMAS))


SPLITTING: Final = (
    *yoshida.METHODS,
    *compositions.METHODS,
    *blanes_moan.METHODS,
    *nystrom.METHODS,
    *nystrom_8.METHODS,
    *near_integrable.METHODS,
    *corrected.METHODS,
)
"""For problems that are split into solvable parts."""

WHOLE: Final = (*gauss.METHODS, *runge_kutta.METHODS)
"""For whole vector fields."""

CONSTRAINED: Final = tuple(WithStrings(each) for each in _with_compositions(rattle.RATTLE))
"""For holonomic constraints, and strings."""

CHARGES: Final = tuple(method for base in boris.METHODS for method in _with_compositions(base))
"""For charges in any fields."""

MULTISTEP: Final = multistep.METHODS
"""For T(p) + V(q) and smooth motions, with one force a step."""

METHODS: Final[tuple[Method, ...]] = (*SPLITTING, *MULTISTEP, *WHOLE, *CONSTRAINED, *CHARGES)


OTHER_NAMES: Final = {
    "leapfrog": "verlet", "leap_frog": "verlet", "stormer_verlet": "verlet", "velocity_verlet": "verlet",
    "strang": "verlet", "ruth": "yoshida4", "forest_ruth": "yoshida4", "midpoint": "implicit_midpoint",
    "shake": "rattle", "runge_kutta": "rk4",
}  # fmt: skip
"""What methods are called elsewhere."""


def method(name: str) -> Method:
    """The integrator of that name.

    **Raises:** `InputError` with the nearest names where there is none.
    """
    found = next((each for each in METHODS if each.name == name), None)
    if found is not None:
        return found
    names = [each.name for each in METHODS]
    meant = OTHER_NAMES.get(name.lower().replace("-", "_"))
    near = [meant] if meant else get_close_matches(name, names, 3, 0.5) or names
    raise InputError(f"no integrator is called {name!r}; there is {', '.join(near)}")
