"""From a claim file to claims.

A fault in a section that all claims share fails the file, and so does more work than reading may take; a fault in one
claim fails that claim alone. Nothing in a file is ever executed: it is text and tables, and its formulas are read by
`canon.expression`.
"""

from __future__ import annotations

import math
import os
from contextlib import suppress
from decimal import Decimal
from typing import Any, Final, NamedTuple

from canon.claim import EXPECTATIONS, Claim
from canon.claims import document
from canon.claims.document import Table, key
from canon.claims.key_values import read_keys
from canon.claims.keys import COMMON, KEYS, KeySpec
from canon.claims.names import Names, read_names
from canon.claims.sections import SECTIONS, read_subject
from canon.errors import InputError
from canon.mechanics.subject import Subject
from canon.vocabulary import nearest

OF_SCENES: Final = ("body", "rigid_body", "effect", "system", "run")
"""The sections by which a scene is known that was given in place of a claim file."""
MEANT: Final = {
    "symplectic": "canonical", "canonical_transformation": "canonical", "kamiltonian": "new_hamiltonian",
    "constant_of_motion": "conserved", "first_integral": "conserved", "commute": "involution", "equation": "identity",
}  # fmt: skip
"""Other words for kinds of claims."""


class Reading(NamedTuple):
    """What a file holds: its claims, each with its `index` in the file, and its faults as {where, message}."""

    claims: list[Claim]
    problems: list[dict[str, str]]


def read_file(path: str | os.PathLike[str]) -> Reading:
    """The claims in the file at `path`, and what is wrong with the file. Never raises for what is in it."""
    try:
        text = document.content(path)
    except InputError as error:
        return Reading([], [_problem(error)])
    return read_text(text)


def read_text(text: str) -> Reading:
    """The claims in a document that is given as text, as `read_file` reads it."""
    try:
        tables = document.parse(text)
    except InputError as error:
        return Reading([], [_problem(error)])
    return read_tables(tables, len(text))


def read_tables(tables: Table, letters: int = 0) -> Reading:
    """The claims in a TOML document that has been read already, of a text of so many letters."""
    problems: list[dict[str, str]] = []
    claims: list[Claim] = []
    names = None
    try:
        document.only(tables, SECTIONS, "", dict.fromkeys(OF_SCENES, "that is a scene's, and `canon simulate` runs it"))
        for word in ("title", "source"):
            document.text(tables.get(word, ""), key(word))
        listed = _listed(tables)
        names = read_names(tables, letters)
        subject = read_subject(tables, names)
        for index, table in enumerate(listed):
            try:
                claims.append(_claim(table, index, subject, names, tables.get("source")))
            except InputError as error:
                fault = error.at(f"claim {index + 1}")
                if names.measure.is_spent:
                    raise fault from None
                problems.append(_problem(fault))
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
    return document.listing(listed, "claim", document.BIGGEST)


def _claim(value: Any, index: int, subject: Subject, names: Names, source: str | None) -> Claim:
    table = document.table(value, "")
    names.measure.spend_on_claim()
    if "kind" not in table:
        raise InputError("the key 'kind' is missing")
    kind = document.text(table["kind"], key("kind"))
    if kind not in KEYS:
        meant = f": did you mean {MEANT[kind]!r}?" if kind in MEANT else ""
        advice = (
            meant
            or (nearest(kind, KEYS) if names.measure.compares(len(KEYS)) else "")
            or f": the kinds are {', '.join(KEYS)}"
        )
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
        read_keys(table, spec, names),
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
    number = math.nan
    if isinstance(value, (int, Decimal)) and not isinstance(value, bool):
        with suppress(OverflowError):
            number = float(value)
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
