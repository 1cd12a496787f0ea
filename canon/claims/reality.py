"""Which variables of a claim file are complex because the formulas that define them are.

A name of which nothing is said is real. But where `a = (q + 1j*p)/sqrt(2)` defines the new variable a, it is complex
unless its author says otherwise: else abs(a)**2 would be read as a**2.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from canon.errors import InputError
from canon.tokens import tokens


def complex_variables(tables: Mapping[str, Any], words: Mapping[str, Iterable[str]]) -> list[str]:
    """The variables of which nothing is said and whose formula has the imaginary unit or a complex name in it.

    **Arguments:** `tables`, the file; `words`, what is assumed of each name of its `[symbols]`.
    """
    space = _table(tables.get("phase_space"))
    definitions = _table(tables.get("definitions"))
    named = {word: _list(space.get(word)) for word in ("q", "p", "Q", "P")}
    if "transformation" in tables:
        section = _table(tables["transformation"])
        formulas = [pair for word in named for pair in zip(named[word], _list(section.get(word)), strict=False)]
    else:
        F = _table(tables.get("generating_function")).get("F")
        formulas = [(name, F) for names in named.values() for name in names] if F is not None else []
    imaginary = {name for name, given in words.items() if "complex" in given}
    return [
        name
        for name, formula in formulas
        if isinstance(name, str) and name not in words and _is_complex(formula, definitions, imaginary)
    ]


def _is_complex(formula: Any, definitions: Mapping[str, Any], imaginary: set[str]) -> bool:
    """Whether the imaginary unit or one of these names is written in a formula, abbreviations followed."""
    seen: set[str] = set()
    pending = [formula]
    while pending:
        text = pending.pop()
        if not isinstance(text, str):
            continue
        try:
            found = tokens(text)
        except InputError:
            continue
        for before, token in zip([None, *found], found, strict=False):
            if token.kind != "name":
                continue
            if (
                token.text in ("j", "J")
                and before is not None
                and before.kind == "number"
                and before.end == token.start
            ):
                return True
            if token.text in imaginary:
                return True
            if token.text in definitions and token.text not in seen:
                seen.add(token.text)
                pending.append(definitions[token.text])
    return False


def _table(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []
