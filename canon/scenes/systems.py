"""The systems of the catalogue by name: what they are, and a scene's section [system] that names one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import sympy as sp

from canon.catalogue.systems import system_files
from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.scenes.model import Formula, Model, Term
from canon.scenes.values import expression, needed, number, numbers
from canon.vocabulary import nearest

KEYS: Final = ("name", "parameters", "q", "p")
WHERE: Final = "[system]"


@dataclass(frozen=True)
class System:
    """A system of the catalogue: its variables and `time`, which begins at `start`; `parameters` with the values that
    they have where nothing is said, those in `real` of any sign; `functions` with their variables and default; `terms`
    of the Hamiltonian by effect; what its `monitors` follow; and an `example`: q, p, duration, monitor. A system whose
    state is not (q, p) has its `own` keys, with the number of components of each.
    """

    name: str
    title: str
    ledger: str
    q: tuple[str, ...]
    p: tuple[str, ...]
    time: str
    start: Formula
    parameters: Mapping[str, Any]
    real: frozenset[str]
    functions: Mapping[str, tuple[tuple[str, ...], str]]
    terms: Mapping[str, str]
    monitors: Mapping[str, tuple[str, ...]]
    example: Mapping[str, Any]
    note: str
    own: Mapping[str, int]


def system_names() -> tuple[str, ...]:
    """The names of the systems of this version."""
    return tuple(system_files())


def load_system(name: str, where: str = "") -> System:
    """The system of this name. **Raises:** `InputError` with the nearest name where there is none."""
    files = system_files()
    if name not in files:
        advice = nearest(name, files) or ": `canon scenes` lists them"
        raise InputError(f"there is no system {name[:80]!r}{advice}", where)
    table = document.parse(files[name].read_text(encoding="utf-8"))
    return System(
        name,
        table["title"],
        table["ledger"],
        tuple(table["q"]),
        tuple(table["p"]),
        table.get("time", "t"),
        number(table.get("start", 0), "start"),
        table["parameters"],
        frozenset(table.get("real", ())),
        {name: (tuple(given["of"]), given["default"]) for name, given in table.get("functions", {}).items()},
        table["terms"],
        {name: tuple(listed) for name, listed in table.get("monitors", {}).items()},
        table["example"],
        table.get("note", ""),
        table.get("own", {}),
    )


@dataclass(frozen=True)
class Placed:
    """A model with its initial state, and the time at which it begins."""

    model: Model
    q: tuple[float, ...]
    p: tuple[float, ...]
    start: float = 0.0


def read_named_system(table: Table) -> Placed:
    """The system that [system] names, with its parameters and initial state. **Raises:** `InputError`."""
    document.only(table, KEYS, WHERE)
    system = named_system(table)
    values, given, place = read_parameters(system, table)
    q, p = (numbers(needed(table, word, WHERE), key(word, WHERE), [len(getattr(system, word))]) for word in ("q", "p"))
    model = model_of(system, values, {name: given[name] for name in system.functions if name in given}, place)
    return Placed(model, tuple(map(float, q)), tuple(map(float, p)), float(system.start))


def named_system(table: Table) -> System:
    """The system that [system] names. **Raises:** `InputError`."""
    return load_system(document.text(needed(table, "name", WHERE), key("name", WHERE)), key("name", WHERE))


def read_parameters(system: System, table: Table) -> tuple[dict[str, Formula], Table, str]:
    """The values of the system's parameters, the table that gives them, and its place. **Raises:** `InputError`."""
    given = document.table(table.get("parameters", {}), key("parameters", WHERE))
    place = f"{WHERE}, parameters"
    document.only(given, (*system.parameters, *system.functions), place)
    values = {
        name: number(given.get(name, default), key(name, place), positive=name not in system.real)
        for name, default in system.parameters.items()
    }
    return values, given, place


def model_of(system: System, values: Mapping[str, Formula], functions: Mapping[str, Any], where: str = "") -> Model:
    """The model with these values of its parameters; a function that is not given has its default.

    **Raises:** `InputError` where a function is no expression in its variables.
    """
    variables = {name: sp.Symbol(name, real=True) for name in (system.time, *system.q, *system.p)}
    names = {**variables, **values}
    for name, (of, default) in system.functions.items():
        open_names = {word: variables[word] for word in of} | dict(values)
        names[name] = expression(functions.get(name, default), open_names, key(name, where))
    terms = tuple(Term(effect, expression(text, names, effect)) for effect, text in system.terms.items())
    follow = {
        monitor: {text: expression(text, names, monitor) for text in listed}
        for monitor, listed in system.monitors.items()
    }
    q, p = (tuple(variables[name] for name in listed) for listed in (system.q, system.p))
    return Model(
        q,
        p,
        variables[system.time],
        terms,
        momenta=follow.get("momentum", {}),
        angular_momenta=follow.get("angular_momentum", {}),
        lrl=follow.get("lrl", {}),
    )
