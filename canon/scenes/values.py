"""The values of a scene file: exact numbers, vectors, and expressions in the names that are open to them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from decimal import Decimal
from typing import Any

import sympy as sp

from canon.claims import document
from canon.errors import InputError
from canon.expression import Vocabulary, read
from canon.measure import Measure
from canon.scenes.multiplied_out import check_size

_OF_FILE: ContextVar[Measure | None] = ContextVar("the measure of the file that is read", default=None)


@contextmanager
def one_file() -> Iterator[None]:
    """The formulas that are read inside are those of one file, and their work is counted together."""
    before = _OF_FILE.set(Measure())
    try:
        yield
    finally:
        _OF_FILE.reset(before)


def number(value: Any, where: str, *, positive: bool = False, least: float | None = None) -> Any:
    """An exact real number: a TOML number, or a constant expression as a string ("pi/2").

    **Raises:** `InputError` with the place.
    """
    if isinstance(value, Decimal) and not value.is_finite():
        raise InputError(f"a finite number is expected, not {value}", where)
    found: Any = read(document.expression_text(value, where), Vocabulary(), where, _OF_FILE.get()).expr
    if not found.is_real:
        raise InputError(f"a real number is expected, not {value!r}", where)
    if positive and not found.is_positive:
        raise InputError(f"a number above 0 is expected, not {value}", where)
    if least is not None and found < least:
        raise InputError(f"a number from {least} on is expected, not {value}", where)
    return found


def double(value: Any, where: str, *, positive: bool = False) -> float:
    """A number as a float, for what is not part of a formula. **Raises:** `InputError`."""
    found = float(number(value, where, positive=positive))
    if found in (float("inf"), float("-inf")) or (positive and found == 0.0):
        raise InputError(f"{value} is beyond double precision", where)
    return found


def numbers(value: Any, where: str, counts: Sequence[int]) -> tuple[Any, ...]:
    """A list of exact numbers, as many as one of `counts`. **Raises:** `InputError`."""
    items = document.listing(value, where, document.BIGGEST)
    if len(items) not in counts:
        wanted = " or ".join(map(str, counts))
        raise InputError(f"{len(items)} components where {wanted} are expected", where)
    return tuple(number(item, f"{where}, entry {i}") for i, item in enumerate(items, 1))


def matrix(value: Any, where: str, size: int) -> Any:
    """A square matrix of exact numbers. **Raises:** `InputError`."""
    rows = document.listing(value, where, document.BIGGEST)
    if len(rows) != size:
        raise InputError(f"{len(rows)} rows where {size} are expected: one for each coordinate that it acts on", where)
    return sp.ImmutableMatrix([numbers(row, f"{where}, row {i}", [size]) for i, row in enumerate(rows, 1)])


def expression(value: Any, names: Mapping[str, Any], where: str, undeclared: str = "") -> Any:
    """A number, or an expression in `names` (symbols or numbers by name), as sympy holds it.

    **Arguments:** `undeclared`, what to do with a name that is none of them; else they are listed.

    **Raises:** `InputError` with the place and the nearest known name, or where it is too large to be multiplied out.
    """
    if not isinstance(value, str):
        return number(value, where)
    symbols = {name: sp.Symbol(name, real=True) for name in names}
    advice = undeclared or f"the names here are {', '.join(names)}"
    found = read(value, Vocabulary(symbols, no_bracket="this is a scene", undeclared=advice), where, _OF_FILE.get())
    return check_size(found.expr, where).xreplace({symbol: names[name] for name, symbol in symbols.items()})


def expressions(value: Any, names: Mapping[str, Any], where: str, count: int) -> tuple[Any, ...]:
    """A list of `count` expressions. **Raises:** `InputError`."""
    items = document.listing(value, where, document.BIGGEST)
    if len(items) != count:
        raise InputError(f"{len(items)} components where {count} are expected", where)
    return tuple(expression(item, names, f"{where}, entry {i}") for i, item in enumerate(items, 1))


def needed(table: Mapping[str, Any], name: str, where: str) -> Any:
    """The value of a key that must be there. **Raises:** `InputError`."""
    if name not in table:
        raise InputError(f"the key {name!r} is missing", where)
    return table[name]


def exactly_one(table: Mapping[str, Any], names: Iterable[str], where: str) -> str:
    """Which one of several keys is given. **Raises:** `InputError` where none is, or more than one."""
    names = tuple(names)
    given = [name for name in names if name in table]
    if len(given) != 1:
        words = " or ".join(map(repr, names))
        raise InputError(f"one of {words} is expected" + (f", not {len(given)} of them" if given else ""), where)
    return given[0]


def text_of(value: Any) -> str:
    """A formula as text, its numbers as a person writes them: short fractions, else decimals."""
    shown = {
        part: sp.Float(repr(float(part)))
        for part in value.atoms(sp.Rational)
        if part.q not in (1, 2, 3, 4, 6, 8, 12) or abs(part.p) > 999999
    }
    written: Any = value.xreplace(shown)
    return sp.sstr(written, full_prec=False)
