"""The actions, frequencies and angles of a scene at its initial state, or of an orbit that is named by its energy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from canon.errors import InputError
from canon.numeric.actions.bounded import Bounded, bounded
from canon.numeric.actions.motion import motion
from canon.scenes.degrees import Degree, degrees_of
from canon.scenes.scene import Scene


@dataclass(frozen=True)
class Actions:
    """What `canon actions` shows: the degrees of freedom of a Hamiltonian at a point, and in words how it separates."""

    title: str
    H: Any
    energy: Bounded
    degrees: tuple[Degree, ...]
    how: str


def actions_of_scene(scene: Scene, named: Mapping[str, Any] | None = None) -> Actions:
    """The actions of a scene. `named` are arguments of `Motion.orbit`, which then chooses the orbit, not the state.

    **Raises:** `InputError` where the scene is no bounded, separable Hamiltonian motion.
    """
    model = scene.model
    if model.brackets:
        raise InputError(
            "the state of rigid bodies and of skates is not (q, p): a top has actions as the system free_symmetric_top "
            "or heavy_symmetric_top"
        )
    if model.frictions:
        effects = ", ".join(friction.effect for friction in model.frictions)
        raise InputError(f"{effects}: with friction there are no actions", "effect")
    if model.constraints:
        raise InputError(
            "bodies on constraints have no canonical coordinates here: state a system with its own", "effect"
        )
    if model.t in model.H.free_symbols:
        raise InputError("H depends on the time: its motion has no constant energy, and no actions", "[system]")
    return actions_of(scene.title, model.H, model.q, model.p, scene.q, scene.p, named)


def actions_of(
    title: str, H: Any, q: tuple[Any, ...], p: tuple[Any, ...], at_q: Any, at_p: Any, named: Mapping[str, Any] | None
) -> Actions:
    """The same for a Hamiltonian with numbers for all parameters, and a phase point or the name of an orbit."""
    if not named:
        degrees, how = degrees_of(H, q, p, at_q, at_p)
        from canon.numeric.actions.balls import ball_function, precision

        with precision(256):
            energy = bounded(ball_function(H, (*q, *p))(*at_q, *at_p))
        return Actions(title, H, energy, degrees, how)
    if len(q) != 1:
        raise InputError(f"an orbit is named by its energy with one degree of freedom, not with {len(q)}", "--energy")
    moved = motion(H, q[0], p[0])
    orbit = moved.orbit(**named)
    degree = Degree(str(q[0]), orbit.action, orbit.frequency, orbit.angle, orbit, moved)
    return Actions(title, H, orbit.energy, (degree,), "one degree of freedom")
