"""The keys of claims about Lie algebras: a basis, matrices, the name of an algebra, structure constants."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Final

import sympy as sp

from canon.claims import document
from canon.claims.combinations import coefficients
from canon.claims.document import Table, key
from canon.claims.names import Names
from canon.errors import InputError
from canon.expression import Formula, Vocabulary, read
from canon.measure import Measure
from canon.mechanics.algebra.names import read_name

FORMS: Final = ("basis", "matrices", "algebra", "brackets")
"""The forms of keys that are read here (see `canon.claims.keys`)."""
LARGEST: Final = 150

Reader = Callable[[Any, str], Formula]


def read_algebra_key(form: str, table: Table, word: str, names: Names, vocabulary: Vocabulary, read_one: Reader) -> Any:
    """The value of one key: formulas by name, matrices of formulas by name, a name, or combinations by pair.

    **Arguments:** `read_one`, the reader of a formula in the variables that the key allows.

    **Raises:** `InputError` with the place.
    """
    value, where = table[word], key(word)
    if form == "algebra":
        text = document.text(value, where)
        try:
            read_name(text)
        except InputError as error:
            raise error.at(where) from None
        return text
    if form == "basis":
        return {name: read_one(item, place) for name, item, place in _named(value, where)}
    if form == "matrices":
        return _matrices(value, where, read_one)
    return _brackets(value, where, _basis_names(table), names, vocabulary)


def _named(value: Any, where: str) -> list[tuple[str, Any, str]]:
    entries = document.table(value, where)
    if not entries:
        raise InputError("the table is empty: name = value for each element of the basis", where)
    if len(entries) > LARGEST:
        raise InputError(f"{len(entries)} elements: at most {LARGEST}", where)
    return [(document.name(name, where), item, f"{where}, {name!r}") for name, item in entries.items()]


def _matrices(value: Any, where: str, read_one: Reader) -> dict[str, tuple[tuple[Formula, ...], ...]]:
    found: dict[str, tuple[tuple[Formula, ...], ...]] = {}
    size = 0
    for name, item, place in _named(value, where):
        rows = document.listing(item, place)
        size = size or len(rows)
        if not rows or len(rows) != size or any(len(document.listing(row, place)) != size for row in rows):
            raise InputError(f"a square matrix is expected, {size} by {size} as the first of them", place)
        found[name] = tuple(
            tuple(read_one(entry, f"{place}, row {i}, column {j}") for j, entry in enumerate(row, 1))
            for i, row in enumerate(rows, 1)
        )
    return found


def _basis_names(table: Table) -> tuple[str, ...]:
    """The basis of the claim that a table states: of `basis`, or for a group law the names of `first`."""
    if "first" in table:
        return document.names(table["first"], key("first"))
    return tuple(document.table(table.get("basis", {}), key("basis")))


def _brackets(
    value: Any, where: str, basis: tuple[str, ...], names: Names, vocabulary: Vocabulary
) -> dict[str, dict[str, Formula]]:
    """The table "A,B" = combination of basis names, as {"A,B": {name: coefficient}}; a basis name wins over others."""
    found: dict[str, dict[str, Formula]] = {}
    given: set[frozenset[str]] = set()
    symbols = {name: sp.Symbol(name, real=True) for name in basis}
    own = replace(
        vocabulary,
        symbols={**vocabulary.symbols, **symbols},
        definitions={n: v for n, v in vocabulary.definitions.items() if n not in symbols},
        functions=vocabulary.functions - set(symbols),
    )
    moving = [s.name for s in (*names.space.old, *names.space.new, names.space.t) if s.name not in symbols]
    reason = "a structure constant, which depends on parameters alone"
    own = replace(own, refused={n: r for n, r in own.refused.items() if n not in symbols}).refusing(moving, reason)
    for pair, item in document.table(value, where).items():
        place = f"{where}, {pair[:80]!r}"
        words = [document.name(word.strip(), place) for word in pair.split(",")]
        if len(words) != 2 or not set(words) <= set(basis):
            raise InputError(f'a pair of basis names is expected, as in "A,B" = "C", of {", ".join(basis)}', place)
        if frozenset(words) in given:
            raise InputError(f"the bracket of {words[0]} and {words[1]} is stated twice", place)
        given.add(frozenset(words))
        formula = names.counted(read(document.expression_text(item, place), own, place, names.measure), place)
        found[",".join(words)] = _combination(formula, symbols, names.measure, place)
        if words[0] == words[1] and found[",".join(words)]:
            raise InputError(f"the bracket of {words[0]} with itself is 0", place)
    return found


def _combination(
    formula: Formula, symbols: Mapping[str, sp.Symbol], measure: Measure, place: str
) -> dict[str, Formula]:
    """The coefficients of a linear combination of the basis."""
    found = coefficients(formula.expr, symbols.values(), measure, place)
    if found is None:
        raise InputError("a linear combination of basis names is expected", place)
    names = formula.names - set(symbols)
    return {
        name: Formula(found[symbol], formula.conditions, str(found[symbol]), names)
        for name, symbol in symbols.items()
        if symbol in found
    }
