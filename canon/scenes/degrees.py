"""A Hamiltonian of several degrees of freedom as motions in one dimension, each with its own actions.

Found are: sums of Hamiltonians with one degree of freedom each; one coordinate that moves while all others are cyclic
angles, as in polar coordinates; and motion in Cartesian coordinates that rotations leave as it is, whose radius does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import sympy as sp

from canon.errors import InputError
from canon.numeric.actions.balls import ball_function, precision
from canon.numeric.actions.bounded import Bounded, bounded
from canon.numeric.actions.motion import Motion, motion
from canon.numeric.actions.orbit import Orbit
from canon.scenes.spherical import angles_in_space

Values = tuple[float, ...]

_BITS: Final = 400


@dataclass(frozen=True)
class Degree:
    """One pair of action and angle of a point: its `name`, the numbers, and the `orbit` and `motion` of its own.

    A cyclic coordinate has neither: its action is 2π times its momentum, and it runs on.
    """

    name: str
    action: Bounded
    frequency: Bounded | None
    angle: Bounded | None
    orbit: Orbit | None = None
    motion: Motion | None = None
    at: tuple[Any, Any] | None = None


def degrees_of(
    H: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], at_q: Values, at_p: Values
) -> tuple[tuple[Degree, ...], str]:
    """The degrees of freedom at a phase point, and in words how they were found.

    **Raises:** `InputError` where the motion isn't bounded, or in none of the forms above.
    """
    if len(q) == 1:
        return (_single(H, q[0], p[0], at_q[0], at_p[0]),), "one degree of freedom"
    moving = [k for k in range(len(q)) if q[k] in H.free_symbols]
    if len(moving) == 1:
        k = moving[0]
        return _with_cyclic(H, q, p, at_q, at_p, k), f"{q[k]} moves, and all other coordinates are cyclic"
    if len(moving) == len(q) and (parts := _summands(H, q, p)) is not None:
        found = tuple(_single(part, x, y, a, b) for part, x, y, a, b in zip(parts, q, p, at_q, at_p, strict=True))
        return found, "a sum of Hamiltonians with one degree of freedom each"
    if len(q) in (2, 3) and _isotropic(H, q, p):
        return _radial(H, q, p, at_q, at_p), "rotations leave H as it is: the radius and the angles separate"
    names = ", ".join(map(str, q))
    raise InputError(
        f"H does not separate in {names}: actions are found of one degree of freedom, of sums of such, of one "
        f"coordinate with all others cyclic, and of central problems in Cartesian coordinates",
        "[system]",
    )


def _single(H: Any, q: sp.Symbol, p: sp.Symbol, at_q: float, at_p: float) -> Degree:
    moved = motion(H, q, p)
    orbit = moved.at(at_q, at_p)
    return Degree(str(q), orbit.action, orbit.frequency, orbit.angle, orbit, moved, (at_q, at_p))


def _summands(H: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> list[Any] | None:
    parts: list[Any] = [sp.S.Zero] * len(q)
    for term in sp.Add.make_args(sp.expand(H)):
        owners = [k for k in range(len(q)) if term.free_symbols & {q[k], p[k]}]
        if len(owners) > 1:
            return None
        parts[owners[0] if owners else 0] += term
    return parts


def _with_cyclic(
    H: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], at_q: Values, at_p: Values, k: int
) -> tuple[Degree, ...]:
    fixed: Any = {p[j]: sp.Rational(at_p[j]) for j in range(len(q)) if j != k}
    moved = motion(H.subs(fixed), q[k], p[k])
    orbit = moved.at(at_q[k], at_p[k])
    found = []
    for j in range(len(q)):
        if j == k:
            found.append(
                Degree(str(q[k]), orbit.action, orbit.frequency, orbit.angle, orbit, moved, (at_q[k], at_p[k]))
            )
            continue
        rate = sp.diff(H, p[j]).subs(fixed)
        frequency, angle = moved.drift(at_q[k], at_p[k], rate, sp.Rational(at_q[j]))
        found.append(Degree(str(q[j]), _turns(fixed[p[j]]), frequency, _in_unit(angle)))
    return tuple(found)


def _turns(momentum: Any) -> Bounded:
    """2π times a momentum."""
    with precision(_BITS):
        return bounded(ball_function(2 * sp.pi * momentum, ())())


def _in_unit(angle: Bounded) -> Bounded:
    """The angle less its whole turns."""
    value = angle.value % 1.0
    return replace(angle, value=value if value < 1.0 else 0.0, bound=angle.bound + 2.0**-53)


def _isotropic(H: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> bool:
    """Whether every angular momentum has bracket 0 with H, at points of 120 digits that nothing distinguishes."""
    n = len(q)
    for i in range(n):
        for j in range(i):
            turned = sum(
                (a * sp.diff(H, x[j]) - b * sp.diff(H, x[i]) for x in (q, p) for a, b in [(x[i], x[j])]),
                start=sp.S.Zero,
            )
            with precision(_BITS):
                f = ball_function(turned, (*q, *p))
                for k in range(1, 4):
                    values = [ball_function(sp.sqrt(sp.prime(7 * k + m)) / 3, ())() for m in range(2 * n)]
                    if not f(*values).contains(0):
                        return False
    return True


def _radial(H: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], at_q: Values, at_p: Values) -> tuple[Degree, ...]:
    """The radius as a motion in one dimension; the angle in the plane of the orbit, and the plane's own."""
    r, L = sp.Symbol("r", positive=True), sp.Symbol("L", positive=True)
    p_r = sp.Symbol("p_r", real=True)
    place = angles_in_space(at_q, at_p)
    if place.momentum == 0:
        raise InputError("the angular momentum is 0: the motion goes through the centre, and has no angles", "[system]")
    zeros = dict.fromkeys((*q[2:], *p[2:]), 0)
    reduced = H.subs({**zeros, q[0]: r, q[1]: 0, p[0]: p_r, p[1]: L / r}, simultaneous=True)
    rate = sp.diff(reduced, L).subs(L, place.momentum)
    moved = motion(reduced.subs(L, place.momentum), r, p_r)
    orbit = moved.at(place.radius, place.radial_momentum)
    frequency, angle = moved.drift(place.radius, place.radial_momentum, rate, place.in_plane)
    at = (place.radius, place.radial_momentum)
    first = Degree("r", orbit.action, orbit.frequency, orbit.angle, orbit, moved, at)
    if len(q) == 2:
        turned = _signed(frequency, place.sense)
        return (
            first,
            Degree("phi", _turns(place.sense * place.momentum), turned, _in_unit(_signed(angle, place.sense))),
        )
    along = place.along_axis
    azimuth = Bounded(place.node.value + place.sense * angle.value, place.node.bound + angle.bound)
    return (
        first,
        Degree("theta", _turns(place.momentum - abs(along)), frequency, _in_unit(angle)),
        Degree("phi", _turns(along), _signed(frequency, place.sense), _in_unit(azimuth)),
    )


def _signed(value: Bounded, sense: int) -> Bounded:
    return Bounded(sense * value.value, value.bound)
