"""Loops in the extended phase space, where the time is a coordinate and −H its momentum.

p dq − H dt is there the canonical one-form Σ p dq + p_t dt with p_t = −H, so that a loop of states at different times
is a loop like any other. Arnold (1989), section 45.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import function
from canon.mechanics.formulas import as_formula
from canon.numeric.loops import real
from canon.numeric.lower import lower_map
from canon.numeric.precision import double
from canon.numeric.timed_map import timed_function, timed_map

if TYPE_CHECKING:
    from canon.mechanics.transformation import Transformation

Array = Any  # numpy arrays
TRIED: Final = 8


def extended(
    map: Transformation | Callable[..., Any],  # noqa: A002 - the field's own word
    loop: Callable[[Array], Array] | Array,
    H: Any,
    K: Any,
    parameters: Mapping[str, float],
) -> tuple[Callable[[Array], Array], Callable[[Array], Array] | Array]:
    """The map, and the loop, as those of the extended phase space (q, t; p, −H): points (N, 2n+2).

    **Raises:** `InputError` for states of a wrong shape, a map not given forward, a parameter without a value.
    """
    states = _states(real(loop(np.arange(TRIED) / TRIED) if callable(loop) else loop))
    moved, energy, new_energy = _of_functions(map, states, H, K, parameters)

    def lift(z: Array, energies: Array) -> Array:
        n = (z.shape[1] - 1) // 2
        return np.column_stack([z[:, :n], z[:, -1], z[:, n : 2 * n], -energies])

    def lower(x: Array) -> Array:
        n = (x.shape[1] - 2) // 2
        return np.column_stack([x[:, :n], x[:, n + 1 : 2 * n + 1], x[:, n]])

    def evaluate(x: Array) -> Array:
        image = moved(lower(x))
        return lift(image, new_energy(image))

    if not callable(loop):
        return evaluate, lift(states, energy(states))

    def lifted(s: Array) -> Array:
        z = _states(real(loop(s)))
        return lift(z, energy(z))

    return evaluate, lifted


def _states(z: Array) -> Array:
    if z.ndim != 2 or z.shape[1] < 3 or z.shape[1] % 2 == 0:
        raise InputError(f"a loop of states takes parameters (N,) to (N, 2n+1), the time last, not to shape {z.shape}")
    if not np.all(np.isfinite(z)):
        raise InputError("the loop has a state that is not finite")
    return z


def _of_functions(
    map: Transformation | Callable[..., Any],  # noqa: A002
    states: Array,
    H: Any,
    K: Any,
    parameters: Mapping[str, float],
) -> tuple[Callable[[Array], Array], Callable[[Array], Array], Callable[[Array], Array]]:
    """The map of states, H of old and K of new ones, all as functions of arrays."""
    from canon.mechanics.transformation import Transformation

    if not isinstance(map, Transformation):
        if parameters:
            raise InputError("a function has its parameters already; `parameters` are for formulas", "parameters")
        for given, name in ((map, "map"), (H, "H"), (K, "K")):
            function(given, "a map" if name == "map" else "beside a map that is a function, a Hamiltonian", name)
        moved = timed_map(map, states)
        return moved, timed_function(H, states), timed_function(K, moved(states[:1]))
    if map.direction != "forward":
        raise InputError("a transformation given as new in terms of old is needed here: pass its .forward()", "map")
    space = map.space
    known = {symbol.name: symbol for symbol in space.parameters}
    for name in parameters:
        if name not in known:
            raise InputError(f"{name!r} is no parameter", "parameters")
    values = {known[name]: value for name, value in parameters.items()}

    def lowered(expressions: Any, variables: Any) -> Callable[[Array], Array]:
        function = lower_map(expressions, (*variables, space.t), values)

        def evaluate(z: Array) -> Array:
            with double():
                return np.asarray(function(z.T)).T

        return evaluate

    image = lowered(map.expressions, space.old)
    energies = []
    for energy, variables in ((H, space.old), (K, space.new)):
        if callable(energy):
            energies.append(timed_function(energy, states))
        else:
            evaluate = lowered((as_formula(energy).expr,), variables)
            energies.append(lambda z, evaluate=evaluate: evaluate(z)[:, 0])
    return lambda z: np.column_stack([image(z), z[:, -1]]), energies[0], energies[1]
