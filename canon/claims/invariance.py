"""Integral invariants of a map by numbers: ∮ p dq, ∮ p dq − H dt, and the integrals of ωᵏ, before it and after it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.claims.audit_subject import checked_parameters, formulas_as_map
from canon.claims.implicit_map import ImplicitMap
from canon.claims.invariance_report import Invariance
from canon.errors import InputError
from canon.expected import finite_number, function, shown, whole_number
from canon.numeric.images import compare_loops, compare_surfaces
from canon.numeric.loops import real
from canon.numeric.map_shape import point_map
from canon.numeric.precision import UNIT, double

if TYPE_CHECKING:
    from canon.mechanics.transformation import Transformation

Array = Any  # numpy arrays
Loop = Callable[[Array], Array]
TRIED: Final = 16


def loop_invariant(
    map: Transformation | Callable[..., Any],  # noqa: A002 - the field's own word
    loop: Loop | Array,
    *,
    scale: float = 1.0,
    parameters: Mapping[str, float] | None = None,
    periods: Sequence[float | None] = (),
    new_periods: Sequence[float | None] = (),
    most_nodes: int = 65536,
) -> Invariance:
    """∮ p dq around a closed loop and around its image: Poincaré's relative integral invariant.

    A canonical map of valence c multiplies it by c, on every loop that bounds a surface on which the map is defined; on
    a loop that winds round a hole or an angle, only if the map is exact. Arnold (1989), section 44.

    **Arguments:**

    - `map`: a `Transformation`, with values of its `parameters`, or a Python function of phase points in any of the
      forms that `audit` takes. A transformation given as old in terms of new is taken as it is written.
    - `loop`: a function of parameters s (N,), with period 1, to phase points (N, 2n); or an array (N, 2n) of points
      of a loop at s = 0, 1/N, …, which can't be refined.
    - `scale`: the valence that is expected.
    - `periods`, `new_periods`: 2n numbers each, for an angle its period, else None: where the loop, or its image, winds
      round an angle. A loop may not wind in a momentum.
    - `most_nodes`: how far the nodes are doubled.

    **Returns:** an `Invariance`; `preserved` is None, and the verdict `undecided`, where the nodes don't resolve the
    loop or its image.

    **Raises:** `InputError` where the loop, or its image, isn't closed or finite, or has a wrong shape.
    """
    _checked_count(most_nodes, "most_nodes")
    some = _some(loop, 1)
    for given, name in ((periods, "periods"), (new_periods, "new_periods")):
        _check_periods(given, some.shape[1], name)
    evaluate, factor, unit = _evaluated(map, some, parameters, scale)
    found = compare_loops(
        evaluate, loop, factor=factor, periods=periods, new_periods=new_periods, most_nodes=most_nodes, unit=unit
    )
    return Invariance("∮ p dq", found)


def surface_invariant(
    map: Transformation | Callable[..., Any],  # noqa: A002
    surface: Loop,
    *,
    periodic: Sequence[bool],
    scale: float = 1.0,
    parameters: Mapping[str, float] | None = None,
    most_points: int | None = None,
) -> Invariance:
    """∫ ωᵏ/k! with ω = Σ dp_i∧dq_i over a surface of 2k dimensions and over its image: absolute integral invariants.

    For k = 1 it is the sum of the oriented areas of the projections onto the planes (p_i, q_i), in general that of the
    volumes of the projections onto k conjugate pairs. A canonical map of valence c multiplies it by cᵏ. Arnold (1989),
    section 44.

    **Arguments:** `map`, `parameters`, `scale` as for `loop_invariant`; `surface`, a function of parameters u (N, 2k)
    in [0, 1]²ᵏ to phase points (N, 2n); `periodic`, 2k booleans that say which directions close, as the angle of polar
    coordinates does; `most_points` on one grid, by default 2¹⁸ for k = 1 and 2, 2²⁰ for more.

    **Returns:** an `Invariance`.

    **Raises:** `InputError` as `loop_invariant`.
    """
    function(surface, "a surface", "surface")
    if not isinstance(periodic, Sequence):
        raise InputError("for each direction of the surface, a boolean that says whether it closes", "periodic")
    if most_points is not None:
        _checked_count(most_points, "most_points")
    order, odd = divmod(len(periodic), 2)
    if odd or not order:
        raise InputError(f"a surface has 2, 4, 6, … directions, not {len(periodic)}", "periodic")
    evaluate, factor, unit = _evaluated(map, _some(surface, len(periodic)), parameters, scale)
    found = compare_surfaces(evaluate, surface, periodic, factor=factor**order, most_points=most_points, unit=unit)
    return Invariance("∬ dp∧dq" if order == 1 else f"∫ ω^{order}/{order}!", found)


def cartan_loop_invariant(
    map: Transformation | Callable[..., Any],  # noqa: A002
    loop: Loop | Array,
    *,
    H: Any,
    K: Any = None,
    scale: float = 1.0,
    parameters: Mapping[str, float] | None = None,
    most_nodes: int = 65536,
) -> Invariance:
    """∮ p dq − H dt around a loop of states at different times, and ∮ P dQ − K dt around its image.

    A flow of H leaves it alone, whichever time each state is carried along (Poincaré and Cartan); a canonical map that
    depends on time takes it to the integral with the new Hamiltonian K. Arnold (1989), sections 44 and 45.

    **Arguments:**

    - `map`: a `Transformation` (given forward), or a function of (z, t) that returns Z, or (Z, T) where it changes the
      time too.
    - `loop`: a function of parameters s (N,), with period 1, to states (N, 2n+1), the time last; or such states.
    - `H`, `K`: functions of (z, t) or, for a transformation, expressions; K is H where it is left out, as for a flow.

    **Returns:** an `Invariance`.

    **Raises:** `InputError` as `loop_invariant`.
    """
    from canon.claims.extended_phase import extended

    checked_valence(scale)
    _checked_count(most_nodes, "most_nodes")
    evaluate, lifted = extended(map, loop, H, H if K is None else K, checked_parameters(parameters))
    return Invariance("∮ p dq − H dt", compare_loops(evaluate, lifted, factor=scale, most_nodes=most_nodes))


def checked_valence(scale: Any) -> None:
    """**Raises:** `InputError` for what is no valence: a finite number other than 0."""
    finite_number(scale, "scale", nonzero=True)


def _checked_count(most: Any, name: str) -> None:
    whole_number(most, name, 1)


def _check_periods(periods: Any, size: int, name: str) -> None:
    """None of them, or one for each variable: above 0, or None for what is no angle."""
    if not isinstance(periods, Sequence) or isinstance(periods, (str, bytes)) or len(periods) not in (0, size):
        raise InputError(f"{size} periods are expected, None for what is no angle, not {shown(periods)}", name)
    for period in periods:
        if period is not None:
            finite_number(period, name)
            if not period > 0:
                raise InputError(f"a period is positive, not {period}", name)


def _some(shape: Loop | Array, directions: int) -> Array:
    """A few of the points, at which the map is tried."""
    if not callable(shape):
        points = np.atleast_1d(real(shape))[:TRIED]
    else:
        s = (np.arange(1, TRIED + 1)[:, None] * 0.6180339887498949 ** np.arange(1, directions + 1)) % 1.0
        points = np.atleast_1d(real(shape(s[:, 0] if directions == 1 else s)))
    if points.ndim != 2 or not len(points) or points.shape[1] % 2:
        raise InputError(
            f"a loop takes parameters (N,), a surface (N, 2k), to points (N, 2n), not to shape {points.shape}"
        )
    if not np.isfinite(points).all():
        raise InputError("the loop or surface has a point that is not finite")
    return points


def _evaluated(
    map: Transformation | Callable[..., Any],  # noqa: A002
    points: Array,
    parameters: Mapping[str, float] | None,
    scale: float,
) -> tuple[Callable[[Array], Array], float, float]:
    """The map of points (N, 2n), the scale of what it is given in, and the roundoff of its numbers."""
    from canon.mechanics.transformation import Transformation

    checked_valence(scale)
    parameters = checked_parameters(parameters)
    if not isinstance(map, Transformation):
        if parameters:
            raise InputError("a function has its parameters already; `parameters` are for formulas", "parameters")
        found = point_map(map, points)
        return found.evaluate, scale, found.unit
    if map.direction == "implicit" and map.generating_function is not None:
        return ImplicitMap(map.generating_function, parameters), scale, UNIT
    subject = formulas_as_map(map, parameters, scale)
    if points.shape[1] != len(subject.names):
        raise InputError(
            f"points of {len(subject.names)} coordinates are expected ({', '.join(subject.names)}), "
            f"not of {points.shape[1]}"
        )

    def evaluate(z: Array) -> Array:
        with double():
            return np.asarray(subject.function(z.T)).T

    return evaluate, subject.scale, UNIT
