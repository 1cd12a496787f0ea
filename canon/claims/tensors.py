"""A Poisson tensor of a claim's own: an antisymmetric matrix in given coordinates, or structure constants."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from canon.claims import document
from canon.claims.combinations import coefficients, seen_to_vanish
from canon.claims.document import Table, key
from canon.claims.names import Names
from canon.errors import InputError
from canon.expression import Formula, Vocabulary
from canon.mechanics.assumptions import symbol_with
from canon.mechanics.vanishing import vanishes

Matrix = tuple[tuple[Formula, ...], ...]


def read_tensor(table: Table, names: Names) -> dict[str, Any]:
    """`coordinates`, a tuple of symbols, and `tensor`, the matrix {x_i, x_j} of formulas in them.

    Given either by `tensor` and `coordinates`, or by `structure`: the table "A,B" = {A, B} of a Lie algebra's basis,
    whose elements are the coordinates (pairs not listed follow by antisymmetry, else are 0).

    **Raises:** `InputError` with the place.
    """
    if "structure" in table:
        if "tensor" in table:
            raise InputError("'tensor' and 'structure' both state the bracket: give one of them")
        return _from_structure(table, names)
    for word, other in (("tensor", "coordinates"), ("coordinates", "tensor")):
        if word not in table:
            raise InputError(f"the key {other!r} needs the key {word!r}")
    coordinates = _coordinates(document.names(table["coordinates"], key("coordinates")), names, key("coordinates"))
    where = key("tensor")
    n = len(coordinates)
    rows = document.listing(table["tensor"], where)
    if len(rows) != n or any(len(document.listing(row, where)) != n for row in rows):
        raise InputError(f"a matrix of {n} rows of {n} expressions is expected, for the coordinates", where)
    read = _reader(coordinates, names)
    matrix: Matrix = tuple(
        tuple(read(entry, f"{where}, row {i}, column {j}") for j, entry in enumerate(row, 1))
        for i, row in enumerate(rows, 1)
    )
    for i in range(n):
        for j in range(i + 1):
            both = matrix[i][j].expr + matrix[j][i].expr
            if both != 0 and not seen_to_vanish(both, names.measure, where):
                raise InputError(
                    f"not antisymmetric: row {j + 1}, column {i + 1} and row {i + 1}, column {j + 1}", where
                )
    return {"coordinates": coordinates, "tensor": matrix}


def _coordinates(listed: tuple[str, ...], names: Names, where: str) -> tuple[sp.Symbol, ...]:
    """The symbols of the coordinates: declared in the file, or by the key, and then real."""
    if not listed:
        raise InputError("the list is empty", where)
    vocabulary = names.vocabulary
    for name in listed:
        if vocabulary.declares(name) and name not in vocabulary.symbols:
            raise InputError(f"{name!r} is a function or an abbreviation, not a coordinate", where)
    return tuple(vocabulary.symbols.get(name) or symbol_with(name) for name in listed)


def _reader(coordinates: tuple[sp.Symbol, ...], names: Names) -> Callable[[Any, str], Formula]:
    """What reads formulas in the coordinates of a bracket, each with its place."""
    vocabulary: Vocabulary = names.vocabulary.declaring({symbol.name: symbol for symbol in coordinates})
    allowed = tuple(symbol.name for symbol in coordinates)
    return lambda value, where: names.formula(value, "old", where, vocabulary=vocabulary, allowed=allowed)


def _from_structure(table: Table, names: Names) -> dict[str, Any]:
    where = key("structure")
    entries: dict[tuple[str, str], tuple[Any, str]] = {}
    order: dict[str, None] = {}
    for pair, value in document.table(table["structure"], where).items():
        place = f"{where}, {pair[:80]!r}"
        words = [document.name(word.strip(), place) for word in pair.split(",")]
        if len(words) != 2:
            raise InputError('a pair of basis names is expected, as in "A,B" = "C"', place)
        a, b = words
        if (a, b) in entries or (b, a) in entries:
            raise InputError(f"the bracket of {a} and {b} is stated twice", place)
        entries[a, b] = (value, place)
        order |= {a: None, b: None}
    listed = document.names(table["coordinates"], key("coordinates")) if "coordinates" in table else tuple(order)
    for name in order:
        if name not in listed:
            raise InputError(f"{name!r} is not among the coordinates", where)
    coordinates = _coordinates(listed, names, where)
    read = _reader(coordinates, names)
    n = len(listed)
    zero = Formula(sp.Integer(0), text="0")
    matrix = [[zero] * n for _ in range(n)]
    for (a, b), (value, place) in entries.items():
        try:
            formula = read(value, place)
        except InputError as error:
            if "coordinates" in table or not error.message.startswith("unknown name"):
                raise
            advice = "; a basis element that is in no pair is known by coordinates = [...], a list of all of them"
            raise InputError(error.message + advice, error.where) from None
        if coefficients(formula.expr, coordinates, names.measure, place) is None:
            raise InputError("a linear combination of basis names is expected", place)
        i, j = listed.index(a), listed.index(b)
        if i == j and not vanishes(formula.expr):
            raise InputError(f"the bracket of {a} with itself is 0", place)
        matrix[i][j] = formula
        matrix[j][i] = Formula(-formula.expr, formula.conditions, f"-({formula})", formula.names)
    return {"coordinates": coordinates, "tensor": tuple(tuple(row) for row in matrix)}
