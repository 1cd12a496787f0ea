"""Tables of brackets as they are given, by position or by name: exact real numbers, each pair once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import instance_of, listed, shown
from canon.expected import table as is_table
from canon.expression import Vocabulary, read
from canon.mechanics.algebra.coefficients import Combination, Number, exact, is_zero, plus, times


class NotReal(InputError):
    """A structure constant that isn't real, or isn't seen to be."""


def antisymmetric(
    names: Sequence[str], given: Mapping[tuple[int, int], Combination]
) -> dict[tuple[int, int], dict[int, Number]]:
    """The brackets of pairs a < b that don't vanish, from those that are given for either order.

    **Raises:** `InputError` for a position that isn't one, a number that isn't exact and real, a bracket of an element
    with itself, or a pair that is given twice, differently.
    """
    table: dict[tuple[int, int], dict[int, Number]] = {}
    for pair, row in given.items():
        a, b = _positions(pair)
        is_table(row, "coefficients", f"constants, {shown(pair)}")
        if not all(k in range(len(names)) for k in (a, b, *row)):
            raise InputError(
                f"positions in the basis go from 0 to {len(names) - 1}: {(a, b)} or one of {list(row)} doesn't"
            )
        numbers = {c: value for c, value in ((c, exact(value)) for c, value in row.items()) if not is_zero(value)}
        for value in numbers.values():
            if not isinstance(value, Fraction) and _may_be_complex(value):
                raise NotReal(f"{value} isn't real, as structure constants of a real Lie algebra are")
        if a == b and numbers:
            raise InputError(f"the bracket of {names[a]} with itself is 0")
        if a > b:
            a, b, numbers = b, a, {c: times(value, Fraction(-1)) for c, value in numbers.items()}
        if not _same(table.setdefault((a, b), numbers), numbers):
            raise InputError(f"the bracket of {names[a]} and {names[b]} is stated twice, differently")
    return {pair: row for pair, row in table.items() if row}


def _positions(pair: Any) -> tuple[Any, Any]:
    if not isinstance(pair, tuple) or len(pair) != 2:
        raise InputError(f"a pair of positions in the basis is expected, as (0, 1), not {shown(pair)}", "constants")
    return pair[0], pair[1]


def _may_be_complex(value: Any) -> bool:
    """Whether i, or a name that is declared complex, is in a number that isn't seen to be real."""
    complex_names = any(symbol.is_complex and not symbol.is_real for symbol in value.free_symbols)
    return not value.is_real and (value.has(sp.I) or complex_names)


def _same(first: Combination, second: Combination) -> bool:
    """Whether two combinations are equal, number by number."""
    zero = Fraction(0)
    return first == second or all(
        is_zero(plus(first.get(c, zero), times(second.get(c, zero), Fraction(-1)))) for c in {*first, *second}
    )


def letters(names: Any) -> tuple[str, ...]:
    """The names of a basis; a text is one of single letters. **Raises:** `InputError` for what are no names."""
    given = tuple(names) if isinstance(names, str) else listed(names, "names", "names")
    for name in given:
        instance_of(name, str, "names")
        if not name.strip() or "," in name:  # a table's "A,B" takes it for two, or for none
            raise InputError(f"a name of the basis is expected, not {name!r}: they are given as ['A', 'B']", "names")
    return given


def positions_of(names: Sequence[str], brackets: Any) -> dict[tuple[int, int], dict[int, Any]]:
    """A table "A,B" = {C: coefficient}, or = a combination, by positions in the basis.

    **Raises:** `InputError` for a pair or a name that isn't of the basis.
    """
    is_table(brackets, "brackets", "brackets")
    places = {name: k for k, name in enumerate(names)}
    constants: dict[tuple[int, int], dict[int, Any]] = {}
    for pair, value in brackets.items():
        words = [word.strip() for word in pair.split(",")] if isinstance(pair, str) else []
        if len(words) != 2 or not set(words) <= set(places):
            raise InputError(f'a pair of the basis {", ".join(names)} is expected, as "A,B", not {pair!r}')
        row = value if isinstance(value, Mapping) else _coefficients(value, names)
        for name in row:
            if name not in places:
                raise InputError(f"{name!r} is none of the basis {', '.join(names)}")
        constants[places[words[0]], places[words[1]]] = {places[name]: number for name, number in row.items()}
    return constants


def _coefficients(value: Any, names: Sequence[str]) -> dict[str, Any]:
    if isinstance(value, str):
        value = read(value, Vocabulary(symbols={name: sp.Symbol(name) for name in names})).expr
    if not isinstance(value, sp.Expr):
        raise InputError(f"a linear combination of basis elements is expected, not {value!r}")
    expression: Any = sp.expand(value)
    own = {symbol for symbol in expression.free_symbols if symbol.name in names}
    found = {symbol.name: expression.coeff(symbol) for symbol in own}
    rest = expression - sp.Add(*(number * symbol for symbol in own for number in [found[symbol.name]]))
    if sp.expand(rest) != 0 or any(number.has(*own) for number in found.values()):
        raise InputError(f"a linear combination of basis elements is expected, not {value}")
    return found
