"""The course's ledger: every statement and erratum by id, and which of them a claim's source cites.

`ledger.json` lists them as package data. A claim cites by its source: "course 13.35, sec-13.5-g, erratum E47". What is
checked by a test of the project rather than by a claim, and what has no check yet, stands in `elsewhere.toml`.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement of the course: `also` are the ids that it stands for besides its own."""

    id: str
    chapter: int
    title: str
    kind: str
    scope: str
    priority: int
    also: tuple[str, ...]
    errata: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Erratum:
    """A line of the course as printed, and corrected; `type` is "error", "ocr", "convention", "ambiguous", …"""

    id: str
    type: str
    entries: tuple[str, ...]
    where: str
    printed: str
    corrected: str


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """What no claim checks: `tests` by id, as "tests/file.py::name"; `open`, ids without a check, with the reason.

    `limits` says of some that claims check how far these go.
    """

    tests: Mapping[str, str]
    open: Mapping[str, str]
    limits: Mapping[str, str]


@cache
def _data() -> Mapping[str, Any]:
    return json.loads(files("canon.catalogue").joinpath("ledger.json").read_text(encoding="utf-8"))


@cache
def statements() -> tuple[Statement, ...]:
    """All statements, in the course's order."""
    return tuple(
        Statement(**{**entry, "also": tuple(entry["also"]), "errata": tuple(entry["errata"])})
        for entry in _data()["statements"]
    )


@cache
def errata() -> tuple[Erratum, ...]:
    """All errata, in their order."""
    return tuple(Erratum(**{**entry, "entries": tuple(entry["entries"])}) for entry in _data()["errata"])


@cache
def elsewhere() -> Elsewhere:
    """What is checked by tests, and what is open."""
    table = tomllib.loads(files("canon.catalogue").joinpath("elsewhere.toml").read_text(encoding="utf-8"))
    return Elsewhere(table.get("tests", {}), table.get("open", {}), table.get("limits", {}))


def cited(source: str | None) -> tuple[str, ...]:
    """The ids in a claim's source, those of statements and of errata; an id of `also` is that of its statement."""
    found: dict[str, None] = {}
    names = _names()
    for part in (source or "").split(","):
        word = re.sub(r"^\s*(course|erratum)\s+", "", part).strip()
        if word in names:
            found[names[word]] = None
    return tuple(found)


@cache
def _names() -> Mapping[str, str]:
    own = {s.id: s.id for s in statements()} | {e.id: e.id for e in errata()}
    return {also: s.id for s in statements() for also in s.also} | own
