"""From a scene file to a scene. Nothing in a file is ever executed: it is text and tables, read as claims are."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final, NamedTuple

import sympy as sp

from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.scenes.assemble import Named, initial_state, model_of_bodies, model_of_system
from canon.scenes.beside import side_by_side
from canon.scenes.bodies import Start, read_bodies
from canon.scenes.effects import EFFECTS
from canon.scenes.effects.effect import Contribution, Given, Particle, Surroundings
from canon.scenes.identity import digest_of
from canon.scenes.model import Model
from canon.scenes.monitors import check_monitors
from canon.scenes.multiplied_out import check_model
from canon.scenes.own_hamiltonian import read_own_hamiltonian
from canon.scenes.rays import are_rays, names_rays, rays_of
from canon.scenes.rigid_bodies import Spin, read_rigid_bodies, read_top
from canon.scenes.rigid_model import model_of_rigid_bodies, without_attitude
from canon.scenes.scene import Body, Scene, Settings
from canon.scenes.settings import read_settings
from canon.scenes.skate_system import own_names, read_skate
from canon.scenes.skates import model_of_skates, start_of_skates
from canon.scenes.systems import Placed, named_system, read_named_system
from canon.scenes.values import number, one_file
from canon.vocabulary import nearest

SECTIONS: Final = ("title", "dynamics", "units", "constants", "body", "rigid_body", "effect", "system", "run")
OF_CLAIMS: Final = ("phase_space", "claim")
"""The sections by which a claim file is known that was given in place of a scene."""
DYNAMICS: Final = ("newtonian", "relativistic")
TIME: Final = sp.Symbol("t", real=True)
Constants = Mapping[str, Any]


def read_scene(path: str | os.PathLike[str]) -> Scene:
    """The scene in a file. **Raises:** `InputError` with the place in it."""
    return scene_of(document.load(path))


def read_scene_text(text: str) -> Scene:
    """The scene in a document that is given as text. **Raises:** `InputError`."""
    return scene_of(document.parse(text))


def scene_of(tables: Table) -> Scene:
    """The scene in a TOML document. **Raises:** `InputError` with the place."""
    with one_file():
        return _scene_of(tables)


def _scene_of(tables: Table) -> Scene:
    document.only(
        tables, SECTIONS, "", dict.fromkeys(OF_CLAIMS, "that is a claim file's, and `canon verify` checks it")
    )
    title, units = (document.text(tables.get(word, ""), key(word)) for word in ("title", "units"))
    if "run" not in tables:
        raise InputError("the section [run] is missing: it says for how long, as in duration = 10.0")
    settings = read_settings(tables["run"])
    moving = [word for word in ("system", "body", "rigid_body") if word in tables]
    if not moving:
        raise InputError(
            "nothing moves here: add [[body]] with a mass and a position, [[rigid_body]] with moments, or [system]"
        )
    if "system" in moving and len(moving) > 1:
        raise InputError(f"both [system] and [[{moving[1]}]] are given: a system stands in place of bodies")
    relativistic = _relativistic(tables)
    constants = {
        document.name(name, key(name, "[constants]")): number(value, key(name, "[constants]"))
        for name, value in document.table(tables.get("constants", {}), "[constants]").items()
    }
    if relativistic and not constants.get("c", 1) > 0:
        raise InputError(f"the speed of light is above 0, not {constants['c']}", key("c", "[constants]"))
    read = _both if len(moving) > 1 else {"system": _system, "body": _bodies, "rigid_body": _rigid}[moving[0]]
    found = read(tables, constants, relativistic, settings)
    check_model(found.model)
    check_monitors(settings.monitors, found.model, key("monitor", "[run]"))
    absent = tuple(kind for kind in EFFECTS if kind not in found.active)
    settings = replace(settings, start=found.start)
    digest = digest_of(tables)
    return Scene(title, found.model, found.q, found.p, settings, found.bodies, units, absent, {}, digest, found.own)


class _Found(NamedTuple):
    """A model with its initial state, the effects that were named, the bodies, and own names of the state."""

    model: Model
    q: tuple[float, ...]
    p: tuple[float, ...]
    active: frozenset[str]
    bodies: tuple[Body, ...] = ()
    start: float = 0.0
    own: Mapping[str, Any] = {}


def _system(tables: Table, constants: Constants, relativistic: bool, settings: Settings) -> _Found:
    """A system in its own coordinates."""
    if relativistic:
        raise InputError("relativistic dynamics are those of bodies: a system states its own H", key("dynamics"))
    table = document.table(tables["system"], "[system]")
    if "name" in table and (system := named_system(table)).own:
        return (_skate if system.ledger == "S33" else _top)(table, tables, constants, settings)
    placed = _placed(table)
    model = placed.model
    whole = Particle("system", model.q, model.p, None)
    effects = read_effects(tables.get("effect", []), Surroundings((whole,), constants, model.t, is_system=True))
    return _Found(model_of_system(model, effects), placed.q, placed.p, _kinds(effects), start=placed.start)


def _bodies(tables: Table, constants: Constants, relativistic: bool, settings: Settings) -> _Found:
    """Point bodies."""
    starts = read_bodies(tables["body"], names_rays(tables.get("effect")))
    surroundings = Surroundings(tuple(start.particle for start in starts), constants, TIME, relativistic)
    return _point_bodies(starts, surroundings, read_effects(tables.get("effect", []), surroundings))


def _point_bodies(starts: Sequence[Start], surroundings: Surroundings, effects: Sequence[Named]) -> _Found:
    particles = surroundings.particles
    rays = are_rays(effects)
    bodies = tuple(
        Body(body.name, body.mass, body.charge, k * (body.dimension - rays), body.dimension, rays)
        for k, body in enumerate(particles)
    )
    if rays:
        model, (q, p), begin = rays_of(starts, surroundings, effects)
        return _Found(model, q, p, _kinds(effects), bodies, begin)
    if any(part.blades for _, part in effects):
        model = model_of_skates(surroundings, effects)
        return _Found(model, *start_of_skates(starts, effects), _kinds(effects), bodies)
    start = initial_state(starts, surroundings, effects)
    return _Found(model_of_bodies(surroundings, effects), start.q, start.p, _kinds(effects), bodies)


def _rigid(tables: Table, constants: Constants, relativistic: bool, settings: Settings) -> _Found:
    """Rigid bodies."""
    _check_newtonian(relativistic)
    spins = read_rigid_bodies(tables["rigid_body"])
    rigid = tuple(spin.body for spin in spins)
    return _turning(spins, read_effects(tables.get("effect", []), Surroundings((), constants, TIME, rigid=rigid)))


def _check_newtonian(relativistic: bool) -> None:
    if relativistic:
        raise InputError("relativistic dynamics are those of point bodies", key("dynamics"))


def _both(tables: Table, constants: Constants, relativistic: bool, settings: Settings) -> _Found:
    """Point bodies and rigid bodies, each with the effects on its kind."""
    _check_newtonian(relativistic)
    if names_rays(tables.get("effect")):
        raise InputError("rays have a coordinate in place of time, and rigid bodies have time: give each its own scene")
    starts = read_bodies(tables["body"])
    spins = read_rigid_bodies(tables["rigid_body"], "rigid")
    particles, rigid = tuple(start.particle for start in starts), tuple(spin.body for spin in spins)
    shared = {body.name for body in particles} & {body.name for body in rigid}
    if shared:
        raise InputError(f"a body and a rigid body are both called {min(shared)!r}", "rigid_body")
    surroundings = Surroundings(particles, constants, TIME, rigid=rigid)
    effects = read_effects(tables.get("effect", []), surroundings)
    turn = [EFFECTS[kind].on_rigid for kind, _ in effects]
    moving = _point_bodies(starts, surroundings, [each for each, on in zip(effects, turn, strict=True) if not on])
    turning = _turning(spins, [each for each, on in zip(effects, turn, strict=True) if on])
    model = side_by_side(moving.model, turning.model)
    return _Found(model, moving.q + turning.q, moving.p + turning.p, _kinds(effects), moving.bodies)


def _turning(spins: Sequence[Spin], effects: Sequence[Named]) -> _Found:
    rigid = tuple(spin.body for spin in spins)
    q, p = (tuple(x for spin in spins for x in getattr(spin, word)) for word in ("attitude", "M"))
    return _Found(model_of_rigid_bodies(rigid, effects, TIME), q, p, _kinds(effects))


def _top(table: Table, tables: Table, constants: Constants, settings: Settings) -> _Found:
    """Euler's equations, with the attitude where something depends on it."""
    spin = read_top(table)
    effects = read_effects(tables.get("effect", []), Surroundings((), constants, TIME, rigid=(spin.body,)))
    model = without_attitude(model_of_rigid_bodies((spin.body,), effects, TIME), settings.monitors)
    own = {"M": spin.body.M, **({"attitude": spin.body.attitude} if model.q else {})}
    return _Found(model, spin.attitude if model.q else (), spin.M, _kinds(effects), own=own)


def _skate(table: Table, tables: Table, constants: Constants, settings: Settings) -> _Found:
    """The skate on an incline, a body with a gravity of its own."""
    start, own = read_skate(table)
    surroundings = Surroundings((start.particle,), constants, TIME)
    effects = (*own, *read_effects(tables.get("effect", []), surroundings))
    model = model_of_skates(surroundings, effects)
    return _Found(model, *start_of_skates([start], effects), _kinds(effects), own=own_names(model))


def _kinds(effects: Sequence[Named]) -> frozenset[str]:
    return frozenset(kind for kind, _ in effects)


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
    if kind not in EFFECTS:
        advice = nearest(kind, EFFECTS) or f": the effects are {', '.join(EFFECTS)}"
        raise InputError(f"unknown effect {kind[:80]!r}{advice}", key("kind", where))
    effect = EFFECTS[kind]
    place = f"{where}, {kind}"
    document.only(table, ("kind", *effect.parameters, *(() if surroundings.is_system else ("bodies",))), place)
    if surroundings.is_system and not effect.on_systems:
        raise InputError(f"the effect {kind!r} acts on bodies, not on a system in its own coordinates", place)
    if effect.on_rigid and not surroundings.rigid:
        raise InputError(f"the effect {kind!r} acts on a rigid body: add [[rigid_body]] with its moments", place)
    if surroundings.rigid and not surroundings.particles and not effect.on_rigid:
        acting = ", ".join(name for name, other in EFFECTS.items() if other.on_rigid)
        raise InputError(f"the effect {kind!r} acts on a [[body]]; on a rigid body there are {acting}", place)
    return effect.add(Given(table, surroundings, place))
