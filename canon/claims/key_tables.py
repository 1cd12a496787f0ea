"""Values of a claim's keys that are tables or lists of formulas: name = value, degree = polynomial, rows, functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.claims import document
from canon.claims.names import Names
from canon.errors import InputError
from canon.expression import Formula, Vocabulary

HIGHEST_DEGREE: Final = 20


@dataclass(frozen=True)
class Given:
    """What a key's formulas are read with.

    **Arguments:** the file's `names`; the `vocabulary`, with the claim's own names; `parameter`, the symbol of a name
    at a place; `formula`, the reader of a formula in the variables that the key allows.
    """

    names: Names
    vocabulary: Vocabulary
    parameter: Callable[[str, str], sp.Symbol]
    formula: Callable[[Any, str], Formula]


def _unknown(given: Given, word: str) -> str:
    return given.vocabulary.unknown(word, compared=given.names.measure.compares(given.vocabulary.words))


def _call(given: Given, text: Any, where: str) -> sp.Expr:
    """A function that the file declares, of different names."""
    call = given.formula(text, where).expr
    arguments = call.args if isinstance(call, AppliedUndef) else ()
    if not arguments or len(set(arguments)) < len(arguments) or not all(a.is_Symbol for a in arguments):
        raise InputError('a declared function of different names is expected, as "x(t)"', where)
    return call


def _tables(given: Given, value: Any, where: str) -> tuple[dict[sp.Symbol, Formula], ...]:
    """The tables name = value of `solutions`."""
    found = list[dict[sp.Symbol, Formula]]()
    for i, item in enumerate(document.listing(value, where), 1):
        place = f"{where}, table {i}"
        solution: dict[sp.Symbol, Formula] = {}
        for word, stated in document.table(item, place).items():
            if not given.vocabulary.declares(word):
                raise InputError(_unknown(given, word), place)
            solution[given.parameter(word, place)] = given.formula(stated, f"{place}, {word!r}")
        if not solution:
            raise InputError("the table is empty", place)
        found.append(solution)
    if not found:
        raise InputError("at least one table name = value is expected", where)
    return tuple(found)


def _functions(given: Given, value: Any, where: str) -> dict[sp.Expr, Formula]:
    """The table "x(t)" = formula: functions that the file declares, of different names, each with its formula."""
    found: dict[sp.Expr, Formula] = {}
    for text, stated in document.table(value, where).items():
        place = f"{where}, {text[:80]!r}"
        call = _call(given, text, place)
        if any(call.func == other.func for other in found):
            raise InputError(f"{call.func.__name__!r} is given twice", place)
        found[call] = given.formula(stated, place)
    if not found:
        raise InputError('at least one function is expected, as in "x(t)" = "A*cos(t)"', where)
    for formula in found.values():
        for name in sorted({call.func.__name__ for call in found} & {name for name, _ in formula.calls}):
            raise InputError(f"the formula {formula} contains {name!r} itself: write it out", where)
    return found


def _calls(given: Given, value: Any, where: str) -> tuple[sp.Expr, ...]:
    found = tuple(_call(given, text, where) for text in document.listing(value, where))
    if not found or len({call.func for call in found}) < len(found):
        raise InputError('different functions are expected, as in ["u(x, t)"]', where)
    return found


def _degrees(given: Given, value: Any, where: str) -> dict[int, Formula]:
    """The table degree = polynomial of a normal form."""
    found: dict[int, Formula] = {}
    for word, stated in document.table(value, where).items():
        if not (word.isdecimal() and 2 <= int(word) <= HIGHEST_DEGREE):
            raise InputError(f"degrees from 2 to {HIGHEST_DEGREE} are expected, not {word[:80]!r}", where)
        if int(word) in found:
            raise InputError(f"the degree {int(word)} stands there twice", where)
        found[int(word)] = given.formula(stated, f"{where}, degree {word}")
    return found


def _fixed(given: Given, value: Any, where: str) -> dict[sp.Symbol, Formula]:
    """The table name = expression of what is held fixed: parameters, energy, or old variables."""
    found: dict[sp.Symbol, Formula] = {}
    for word, stated in document.table(value, where).items():
        symbol = given.vocabulary.symbols.get(word)
        if symbol is None:
            raise InputError(_unknown(given, word), where)
        found[symbol] = given.formula(stated, f"{where}, {word!r}")
    return found


def _square(given: Given, value: Any, where: str) -> tuple[tuple[Formula, ...], ...]:
    rows = document.listing(value, where)
    if not rows or any(len(document.listing(row, where)) != len(rows) for row in rows):
        raise InputError("a square matrix is expected, as nested lists", where)
    return tuple(
        tuple(given.formula(v, f"{where}, row {i}, column {j}") for j, v in enumerate(row, 1))
        for i, row in enumerate(rows, 1)
    )


def _fields(given: Given, value: Any, where: str) -> tuple[tuple[Formula, ...], ...]:
    """Vector fields along a path, each with a component for each coordinate; one expression for one coordinate."""
    n = len(given.names.space.q)
    if isinstance(value, str) and n == 1:
        return ((given.formula(value, where),),)
    rows = document.listing(value, where)
    if not rows or any(len(document.listing(row, where)) != n for row in rows):
        raise InputError(f"a list of fields is expected, each a list of {n} components", where)
    return tuple(
        tuple(given.formula(v, f"{where}, field {i}, component {j}") for j, v in enumerate(row, 1))
        for i, row in enumerate(rows, 1)
    )


FORMS: Final[Mapping[str, Callable[[Given, Any, str], Any]]] = {
    "tables": _tables,
    "functions": _functions,
    "calls": _calls,
    "degrees": _degrees,
    "values": _fixed,
    "square": _square,
    "fields": _fields,
}
"""The readers by the form of a key; each **raises** `InputError` with the place."""
