"""A scene as it is read: what moves, from where, and how the run is to be made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from canon.numeric.engines import Engine
from canon.scenes.model import Model

DEFAULT_ACCURACY: Final = 1e-9
DEFAULT_SAMPLES: Final = 200
MOST_SAMPLES: Final = 1_000_000

MONITORS: Final = (
    "energy", "momentum", "angular_momentum", "lrl", "casimir", "symplecticity", "volume", "loop", "cartan",
    "reversibility", "constraint", "charges",
)  # fmt: skip
"""The monitors of the format."""


@dataclass(frozen=True)
class Settings:
    """How a scene is run: to an `accuracy`, or with a fixed `step`, or as exactly as `budget` seconds allow.

    Time begins at `start`. With `compare` every candidate for an integrator is tried, however short the run. `engine`
    computes the steps.
    """

    duration: float
    accuracy: float | None = DEFAULT_ACCURACY
    step: float | None = None
    budget: float | None = None
    integrator: str | None = None
    samples: int = DEFAULT_SAMPLES
    monitors: tuple[str, ...] = ()
    start: float = 0.0
    compare: bool = False
    engine: Engine = "auto"


@dataclass(frozen=True)
class Body:
    """A point particle: its `name`, and where its coordinates stand among all of them.

    The last coordinate of a ray is none of them, but the time.
    """

    name: str
    mass: Any
    charge: Any | None
    first: int
    dimension: int
    ray: bool = False

    @property
    def columns(self) -> slice:
        """Its coordinates among all of them."""
        return slice(self.first, self.first + self.dimension - self.ray)


@dataclass(frozen=True)
class Scene:
    """A model, its initial state (`q`, `p` as floats), and the settings; `bodies` are empty for a system.

    `digest` tells what moves, and how, from what moves in other scenes, whatever the settings. `own` are a system's own
    names for its state, with their formulas.
    """

    title: str
    model: Model
    q: tuple[float, ...]
    p: tuple[float, ...]
    settings: Settings
    bodies: tuple[Body, ...] = ()
    units: str = ""
    absent: tuple[str, ...] = ()
    notes: Mapping[str, str] = field(default_factory=dict)
    digest: str = ""
    own: Mapping[str, Any] = field(default_factory=dict)
