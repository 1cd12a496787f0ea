"""The monitors, each computed only when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.interruption import Late, interruptible
from canon.scenes.monitors.arcs import read_arcs
from canon.scenes.monitors.beside import read_beside
from canon.scenes.monitors.charges import read_charges
from canon.scenes.monitors.conserved import read_conserved
from canon.scenes.monitors.constraint import read_constraint
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.jerks import read_jerked
from canon.scenes.monitors.loop import read_cartan, read_loop
from canon.scenes.monitors.predicted import not_hamiltonian
from canon.scenes.monitors.reading import Reading
from canon.scenes.monitors.reversal import read_reversibility
from canon.scenes.monitors.tangent import read_symplecticity, read_volume

__all__ = ["AVAILABLE", "Flow", "Reading", "check_monitors", "read_monitors"]


def _of(name: str, quantities: Callable[[Any], Any]) -> Callable[..., Reading]:
    return lambda flow, times, q, p: read_conserved(name, quantities(flow.model), flow, times, q, p)


AVAILABLE: Final[dict[str, Callable[..., Reading]]] = {
    "energy": _of("energy", lambda model: {"H": model.H}),
    "momentum": _of("momentum", lambda model: model.momenta),
    "angular_momentum": _of("angular_momentum", lambda model: model.angular_momenta),
    "lrl": _of("lrl", lambda model: model.lrl),
    "casimir": _of("casimir", lambda model: model.casimirs),
    "symplecticity": read_symplecticity,
    "volume": read_volume,
    "loop": read_loop,
    "cartan": read_cartan,
    "reversibility": read_reversibility,
    "constraint": read_constraint,
    "charges": read_charges,
}
"""The monitors of this version: (flow, times, q, p) to a reading."""

_UNDONE: Final = ("symplecticity", "volume", "loop", "cartan", "reversibility")
_NEEDS: Final = {
    "momentum": "a scene of bodies, or a system that names its momenta",
    "angular_momentum": "positions in a plane or in space",
    "lrl": "one body that is attracted by inverse_distance, or two by mutual_gravity",
    "casimir": "a rigid body",
}


def check_monitors(names: Sequence[str], model: Any, where: str) -> None:
    """Refuse monitors that this scene, or this version, has not got. **Raises:** `InputError`."""
    for name in names:
        if name == "charges" and model.gliders:
            raise InputError("the monitor 'charges' needs a Poisson bracket, and a body on a skate has none", where)
        if name == "constraint" and not model.constraints:
            raise InputError("the monitor 'constraint' needs a constraint: a rod, a string or a surface", where)
        quantities = {
            "momentum": model.momenta,
            "angular_momentum": model.angular_momenta,
            "lrl": model.lrl,
            "casimir": model.casimirs,
        }
        if name in quantities and not quantities[name]:
            raise InputError(f"the monitor {name!r} needs {_NEEDS[name]}", where)


def read_monitors(
    names: Sequence[str], flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray, until: float | None = None
) -> tuple[Reading, ...]:
    """The readings of the monitors of these names: of the first ones, where somebody presses Ctrl-C, or of those that
    are there at the time `until`.
    """
    found = list[Reading]()
    try:
        for name in names:
            found.append(interruptible(partial(_reading_or_none, name, flow, times, q, p), until))
    except (KeyboardInterrupt, Late):
        pass
    return tuple(found)


def _reading_or_none(name: str, flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """The reading; where what has to be computed for it is beyond double precision, one that says so."""
    try:
        with np.errstate(all="ignore"):
            return _reading(name, flow, times, q, p)
    except (np.linalg.LinAlgError, ArithmeticError):
        note = "what it is computed from is beyond double precision"
        return Reading(name, "unknown", None, None, None, extra={"note": note})


def _reading(name: str, flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    if name in _UNDONE and not flow.followed:
        broken = not_hamiltonian(flow.model)
        note = f"the steps of {flow.method.name} are not ours to follow neighbours with: leave the integrator out"
        return Reading(name, f"broken by {broken}" if broken else "conserved", None, None, None, extra={"note": note})
    if flow.model.beside and name in _UNDONE:
        return read_beside(partial(_reading, name), flow, times, q, p)
    if flow.model.strings and name in _UNDONE:
        return replace(read_arcs(AVAILABLE[name], flow, times, q, p), name=name)
    if flow.model.strings and name == "energy":
        return read_jerked(flow, times, q, p)
    return AVAILABLE[name](flow, times, q, p)
