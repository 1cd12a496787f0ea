"""Maps that depend on time, or change it: functions of a phase point and its time, of many points and their times."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import real_array
from canon.numeric.precision import double

Array = Any  # numpy arrays
EXPECTED: Final = "a map of states takes a phase point z of shape (2n,) and its time t, and returns Z, or (Z, T)"
TRIALS: Final = 3


def timed_map(function: Callable[..., Any], states: Array) -> Callable[[Array], Array]:
    """The map of states (N, 2n+1), the time last, that a function of (z, t) stands for; tried at some of `states`.

    The function returns Z at the same time, or a pair (Z, T). It may take points (N, 2n) and times (N,) at once.

    **Raises:** `InputError` where it returns another shape; what it raises itself is not caught.
    """
    size = states.shape[1] - 1

    def one(state: Array) -> Array:
        return _state(function(state[:size].copy(), float(state[size])), state[size], size)

    def singly(z: Array) -> Array:
        with double():
            return np.stack([one(state) for state in z])

    def at_once(z: Array) -> Array:
        with double():
            return _states(function(z[:, :size].copy(), z[:, size].copy()), z[:, size], size)

    trial = states[:: max(1, len(states) // TRIALS)][:TRIALS]
    expected = singly(trial)
    try:
        together = len(trial) != size and np.allclose(at_once(trial), expected, rtol=1e-13, atol=0)
    except Exception:  # a function of single points may raise anything when it is given several
        together = False
    return at_once if together else singly


def timed_function(function: Callable[..., Any], states: Array) -> Callable[[Array], Array]:
    """The function of states (N, 2n+1) with values (N,) that a function of (z, t), such as a Hamiltonian, stands for.

    **Raises:** `InputError` where its values are no real numbers.
    """
    size = states.shape[1] - 1

    def one(state: Array) -> float:
        value = real_array(function(state[:size].copy(), float(state[size])), "H, K")
        if value.size != 1:
            raise InputError(f"a Hamiltonian is a real number at a state (z, t), not an array of shape {value.shape}")
        return float(value.reshape(()))

    def values(z: Array) -> Array:
        with double():
            return np.array([one(state) for state in z])

    values(states[:1])
    return values


def _state(value: Any, t: float, size: int) -> Array:
    Z, T = value if isinstance(value, tuple) and len(value) == 2 else (value, t)
    point, time = real_array(Z, "map"), real_array(T, "map")
    if point.shape != (size,) or time.size != 1:
        raise InputError(f"{EXPECTED}: not an array of shape {point.shape} for a point of shape ({size},)")
    return np.append(point, float(time.reshape(())))


def _states(value: Any, t: Array, size: int) -> Array:
    Z, T = value if isinstance(value, tuple) and len(value) == 2 else (value, t)
    points = real_array(Z, "map")
    if points.shape != (len(t), size):
        raise InputError(EXPECTED)
    return np.column_stack([points, np.broadcast_to(real_array(T, "map"), len(t))])
