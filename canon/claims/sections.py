"""The sections that all claims of a file share: Hamiltonian, generating function, transformation, domain."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Final

from canon.claims import document
from canon.claims.document import Table, key
from canon.claims.keys import Side
from canon.claims.names import Names
from canon.domain import Condition, Domain, unique
from canon.errors import InputError
from canon.expression import read_relation
from canon.measure import CALL
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.subject import Subject
from canon.mechanics.transformation import Transformation

SECTIONS: Final = (
    "title", "source", "phase_space", "symbols", "definitions", "hamiltonian", "generating_function",
    "transformation", "domain", "claim",
)  # fmt: skip

SURFACE: Final = 60
"""The work of asking whether an equation is 0 = 0, for each node of it."""


def read_subject(tables: Table, names: Names) -> Subject:
    """What the claims of a file are about. **Raises:** `InputError` with the place."""
    if "domain" in tables:
        has_map = "transformation" in tables or "generating_function" in tables
        domain = _domain(tables["domain"], names, "both" if has_map else "old")
        names.space = names.space.with_domain(domain)
    hamiltonian = transformation = generating = None
    if "hamiltonian" in tables:
        where = "[hamiltonian]"
        section = document.table(tables["hamiltonian"], where)
        document.only(section, ("H",), where)
        hamiltonian = names.formula(_needed(section, "H", where), "old", key("H", where))
    if "transformation" in tables:
        transformation = _transformation(tables["transformation"], names)
    if "generating_function" in tables:
        generating = _generating_function(tables["generating_function"], names)
    names.hamiltonian = hamiltonian
    space = names.space
    return Subject(space, hamiltonian, generating, transformation, space.domain, space.functions)


def _needed(section: Table, name: str, where: str) -> Any:
    if name not in section:
        raise InputError(f"the key {name!r} is missing", where)
    return section[name]


def _transformation(value: Any, names: Names) -> Transformation:
    where = "[transformation]"
    section = document.table(value, where)
    document.only(section, ("Q", "P", "q", "p"), where)
    space = names.space
    forward, backward = ([word for word in pair if word in section] for pair in ("QP", "qp"))
    if forward and backward:
        raise InputError(
            "both directions are given: state the new variables (Q, P) in terms of the old ones, or the old (q, p) in "
            "terms of the new, not both",
            where,
        )
    if not space.Q:
        raise InputError("[phase_space] declares no new variables: Q = [...] and P = [...]", where)
    words = "qp" if backward else "QP"
    if backward and len(space.Q) != space.n:
        raise InputError("with fewer new pairs than old ones, give the new variables in terms of the old", where)
    found: dict[str, Any] = {}
    for word in words:
        place, wanted = key(word, where), getattr(space, word)
        values = document.listing(_needed(section, word, where), place)
        if len(values) != len(wanted):
            raise InputError(f"{len(values)} components for the {len(wanted)} variables {_list(wanted)}", place)
        side: Side = "new" if backward else "old"
        found[word] = tuple(names.formula(v, side, f"{place}, for {x}") for v, x in zip(values, wanted, strict=True))
    return Transformation(space, **found)


def _list(symbols: Iterable[Any]) -> str:
    return ", ".join(symbol.name for symbol in symbols)


def _generating_function(value: Any, names: Names) -> GeneratingFunction:
    where = "[generating_function]"
    section = document.table(value, where)
    document.only(section, ("type", "F"), where)
    types = read_types(_needed(section, "type", where), names.space, key("type", where))
    F = names.formula(_needed(section, "F", where), "mixed", key("F", where), types=types)
    given = section["type"]
    return GeneratingFunction(names.space, given if isinstance(given, int) else types, F)


def read_types(value: Any, space: PhaseSpace, where: str) -> tuple[int, ...]:
    """The type of a generating function in each degree of freedom. **Raises:** `InputError`."""
    if len(space.Q) != space.n:
        raise InputError(
            f"a generating function needs as many new pairs as old ones: {space.n}, not {len(space.Q)}", where
        )
    types = tuple(document.whole(v, where) for v in (value if isinstance(value, list) else [value]))
    for number in types:
        if number not in (1, 2, 3, 4):
            raise InputError(f"there is no type {number}: the types are 1, 2, 3 and 4", where)
    if isinstance(value, list) and len(types) != space.n:
        raise InputError(f"{len(types)} types for {space.n} degrees of freedom", where)
    return types if isinstance(value, list) else types * space.n


def _domain(value: Any, names: Names, side: Side) -> Domain:
    where = "[domain]"
    section = document.table(value, where)
    document.only(section, ("where", "on"), where)
    conditions = list[Condition]()
    vocabulary = names.restricted(side)
    for i, relation in enumerate(document.listing(section.get("where", []), key("where", where)), 1):
        place = f"{key('where', where)}, inequality {i}"
        conditions += read_relation(document.text(relation, place), vocabulary, place, names.measure)
    surface = list[Any]()
    for i, equation in enumerate(document.listing(section.get("on", []), key("on", where)), 1):
        place = f"{key('on', where)}, equation {i}"
        formula = names.formula(equation, side, place)
        names.measure.spend(CALL + SURFACE * names.measure.size(formula.expr))
        if formula.expr.is_number and not formula.expr.is_zero:
            raise InputError(f"{formula} doesn't vanish anywhere, so the surface is empty", place)
        conditions += formula.conditions
        surface += [formula.expr] if not formula.expr.is_zero else []
    return Domain(unique(conditions), tuple(surface))
