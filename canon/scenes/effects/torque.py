"""An external torque on a rigid body, K in Euler's equations. It has no potential, and is in no Hamiltonian."""

from __future__ import annotations

from typing import Final

from canon.scenes.effects.effect import Contribution, Effect, Given

FRAMES: Final = ("body", "space")


def _add(given: Given) -> Contribution:
    frame = given.table.get("frame", "body")
    if frame not in FRAMES:
        raise given.fail(f"the frame is 'body' or 'space', not {str(frame)[:80]!r}", "frame")
    K = given.vector("K", 3)
    return Contribution(torques={body.name: K if frame == "body" else body.to_body(K) for body in given.rigid})


EFFECT: Final = Effect(
    "torque",
    "external torque K(t) on a rigid body, in the body's frame, or in space",
    ("K", "frame"),
    ("energy", "angular_momentum", "casimir", "symplecticity", "loop", "cartan"),
    _add,
    optional=("frame",),
    hamiltonian=False,
    on_rigid=True,
)
