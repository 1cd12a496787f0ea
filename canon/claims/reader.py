"""From a claim file to claims.

A fault in a section that all claims share fails the file; a fault in one claim fails that claim alone. Nothing in a
file is ever executed: it is text and tables, and its formulas are read by `canon.expression`.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from decimal import Decimal
from typing import Any, NamedTuple

import sympy as sp

from canon.claim import EXPECTATIONS, Claim
from canon.claims import document
from canon.claims.document import Table, key
from canon.claims.keys import COMMON, KEYS, LATER, TENSOR, Key, KeySpec
from canon.claims.names import Names, read_names
from canon.claims.sections import SECTIONS, read_subject, read_types
from canon.claims.tensors import read_tensor
from canon.errors import InputError
from canon.expression import Formula, Vocabulary
from canon.mechanics.phase_space import symbol_with
from canon.mechanics.subject import Subject
from canon.vocabulary import nearest


class Reading(NamedTuple):
    """What a file holds: its claims, each with its `index` in the file, and its faults as {where, message}."""

    claims: list[Claim]
    problems: list[dict[str, str]]


def read_file(path: str | os.PathLike[str]) -> Reading:
    """The claims in the file at `path`, and what is wrong with the file. Never raises for what is in it."""
    try:
        tables = document.load(path)
    except InputError as error:
        return Reading([], [_problem(error)])
    return read_tables(tables)


def read_text(text: str) -> Reading:
    """The claims in a document that is given as text, as `read_file` reads it."""
    try:
        tables = document.parse(text)
    except InputError as error:
        return Reading([], [_problem(error)])
    return read_tables(tables)


def read_tables(tables: Table) -> Reading:
    """The claims in a TOML document that has been read already."""
    problems: list[dict[str, str]] = []
    claims: list[Claim] = []
    names = None
    try:
        document.only(tables, SECTIONS, "")
        for word in ("title", "source"):
            document.text(tables.get(word, ""), key(word))
        listed = _listed(tables)
        names = read_names(tables)
        subject = read_subject(tables, names)
        for index, table in enumerate(listed):
            try:
                claims.append(_claim(table, index, subject, names, tables.get("source")))
            except InputError as error:
                problems.append(_problem(error.at(f"claim {index + 1}")))
    except InputError as error:
        claims = []
        problems.append(_problem(error))
    if names is not None:
        problems += _never_used(names, problems)
    return Reading(claims, problems)


def _problem(error: InputError) -> dict[str, str]:
    return {"where": error.where, "message": error.message}


def _never_used(names: Names, problems: list[dict[str, str]]) -> list[dict[str, str]]:
    """The faulty definitions that no other fault tells of."""
    told = "\n".join(problem["message"] for problem in problems)
    faults = [(n, v) for n, v in names.vocabulary.definitions.items() if isinstance(v, InputError)]
    own = [(name, fault) for name, fault in faults if not fault.message.startswith("the definition")]
    return [_problem(fault) for name, fault in own if f"the definition {name!r} is wrong" not in told]


def _listed(tables: Table) -> list[Any]:
    if "claim" not in tables:
        raise InputError("the file makes no claim: add [[claim]] with a kind")
    listed = tables["claim"]
    if isinstance(listed, dict):
        raise InputError("claims are a list: write [[claim]], in double brackets", "claim")
    return document.listing(listed, "claim")


def _claim(value: Any, index: int, subject: Subject, names: Names, source: str | None) -> Claim:
    table = document.table(value, "")
    if "kind" not in table:
        raise InputError("the key 'kind' is missing")
    kind = document.text(table["kind"], key("kind"))
    if kind in LATER:
        raise InputError(f"this version of canon doesn't check claims of kind {kind!r} yet", key("kind"))
    if kind not in KEYS:
        advice = nearest(kind, (*KEYS, *LATER)) or f": the kinds are {', '.join(KEYS)}"
        raise InputError(f"unknown kind {kind[:80]!r}{advice}", key("kind"))
    spec = KEYS[kind]
    document.only(table, (*COMMON, *spec.keys), "")
    for word, entry in spec.keys.items():
        if word not in table and not entry.optional:
            raise InputError(f"a claim of kind {kind!r} needs the key {word!r}")
    _check_needs(kind, spec, subject)
    own = source if "source" not in table else document.text(table["source"], key("source"))
    return Claim(
        kind,
        subject,
        _Keys(table, spec, names).read(),
        title=document.text(table["title"], key("title")) if "title" in table else None,
        source=own,
        expect=_expectation(table.get("expect", "holds")),
        budget=_budget(table["budget"]) if "budget" in table else None,
        index=index,
    )


def _expectation(value: Any) -> str:
    word = document.text(value, key("expect"))
    if word not in EXPECTATIONS:
        advice = nearest(word, EXPECTATIONS) or f": the words are {', '.join(EXPECTATIONS)}"
        raise InputError(f"unknown expectation {word[:80]!r}{advice}", key("expect"))
    return word


def _budget(value: Any) -> float:
    number = float(value) if isinstance(value, (int, Decimal)) and not isinstance(value, bool) else math.nan
    if not 0 < number < math.inf:
        raise InputError("a positive number of seconds is expected", key("budget"))
    return number


def _check_needs(kind: str, spec: KeySpec, subject: Subject) -> None:
    """Refuse a claim whose file doesn't state what it is about."""
    stated = {
        "hamiltonian": subject.hamiltonian is not None,
        "transformation": subject.transformation is not None,
        "generating_function": subject.generating_function is not None,
        "map": subject.transformation is not None or subject.generating_function is not None,
        "square": len(subject.space.Q) == subject.space.n,
    }
    advice = {
        "hamiltonian": "a Hamiltonian: add [hamiltonian] with H",
        "transformation": "an explicit transformation: add [transformation] with Q and P, or with q and p",
        "generating_function": "a generating function: add [generating_function] with type and F",
        "map": "a map: add [transformation] with Q and P (or q and p), or [generating_function] with type and F",
        "square": f"as many new pairs as old ones, not {len(subject.space.Q)} for {subject.space.n}",
    }
    for need in spec.needs:
        if not stated[need]:
            raise InputError(f"a claim of kind {kind!r} needs {advice[need]}", key("kind"))


class _Keys:
    """The typed values of one claim's keys."""

    def __init__(self, table: Table, spec: KeySpec, names: Names) -> None:
        self.table = table
        self.spec = spec
        self.names = names
        self.vocabulary = self._declared()
        self.coordinates: tuple[sp.Symbol, ...] | None = None

    def read(self) -> Mapping[str, Any]:
        """Each key's value, as `canon.claims.keys` types it."""
        tensor = {}
        if any(word in self.table for word in TENSOR):
            tensor = read_tensor(self.table, self.names)
            self.coordinates = tensor["coordinates"]
            self.vocabulary = self.vocabulary.declaring({s.name: s for s in tensor["coordinates"]})
            self._check_hamiltonian(tensor["coordinates"])
        given = [word for word in self.spec.keys if word in self.table and word not in TENSOR]
        given.sort(key=lambda word: self.spec.keys[word].form not in ("name", "names", "constants"))
        return {word: self._value(word, self.spec.keys[word], self.table[word]) for word in given} | tensor

    def _declared(self) -> Vocabulary:
        """The file's vocabulary with the names that the claim itself declares."""
        own: dict[str, sp.Symbol] = {}
        for word, entry in self.spec.keys.items():
            if word not in self.table:
                continue
            value = self.table[word]
            if entry.form == "name" or (entry.form == "constant" and isinstance(value, str) and value.isidentifier()):
                listed: tuple[str, ...] = (document.name(value, key(word)),)
            elif entry.form in ("names", "constants") and word != "coordinates":
                listed = document.names(value, key(word))
            else:
                continue
            own |= {name: symbol_with(name) for name in listed}
        return self.names.vocabulary.declaring(own)

    def _value(self, word: str, entry: Key, value: Any) -> Any:
        where = key(word)
        if entry.form in ("expression", "constant"):
            return self._formula(value, entry, where)
        if entry.form in ("expressions", "per pair"):
            return self._formulas(word, entry, value)
        if entry.form == "name":
            return self._name(document.name(value, where), where)
        if entry.form == "names":
            return self._velocities(value, where)
        if entry.form == "constants":
            return tuple(self._constant(name, where) for name in document.names(value, where))
        if entry.form == "number":
            return self._number(value, where)
        if entry.form == "power":
            return self._power(value, where)
        if entry.form == "type":
            read_types(value, self.names.space, where)
            return tuple(value) if isinstance(value, list) else value
        return self._tables(entry, value, where)

    def _formula(self, value: Any, entry: Key, where: str) -> Formula:
        types = read_types(self.table["type"], self.names.space, key("type")) if entry.side == "mixed" else ()
        allowed = None
        if self.coordinates is not None:
            allowed = [symbol.name for symbol in self.coordinates]
        elif entry.side == "lagrangian":
            velocities = document.names(self.table["velocities"], key("velocities"))
            allowed = [*(symbol.name for symbol in self.names.space.q), *velocities]
        elif entry.side == "integral":
            constants = document.names(self.table["constants"], key("constants"))
            allowed = [*([] if entry.form == "constant" else (s.name for s in self.names.space.q)), *constants]
        return self.names.formula(value, entry.side, where, types=types, vocabulary=self.vocabulary, allowed=allowed)

    def _formulas(self, word: str, entry: Key, value: Any) -> tuple[Formula, ...]:
        values = document.listing(value, key(word))
        q = self.names.space.q
        if entry.form == "per pair" and len(values) != len(q):
            wanted = ", ".join(symbol.name for symbol in q)
            raise InputError(f"{len(values)} components for the {len(q)} degrees of freedom {wanted}", key(word))
        if not values:
            raise InputError("the list is empty", key(word))
        return tuple(self._formula(v, entry, f"{key(word)}, entry {i}") for i, v in enumerate(values, 1))

    def _name(self, name: str, where: str) -> sp.Symbol:
        """The symbol of a name that a claim's key gives: a parameter, declared in the file or by the key."""
        symbol = self.vocabulary.symbols.get(name)
        if symbol is None:
            raise InputError(f"{name!r} is a function or an abbreviation, not a parameter", where)
        if symbol in (*self.names.space.old, *self.names.space.new):
            raise InputError(f"{name!r} is a variable of [phase_space], not a parameter", where)
        return symbol

    def _constant(self, name: str, where: str) -> sp.Symbol:
        """The symbol of a constant of an integral: a name of its own, a parameter, or a new variable."""
        space = self.names.space
        symbol = self.vocabulary.symbols.get(name)
        if symbol is None:
            raise InputError(f"{name!r} is a function or an abbreviation, not a constant", where)
        if symbol in (*space.old, space.t):
            raise InputError(f"{name!r} moves, so it is no constant", where)
        return symbol

    def _velocities(self, value: Any, where: str) -> tuple[sp.Symbol, ...]:
        listed = document.names(value, where)
        q = self.names.space.q
        if len(listed) != len(q):
            raise InputError(f"{len(listed)} velocities for {len(q)} coordinates", where)
        return tuple(self._name(name, where) for name in listed)

    def _number(self, value: Any, where: str) -> int:
        number = document.whole(value, where)
        lowest, highest = (0, 40) if "parameter" in self.spec.keys else (1, self.names.space.n)
        if not lowest <= number <= highest:
            raise InputError(f"a whole number from {lowest} to {highest} is expected, not {number}", where)
        return number

    def _power(self, value: Any, where: str) -> tuple[sp.Symbol, int]:
        items = document.listing(value, where)
        if len(items) != 2 or not isinstance(items[0], str):
            raise InputError('a name and a number are expected, as in order = ["eps", 2]', where)
        order = document.whole(items[1], where)
        if not 0 <= order <= 40:
            raise InputError(f"an order from 0 to 40 is expected, not {order}", where)
        return self._name(document.name(items[0], where), where), order

    def _tables(self, entry: Key, value: Any, where: str) -> tuple[dict[sp.Symbol, Formula], ...]:
        """The tables name = value of `solutions`."""
        found = list[dict[sp.Symbol, Formula]]()
        for i, item in enumerate(document.listing(value, where), 1):
            place = f"{where}, table {i}"
            solution: dict[sp.Symbol, Formula] = {}
            for word, given in document.table(item, place).items():
                if not self.vocabulary.declares(word):
                    raise InputError(self.vocabulary.unknown(word), place)
                solution[self._name(word, place)] = self._formula(given, entry, f"{place}, {word!r}")
            if not solution:
                raise InputError("the table is empty", place)
            found.append(solution)
        if not found:
            raise InputError("at least one table name = value is expected", where)
        return tuple(found)

    def _check_hamiltonian(self, coordinates: tuple[sp.Symbol, ...]) -> None:
        """Refuse a Hamiltonian in phase-space variables that the tensor's bracket doesn't know."""
        if self.table["kind"] != "conserved" or self.names.hamiltonian is None:
            return
        space = self.names.space
        outside = {s.name for s in (*space.old, *space.new)} - {s.name for s in coordinates}
        for name in sorted(outside & self.names.hamiltonian.names):
            raise InputError(f"H depends on {name!r}, which is not among the coordinates", key("coordinates"))
