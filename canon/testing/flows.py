"""The flow of a Hamiltonian: what must hold of a function (z, t) that claims to be one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import finite_number, function, listed, real_array, table, whole_number
from canon.testing.assertions import name_of, place_of

if TYPE_CHECKING:
    from canon.mechanics.hamiltonian import Hamiltonian

Array = np.ndarray

ULPS: Final = 64
"""So many roundings, over the step of a difference, are granted to a rate of change."""


def assert_hamiltonian_flow(
    flow: Callable[[Array, float], Any],
    hamiltonian: Hamiltonian | Callable[[Any], Any],
    *,
    dimension: int,
    times: Sequence[float] = (0.1, 1.0),
    domain: Any = None,
    samples: int = 20,
    seed: int = 0,
    tolerance: float = 0.0,
    parameters: Mapping[str, float] | None = None,
) -> None:
    """A function flow(z, t) is the flow of H: it starts at z, its velocity is J ∇H, and at each time it is symplectic.

    **Arguments:** `flow(z, t)` takes a phase point (2n,) and a time to a phase point; the `hamiltonian`, a
    `Hamiltonian` that doesn't depend on time (`parameters` gives its parameters' values), or a function of z; the
    `times` at which to look; `domain`, `samples` and `seed` as for `audit`; `tolerance`, how much more than rounding is
    granted, relative to the sizes of velocities, of brackets, and of the variables' ranges: a flow by an integrator has
    its error.

    **Raises:** `AssertionError` with what fails, where, and by how much; what the flow itself raises.
    """
    from canon.claims.audit import variables
    from canon.numeric.differences import central_differences
    from canon.numeric.points import DEFAULT, MOST_POINTS, points_of
    from canon.numeric.precision import UNIT, double

    names = variables(dimension)
    function(flow, "a flow", "flow")
    samples = whole_number(samples, "samples", 1, MOST_POINTS)
    finite_number(tolerance, "tolerance", least=0.0)
    moments_at = listed(times, "times at which to look", "times")
    for t in moments_at:
        finite_number(t, "times")
    moments_at = tuple(float(t) for t in moments_at)
    if not moments_at:
        raise InputError("at least one time at which to look is needed", "times")
    where = points_of(domain, names, [DEFAULT] * dimension)
    points = np.concatenate(list(where.blocks(samples, samples, seed)))
    lengths = where.lengths
    called = name_of(flow)

    def at(times: Array) -> Array:
        with double():
            found = [np.array(real_array(flow(z.copy(), float(t)), "flow")) for z, t in zip(points, times, strict=True)]
        for values in found:
            if values.shape != (dimension,):
                said = f"a flow takes a phase point z and t to a phase point: of {(dimension,)} it makes {values.shape}"
                raise InputError(said, "flow")
        return np.array(found)

    began = np.abs(at(np.zeros(len(points))) - points) / lengths
    allowed = ULPS * UNIT * (1 + np.abs(points) / lengths) + tolerance
    _check(began, allowed, points, names, f"{called} doesn't start where it should at t = 0")

    field = _field(hamiltonian, dimension, parameters, lengths)
    for t in moments_at:
        moments = np.full((len(points), 1), float(t))
        reached = at(moments[:, 0])
        velocity, off = field(reached)
        speed = np.abs(velocity).max(axis=0)
        length = np.array([min(max(abs(float(t)), 0.1), _while_it_moves(reached, speed, lengths))])
        noise = UNIT * abs(float(t)) * speed  # as a time, or a phase, is rounded
        rate, error = central_differences(lambda s: at(s[:, 0]), moments, length, UNIT, noise=noise)
        size = np.abs(rate[:, :, 0] - velocity)
        bound = error[:, :, 0] + off + tolerance * np.maximum(np.abs(velocity), speed)
        what = f"{called} is not the flow of this Hamiltonian: at t = {t:g} its velocity isn't J ∇H"
        _check(size, bound, points, names, what)
        _check_symplectic(flow, float(t), points, tolerance, called)


def _while_it_moves(reached: Array, speed: Array, lengths: Array) -> float:
    """The time in which some variable runs through its range: differences over many turns see none of them."""
    ranges = np.ptp(reached, axis=0)
    with np.errstate(all="ignore"):
        times = np.where(ranges > 0, ranges, lengths) / speed
    return float(np.min(times, where=np.isfinite(times) & (times > 0), initial=np.inf))


def _check(sizes: Array, bounds: Array, points: Array, names: Sequence[str], what: str) -> None:
    """Raise unless sizes (N, 2n) keep to their bounds; where they don't most, say so."""
    bad = ~(sizes <= bounds)
    if not bad.any():
        return
    with np.errstate(all="ignore"):
        excess = np.where(bad, np.nan_to_num(sizes / bounds, nan=np.inf), -1.0)
    row, column = divmod(int(np.argmax(excess)), excess.shape[1])
    raise AssertionError(
        f"{what}: {names[column]} is off by {sizes[row, column]:.3g}, bound {bounds[row, column]:.2g}, "
        f"from {place_of(names, points[row])}"
    )


def _check_symplectic(flow: Callable[..., Any], t: float, points: Array, tolerance: float, called: str) -> None:
    from canon.claims.audit import audit

    report = audit(lambda z: flow(z, t), dimension=points.shape[1], domain=points)
    bad = [defect for defect in report.brackets.values() if defect.exceeds and not defect.largest <= tolerance]
    if bad:
        worst = max(bad, key=lambda defect: defect.largest)
        raise AssertionError(
            f"{called} is not symplectic at t = {t:g}: {worst.label} is off by {worst.size:.3g}, "
            f"bound {worst.bound:.2g}, from {report.at(worst)}"
        )
    if report.doubts:
        raise AssertionError(f"{called} at t = {t:g} could not be audited: {'; '.join(report.doubts)}")


def _field(
    hamiltonian: Hamiltonian | Callable[[Any], Any],
    dimension: int,
    parameters: Mapping[str, float] | None,
    lengths: Array,
) -> Callable[[Array], tuple[Array, Array]]:
    """J ∇H at points (N, 2n), and how far it may be off: exact formulas, or differences of a function."""
    from canon.mechanics.hamiltonian import Hamiltonian
    from canon.numeric.differences import central_differences
    from canon.numeric.precision import UNIT, double

    n = dimension // 2
    if isinstance(hamiltonian, Hamiltonian):
        if parameters is not None:
            table(parameters, "numbers", "parameters")
        return _lowered(hamiltonian, dimension, parameters or {})
    if not callable(hamiltonian):
        raise InputError(f"a Hamiltonian, or a function of z, is expected, not {type(hamiltonian).__name__}")

    def of_points(points: Array) -> Array:
        with double():
            values = [real_array(hamiltonian(z), "hamiltonian") for z in points]
        if values and values[0].size != 1:
            raise InputError(f"a Hamiltonian is a number, not an array of shape {values[0].shape}", "hamiltonian")
        return np.array([[value.item()] for value in values])

    def field(points: Array) -> tuple[Array, Array]:
        gradient, error = central_differences(of_points, points, lengths, UNIT)
        slope, off = gradient[:, 0], error[:, 0]
        turned = np.concatenate([slope[:, n:], -slope[:, :n]], axis=1)
        return turned, np.concatenate([off[:, n:], off[:, :n]], axis=1)

    return field


def _lowered(
    hamiltonian: Hamiltonian, dimension: int, parameters: Mapping[str, float]
) -> Callable[[Array], tuple[Array, Array]]:
    from canon.numeric.lower import lower_map
    from canon.numeric.precision import UNIT, double

    space = hamiltonian.space
    if 2 * space.n != dimension:
        raise InputError(f"H has {space.n} degrees of freedom, the flow {dimension // 2}", "dimension")
    values = {space.symbol(name): float(value) for name, value in parameters.items()}
    qdot, pdot = hamiltonian.equations()
    mapped = lower_map((*qdot, *pdot), space.old, values)

    def field(points: Array) -> tuple[Array, Array]:
        with double():
            found = np.asarray(mapped(np.asarray(points.T)), dtype=float).T
        return found, ULPS * UNIT * (np.abs(found) + np.abs(found).max(axis=0))

    return field
