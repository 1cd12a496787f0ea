"""Point bodies: their tables in a scene file, and their symbols."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import sympy as sp

from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.scenes.effects.effect import AXES, Particle
from canon.scenes.model import Formula
from canon.scenes.values import needed, number, numbers

KEYS: Final = ("name", "mass", "charge", "position", "velocity", "momentum")
MOST: Final = 1000


@dataclass(frozen=True)
class Start:
    """A particle with its initial place, and its velocity or its canonical momentum."""

    particle: Particle
    position: tuple[Formula, ...]
    velocity: tuple[Formula, ...] | None
    momentum: tuple[Formula, ...] | None


def read_bodies(value: Any, rays: bool = False) -> tuple[Start, ...]:
    """The bodies of a scene, which need no mass where they are `rays`. **Raises:** `InputError` with the place."""
    if isinstance(value, dict):
        raise InputError("bodies are a list: write [[body]], in double brackets", "body")
    tables = document.listing(value, "body", document.BIGGEST)
    if not 1 <= len(tables) <= MOST:
        raise InputError(f"{len(tables)} bodies: a scene has from 1 to {MOST}", "body")
    starts = list[Start]()
    for index, item in enumerate(tables):
        where = f"body {index + 1}"
        start = _body(document.table(item, where), where, index, len(tables), rays)
        first = starts[0] if starts else start
        if len(start.position) != len(first.position):
            raise InputError(
                f"{len(start.position)} components, and the first body has {len(first.position)}",
                key("position", where),
            )
        if any(start.particle.name == other.particle.name for other in starts):
            raise InputError(f"there are two bodies {start.particle.name!r}", key("name", where))
        starts.append(start)
    return tuple(starts)


def _body(table: Table, where: str, index: int, count: int, ray: bool) -> Start:
    document.only(table, KEYS, where)
    name = document.text(table.get("name", f"body{index + 1}"), key("name", where))
    if not 0 < len(name) <= 80 or not name.isprintable() or set(name) & set("/\\"):
        raise InputError(
            "a name of 1 to 80 characters is expected, none of them / or \\ or invisible", key("name", where)
        )
    position = numbers(needed(table, "position", where), key("position", where), (1, 2, 3))
    if "velocity" in table and "momentum" in table:
        raise InputError("both 'velocity' and 'momentum' are given", where)
    given = {
        word: numbers(table[word], key(word, where), [len(position)]) if word in table else None
        for word in ("velocity", "momentum")
    }
    if given["velocity"] is None and given["momentum"] is None:
        given["velocity"] = (sp.S.Zero,) * len(position)
    suffix = "" if count == 1 else str(index + 1)
    x, p = (
        tuple(sp.Symbol(f"{word}{axis}{suffix}", real=True) for axis in AXES[: len(position)]) for word in ("", "p")
    )
    given_mass = table.get("mass", 1) if ray else needed(table, "mass", where)
    mass = number(given_mass, key("mass", where), positive=True)
    charge = number(table["charge"], key("charge", where)) if "charge" in table else None
    return Start(Particle(name, x, p, mass, charge), position, given["velocity"], given["momentum"])
