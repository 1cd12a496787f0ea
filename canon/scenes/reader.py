"""From a scene file to a scene. Nothing in a file is ever executed: it is text and tables, read as claims are."""

from __future__ import annotations

import os
from typing import Final

from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.scenes.monitors import check_monitors
from canon.scenes.own_hamiltonian import read_own_hamiltonian
from canon.scenes.scene import Scene
from canon.scenes.settings import read_settings

SECTIONS: Final = ("title", "dynamics", "units", "constants", "body", "rigid_body", "effect", "system", "run")


def read_scene(path: str | os.PathLike[str]) -> Scene:
    """The scene in a file. **Raises:** `InputError` with the place in it."""
    return scene_of(document.load(path))


def read_scene_text(text: str) -> Scene:
    """The scene in a document that is given as text. **Raises:** `InputError`."""
    return scene_of(document.parse(text))


def scene_of(tables: Table) -> Scene:
    """The scene in a TOML document. **Raises:** `InputError` with the place."""
    document.only(tables, SECTIONS, "")
    title = document.text(tables.get("title", ""), key("title"))
    units = document.text(tables.get("units", ""), key("units"))
    if "run" not in tables:
        raise InputError("the section [run] is missing: it says for how long, as in duration = 10.0")
    settings = read_settings(tables["run"])
    if "system" not in tables:
        raise InputError("nothing moves here: add [system]")
    table = document.table(tables["system"], "[system]")
    model, q, p = read_own_hamiltonian(table)
    check_monitors(settings.monitors, model, key("monitor", "[run]"))
    return Scene(title, model, q, p, settings, units=units)
