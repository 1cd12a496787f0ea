"""One particle scattered by a central potential: its deflection and the differential cross-section."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from canon.errors import InputError
from canon.expected import finite_number, instance_of, table
from canon.mechanics.formulas import as_expression
from canon.numeric.deflection import (
    beyond_barriers,
    cross_section,
    deflection,
    rutherford,
    rutherford_cross_section,
)
from canon.numeric.lower import lower
from canon.numeric.precision import UNIT, double

SAMPLES: Final = 16
BEYOND: Final = (1e6, 1e12)
"""So many times the distance from which a particle comes, V is looked at: there it has to fall."""
SLOWEST: Final = 0.9
"""By less than this factor, between the two, only a potential falls that isn't seen to vanish at all."""


@dataclass(frozen=True)
class Scattering:
    """What a particle of this energy and impact parameter does.

    **Arguments:** `angle` χ, positive where it is repelled; `backward`, π − |χ|, which has digits of its own;
    `nearest`, the distance at which it turns round; `cross_section`, dσ/dΩ of a beam at this impact parameter, None
    where all of it goes the same way.
    """

    angle: float
    backward: float
    nearest: float
    cross_section: float | None


def scattering(
    V: Any,
    r: sp.Symbol,
    *,
    energy: float,
    impact_parameter: float,
    begin: float | None = None,
    parameters: Mapping[Any, float] | None = None,
) -> Scattering | None:
    """Deflection by V(r), which vanishes at infinity: by quadrature, and Rutherford's formulas where V = k/r.

    χ = π − 2 b ∫ dr/(r² √(1 − V/E − b²/r²)) from the turning point on; dσ/dΩ = b/|sin χ dχ/db| (Landau and Lifshitz,
    Mechanics, eq. 18.4 and 18.8; Goldstein, Poole and Safko, eq. 3.96).

    **Arguments:** `V`, a formula of r and of `parameters`, whose values are given; `energy`, mv²/2 far away;
    `impact_parameter`, b ≥ 0; `begin`, a distance from which it comes, beyond all barriers (10³ times b, or 10³; ten
    times as far as the last barrier, where that is farther out).

    **Returns** None where it falls into the centre, or can't come from there. **Raises:** `InputError`.
    """
    for value, where, least in ((energy, "energy", False), (impact_parameter, "impact_parameter", True)):
        finite_number(value, where)
        if not (value > 0 or (least and value == 0)):
            raise InputError(f"a {'number from 0 on' if least else 'positive number'} is expected, not {value}", where)
    instance_of(r, sp.Symbol, "r")
    if parameters is not None:
        table(parameters, "numbers", "parameters")
        for name, value in parameters.items():
            finite_number(value, f"parameters, {name}")
    if begin is not None:
        finite_number(begin, "begin")
    potential = _with_numbers(as_expression(V, "V"), r, parameters or {})
    b, E = float(impact_parameter), float(energy)
    k: Any = sp.simplify(potential * r) if potential.is_rational_function(r) else potential
    if k.is_number and k != 0:
        if b == 0 and k < 0:
            return None
        found = rutherford(float(k), E, b)
        return Scattering(found.angle, found.backward, found.nearest, rutherford_cross_section(float(k), E, b))
    far = float(begin) if begin is not None else 1e3 * (b or 1.0)
    if not far > 0:
        raise InputError(f"a positive distance is expected, not {far}", "begin")
    with double():
        value, slope = (_function(formula, r) for formula in (potential, sp.diff(potential, r)))
        if _stays(value, E, far):
            raise InputError("V vanishes far away, where mv²/2 is the whole energy: this one doesn't", "V")
        if begin is None:
            far = beyond_barriers(value, E, b, far)
        of = lambda parameter: deflection(value, slope, E, parameter, far)
        found = of(b)
        if found is None:
            return None
        return Scattering(found.angle, found.backward, found.nearest, cross_section(of, b, found.nearest))


def _stays(potential: Callable[[Any], Any], E: float, far: float) -> bool:
    """Whether V doesn't fall between two distances far beyond the beginning."""
    beyond = far * np.linspace(1.0, 3.0, SAMPLES)
    near, further = (np.max(np.abs(potential(beyond * times))) for times in BEYOND)
    return bool(further > UNIT * E and further > SLOWEST * near)


def _with_numbers(V: Any, r: sp.Symbol, parameters: Mapping[Any, float]) -> Any:
    """The potential with numbers for its parameters, which are named by symbols or by text."""
    named = {str(name): value for name, value in parameters.items()}
    rules = {x: sp.Float(named[x.name]) for x in V.free_symbols - {r} if x.name in named}
    found = V.subs(rules)
    for x in sorted(found.free_symbols - {r}, key=str):
        raise InputError(f"the value of {x} is missing", "parameters")
    if found.atoms(sp.Function) and any(isinstance(f, AppliedUndef) for f in found.atoms(sp.Function)):
        raise InputError("an arbitrary function has no values", "V")
    return found


def _function(formula: Any, r: sp.Symbol) -> Any:
    function = lower((formula,), (r,))
    return lambda values: np.array(np.broadcast_to(np.asarray(function(values)[0], dtype=float), np.shape(values)))
