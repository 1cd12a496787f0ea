"""From a scene file to a scene. Nothing in a file is ever executed: it is text and tables, read as claims are."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

import sympy as sp

from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.scenes.assemble import Named, initial_state, model_of_bodies, model_of_system
from canon.scenes.bodies import read_bodies
from canon.scenes.effects import EFFECTS, LATER
from canon.scenes.effects.effect import Contribution, Given, Particle, Surroundings
from canon.scenes.identity import digest_of
from canon.scenes.monitors import check_monitors
from canon.scenes.own_hamiltonian import read_own_hamiltonian
from canon.scenes.rays import are_rays, names_rays, rays_of
from canon.scenes.scene import Body, Scene
from canon.scenes.settings import read_settings
from canon.scenes.systems import Placed, read_named_system
from canon.scenes.values import number
from canon.vocabulary import nearest

SECTIONS: Final = ("title", "dynamics", "units", "constants", "body", "rigid_body", "effect", "system", "run")
DYNAMICS: Final = ("newtonian", "relativistic")
TIME: Final = sp.Symbol("t", real=True)


def read_scene(path: str | os.PathLike[str]) -> Scene:
    """The scene in a file. **Raises:** `InputError` with the place in it."""
    return scene_of(document.load(path))


def read_scene_text(text: str) -> Scene:
    """The scene in a document that is given as text. **Raises:** `InputError`."""
    return scene_of(document.parse(text))


def scene_of(tables: Table) -> Scene:
    """The scene in a TOML document. **Raises:** `InputError` with the place."""
    document.only(tables, SECTIONS, "")
    title, units = (document.text(tables.get(word, ""), key(word)) for word in ("title", "units"))
    if "run" not in tables:
        raise InputError("the section [run] is missing: it says for how long, as in duration = 10.0")
    settings = read_settings(tables["run"])
    if "rigid_body" in tables:
        raise InputError("rigid bodies are not available in this version", "rigid_body")
    if "system" in tables and "body" in tables:
        raise InputError("both [system] and [[body]] are given: a scene has one of them")
    if "system" not in tables and "body" not in tables:
        raise InputError("nothing moves here: add [[body]] with a mass and a position, or [system]")
    relativistic = _relativistic(tables)
    constants = {
        document.name(name, key(name, "[constants]")): number(value, key(name, "[constants]"))
        for name, value in document.table(tables.get("constants", {}), "[constants]").items()
    }
    if "system" in tables:
        if relativistic:
            raise InputError("relativistic dynamics are those of bodies: a system states its own H", key("dynamics"))
        placed = _placed(document.table(tables["system"], "[system]"))
        model, q, p = placed.model, placed.q, placed.p
        settings = replace(settings, start=placed.start)
        whole = Particle("system", model.q, model.p, None)
        effects = read_effects(tables.get("effect", []), Surroundings((whole,), constants, model.t, is_system=True))
        model, bodies = model_of_system(model, effects), ()
    else:
        starts = read_bodies(tables["body"], names_rays(tables.get("effect")))
        particles = tuple(start.particle for start in starts)
        surroundings = Surroundings(particles, constants, TIME, relativistic)
        effects = read_effects(tables.get("effect", []), surroundings)
        rays = are_rays(effects)
        if rays:
            model, (q, p), begin = rays_of(starts, surroundings, effects)
            settings = replace(settings, start=begin)
        else:
            model = model_of_bodies(surroundings, effects)
            start = initial_state(starts, surroundings, effects)
            q, p = start.q, start.p
        bodies = tuple(
            Body(body.name, body.mass, body.charge, k * (body.dimension - rays), body.dimension, rays)
            for k, body in enumerate(particles)
        )
    check_monitors(settings.monitors, model, key("monitor", "[run]"))
    absent = tuple(kind for kind in EFFECTS if kind not in {name for name, _ in effects})
    return Scene(title, model, q, p, settings, bodies, units, absent, digest=digest_of(tables))


def _placed(table: Table) -> Placed:
    """A system of the catalogue, or one of the user's own."""
    if "name" in table:
        return read_named_system(table)
    if not {"H", "q_names", "p_names"} & {*table}:
        raise InputError(
            "a 'name' of the catalogue is expected, or a Hamiltonian H with q_names and p_names", "[system]"
        )
    return Placed(*read_own_hamiltonian(table))


def _relativistic(tables: Table) -> bool:
    word = document.text(tables.get("dynamics", "newtonian"), key("dynamics"))
    if word not in DYNAMICS:
        advice = nearest(word, DYNAMICS) or f": it is {' or '.join(map(repr, DYNAMICS))}"
        raise InputError(f"unknown dynamics {word[:80]!r}{advice}", key("dynamics"))
    return word == "relativistic"


def read_effects(value: Any, surroundings: Surroundings) -> Sequence[Named]:
    """The contributions of the effects that are named, in their order. **Raises:** `InputError` with the place."""
    if isinstance(value, dict):
        raise InputError("effects are a list: write [[effect]], in double brackets", "effect")
    found = list[Named]()
    for index, item in enumerate(document.listing(value, "effect"), 1):
        where = f"effect {index}"
        table = document.table(item, where)
        if "kind" not in table:
            raise InputError("the key 'kind' is missing", where)
        kind = document.text(table["kind"], key("kind", where))
        found.append((kind, _contribution(kind, table, surroundings, where)))
    return found


def _contribution(kind: str, table: Table, surroundings: Surroundings, where: str) -> Contribution:
    if kind in LATER:
        raise InputError(f"the effect {kind!r} is not available in this version", key("kind", where))
    if kind not in EFFECTS:
        advice = nearest(kind, (*EFFECTS, *LATER)) or f": the effects are {', '.join(EFFECTS)}"
        raise InputError(f"unknown effect {kind[:80]!r}{advice}", key("kind", where))
    effect = EFFECTS[kind]
    place = f"{where}, {kind}"
    document.only(table, ("kind", *effect.parameters, *(() if surroundings.is_system else ("bodies",))), place)
    if surroundings.is_system and not effect.on_systems:
        raise InputError(f"the effect {kind!r} acts on bodies, not on a system in its own coordinates", place)
    return effect.add(Given(table, surroundings, place))
