"""Tables of brackets as they are given: exact real numbers, each pair once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import shown
from canon.expected import table as is_table
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
