"""Which scene a stored run is of: what tells a scene from others, whatever its title, monitors and place on disk."""

from __future__ import annotations

import hashlib
import json
from typing import Any, Final

from canon.claims.document import Table
from canon.errors import InputError
from canon.scenes.scene import Scene

FREE: Final = ("title", "units", "run")
"""The sections that say nothing of the motion; the settings in [run] are compared one by one."""


def digest_of(tables: Table) -> str:
    """A digest of what moves: all sections but `FREE`, their keys in any order."""
    moving = {name: value for name, value in tables.items() if name not in FREE}
    return hashlib.sha256(json.dumps(moving, sort_keys=True, default=str).encode()).hexdigest()


def identity_of(scene: Scene, integrator: str) -> dict[str, Any]:
    """What a run must share with the one that it goes on with."""
    settings = scene.settings
    return {
        "scene": scene.digest,
        "duration": settings.duration,
        "samples": settings.samples,
        "accuracy": settings.accuracy,
        "step": settings.step,
        "integrator": integrator,
    }


def check_same(stored: Any, wanted: dict[str, Any]) -> None:
    """Refuse to go on with the run of another scene, or of other settings. **Raises:** `InputError`."""
    if not isinstance(stored, dict) or stored.keys() != wanted.keys():
        raise InputError("it does not say which scene it is of")
    if stored["scene"] != wanted["scene"]:
        raise InputError("it is the run of another scene: its bodies, effects or system are not these")
    for name, value in wanted.items():
        if stored[name] != value:
            before, now = (_shown(name, each) for each in (stored[name], value))
            raise InputError(
                f"it was begun with {before}, and this is {now}: give what it was begun with, or begin anew"
            )


def _shown(name: str, value: Any) -> str:
    return f"no {name}" if value is None else f"{name} {str(value)[:40]}"
