"""In which form a function takes phase points: one point z, a pair (q, p), or many points at once."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import InputError, NoValue
from canon.expected import real_array
from canon.numeric.precision import UNIT, double, unit_of

Array = np.ndarray
TRIALS: Final = 16
MOST_TRIALS: Final = 256
"""So many points are tried before a map is said to have no value."""
ENOUGH: Final = 3
"""So many values of a function tell in which form it takes points."""

_THREE: Final = np.ones((3, 1))
EXPECTED: Final = "a map takes and returns one phase point z = (q_1…q_n, p_1…p_n), or a pair (q, p), or points (…, 2n)"
COMPLEX: Final = "the map returns complex numbers: an audit is of a real map"
WHOLE: Final = "the map returns whole numbers ({}), which have no derivatives: return floating-point numbers"
NO_NUMBERS: Final = {"O": "objects", "U": "texts", "S": "bytes", "M": "dates", "m": "spans of time"}
"""Kinds of arrays, by the letters of numpy, that a map may not return."""


class _WrongShape(Exception):
    """A value that is no phase point."""


@dataclass(frozen=True)
class PointMap:
    """A function as a map of phase points: `one` of a single point, `evaluate` of points (N, 2n), nan where it raises.

    A function may change its argument in place, or return the same array each time: it is given copies, and what it
    returns is copied. `single` says that it computes in float32, `steady` that a second evaluation gave what the first
    gave; `usable` are the indices of the tried points at which it has a value; `form` says how it takes points; `many`
    evaluates them at once, if it can; `said` tells what it raised first.
    """

    one: Callable[[Any], Any]
    evaluate: Callable[[Array], Array]
    unit: float
    steady: bool
    usable: Array
    form: str
    many: Callable[[Array], Array] | None
    said: Callable[[], str]


def point_map(function: Callable[..., Any], points: Array) -> PointMap:
    """The map of points that a function stands for; it is tried at a few of `points` (N, 2n).

    **Raises:** `InputError` where it raises at every point tried, or returns a wrong shape, complex or whole numbers.
    """
    if not callable(function):
        raise InputError(f"a map is a function or a transformation, not {type(function).__name__}; {EXPECTED}")
    form, one, results = _first_form(function, points)
    usable = [k for k, value in enumerate(results) if value is not None and np.all(np.isfinite(value))]
    if not usable:
        raise NoValue(f"the map has no finite value at any of {len(results)} points tried, as at {shown(points[0])}")
    found = [np.asarray(results[k]) for k in usable]
    if any(np.iscomplexobj(value) for value in found):
        raise InputError(COMPLEX)
    if all(value.dtype.kind in "iub" for value in found):
        raise InputError(WHOLE.format(found[0].dtype))
    steady = all(_repeats(one, points[k], value) for k, value in zip(usable, found, strict=True))
    unit = max([UNIT, *(unit_of(value.dtype) for value in found if value.dtype.kind == "f")])
    many = _vectorised(function, points[usable], np.stack(found)) if len(usable) > 1 else None
    first: list[str] = []

    def evaluate(z: Array) -> Array:
        with double():
            if many is not None:
                try:
                    return real_values(many(z.copy()))
                except Exception as reason:  # then point by point, to see where
                    first.append(f"{type(reason).__name__}: {reason}")
            values = np.full(z.shape, np.nan)
            for k, point in enumerate(z):
                try:
                    values[k] = real_values(one(point.copy()))
                except Exception as reason:  # a user's function may raise anything
                    first.append(f"{type(reason).__name__}: {reason}")
            del first[1:]
            return values

    return PointMap(one, evaluate, unit, steady, np.array(usable), form, many, lambda: first[0] if first else "")


def real_values(values: Any) -> Array:
    """A copy as floats, nan where a value is complex: a root may be real only on a part of the domain."""
    found: Any = np.asarray(values)
    if np.iscomplexobj(found):
        return np.where(found.imag == 0, found.real, np.nan)
    return np.array(found, dtype=float)


def _first_form(function: Callable[..., Any], points: Array) -> tuple[str, Callable[[Any], Any], list[Any]]:
    """The first form in which the function has values, with those at the first points, None where it raises.

    A map may be defined on a small part of the domain: where a few points show no value, more are tried.

    **Raises:** `InputError` where it raises at every point tried, or returns a wrong shape.
    """
    reasons: list[Exception] = []
    for trial in (points[:TRIALS], points[:MOST_TRIALS]):
        for form, one in forms(function, points.shape[1]):
            results, reason = _tried(one, trial)
            if reason is not None:
                reasons.append(reason)
            if any(value is not None for value in results):
                enough = any(value is not None and np.all(np.isfinite(value)) for value in results)
                return form, one, results if enough else _tried(one, points[:MOST_TRIALS])[0]
    wrong = next((reason for reason in reasons if isinstance(reason, _WrongShape)), None)
    if wrong is not None:
        raise InputError(f"{wrong}; {EXPECTED}") from wrong
    said = f"{type(reasons[0]).__name__}: {reasons[0]}"
    raise NoValue(f"the map raises at every point tried, for instance at {shown(points[0])}: {said}") from reasons[0]


def of_any_form(images: Callable[[Array], Array], arguments: tuple[Any, ...]) -> Any:
    """What a map of points (N, 2n) makes of one phase point (2n,), of points (…, 2n), or of a pair (q, p)."""
    if len(arguments) == 2:
        q, p = (real_array(part, name) for part, name in zip(arguments, ("q", "p"), strict=True))
        if q.shape != p.shape or not q.ndim:
            raise InputError(f"as many momenta as coordinates are expected, not shapes {q.shape} and {p.shape}", "q, p")
        new = of_any_form(images, (np.concatenate([q, p], axis=-1),))
        return new[..., : q.shape[-1]], new[..., q.shape[-1] :]
    if len(arguments) != 1:
        raise InputError(f"a map is called with a phase point, points, or a pair (q, p), not with {len(arguments)}")
    points = real_array(arguments[0], "z")
    if not points.ndim:
        raise InputError(f"a phase point is a list of numbers, not {points}", "z")
    return images(points.reshape(-1, points.shape[-1])).reshape(points.shape)


def forms(function: Callable[..., Any], size: int) -> list[tuple[str, Callable[[Any], Any]]]:
    """The ways in which the function may take a point, likely ones first: each as a name and a function of z (2n,).

    These functions raise where what is returned is no point.
    """
    n = size // 2

    def of_pair(z: Any) -> Any:
        return _point(function(z[:n], z[n:]), size)

    def of_point(z: Any) -> Any:
        return _point(function(z), size)

    def of_tuple(z: Any) -> Any:
        return _point(function((z[:n], z[n:])), size)

    def of_points(z: Any) -> Any:
        rows = function(z[None, :] * _THREE)
        if getattr(rows, "shape", None) != (3, size):
            raise _WrongShape("the map returns no points for points")
        return _point(rows[0], size)

    if required(function) == 2:
        return [("(q, p)", of_pair)]
    return [("z", of_point), ("((q, p))", of_tuple), ("(…, 2n)", of_points)]


def required(function: Callable[..., Any]) -> int:
    """How many arguments a function must be given; 1 where that can't be seen."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return 1
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(p.kind in positional and p.default is inspect.Parameter.empty for p in parameters)


def _point(value: Any, size: int) -> Any:
    """A returned value as one point of shape (2n,)."""
    if isinstance(value, (tuple, list)):
        if not value:
            raise _WrongShape("the map returns nothing")
        if any(type(part).__module__.startswith("jax") for part in value):
            import jax.numpy as numbers
        else:
            numbers = np
        value = numbers.concatenate([numbers.ravel(numbers.asarray(part)) for part in value])
    if getattr(value, "shape", None) != (size,):
        shape = getattr(value, "shape", None)
        what = f"an array of shape {shape}" if shape is not None else f"a {type(value).__name__}"
        raise _WrongShape(f"the map returns {what} for a point of shape ({size},)")
    dtype = getattr(value, "dtype", None)
    if isinstance(dtype, np.dtype) and dtype.kind in NO_NUMBERS:
        raise _WrongShape(f"the map returns an array of {NO_NUMBERS[dtype.kind]}")
    return value


def _tried(one: Callable[[Any], Any], trial: Array) -> tuple[list[Any], Exception | None]:
    results: list[Any] = []
    first: Exception | None = None
    with double():
        for point in trial:
            try:
                results.append(np.array(one(point.copy())))
            except Exception as reason:  # a user's function may raise anything
                results.append(None)
                first = first or reason
            if sum(value is not None and bool(np.all(np.isfinite(value))) for value in results) == ENOUGH:
                break
    return results, first


def _repeats(one: Callable[[Any], Any], point: Array, value: Array) -> bool:
    """Whether the function has the same value at a point once more."""
    with double():
        try:
            return np.array_equal(np.asarray(one(point.copy())), value, equal_nan=True)
        except Exception:  # a function with a memory may raise the second time
            return False


def _vectorised(function: Callable[..., Any], points: Array, expected: Array) -> Callable[[Array], Array] | None:
    """The function applied to many points at once, if that gives what it gives one by one."""
    count, size = points.shape
    n = size // 2
    if count in (n, size):  # a matrix of the other shape would pass for points
        points, expected = points[:2], expected[:2]
    if len(points) in (n, size):
        return None
    if required(function) == 2:

        def pair_rows(z: Array) -> Array:
            return np.concatenate([np.asarray(part) for part in function(z[:, :n], z[:, n:])], axis=1)

        def pair_columns(z: Array) -> Array:
            return np.concatenate([np.asarray(part) for part in function(z.T[:n], z.T[n:])], axis=0).T

        return _first_right((pair_rows, pair_columns), points, expected)

    def rows(z: Array) -> Array:
        return np.asarray(function(z))

    def columns(z: Array) -> Array:
        value = function(z.T)
        parts = [np.atleast_2d(part) for part in value] if isinstance(value, tuple) else [value]
        return np.concatenate(parts).T

    return _first_right((rows, columns), points, expected)


def _first_right(
    candidates: tuple[Callable[[Array], Array], ...], points: Array, expected: Array
) -> Callable[[Array], Array] | None:
    """The first that takes all points at once to what each of them is taken to."""
    for many in candidates:
        try:
            with double():
                value = many(points.copy())
        except Exception:  # not made for that
            continue
        if value.shape == expected.shape and np.allclose(value, expected, rtol=1e-13, atol=0):
            return many
    return None


def shown(point: Array) -> str:
    """A point's coordinates."""
    return "(" + ", ".join(f"{x:.6g}" for x in point) + ")"
