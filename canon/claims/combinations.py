"""Linear combinations: of a basis that a claim names, with coefficients in which no name of it is."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, Final

import sympy as sp

from canon.errors import InputError
from canon.measure import Measure
from canon.mechanics.vanishing import vanishes_multiplied_out

TERM: Final = 50
SLOPE: Final = 3
"""Microseconds that a combination, the derivative of a term, and of a node in it take, about."""
NORMAL: Final = 20
"""The same of its normal form."""


def coefficients(
    expression: Any, basis: Collection[sp.Symbol], measure: Measure, where: str
) -> dict[sp.Symbol, Any] | None:
    """The coefficients of a linear combination Σ cᵢ bᵢ, those that aren't 0; None where it isn't seen to be one.

    **Raises:** `InputError` where to find out takes more work than reading may.
    """
    _spend(measure, TERM, where)
    own, slopes, rests = {*basis}, dict[sp.Symbol, list[Any]](), list[Any]()
    for term in sp.Add.make_args(expression):
        named: set[Any] = term.free_symbols & own
        _spend(measure, (TERM + SLOPE * measure.size(term)) * len(named), where)
        parts = {symbol: term.diff(symbol) for symbol in sorted(named, key=str)}
        if any(slope.free_symbols & own for slope in parts.values()):
            return None
        rests.append(term - sp.Add(*(slope * symbol for symbol, slope in parts.items())))
        for symbol, slope in parts.items():
            slopes.setdefault(symbol, []).append(slope)
    if (rest := sp.Add(*rests)) != 0 and not seen_to_vanish(rest, measure, where):
        return None
    return {symbol: total for symbol, parts in slopes.items() if (total := sp.Add(*parts)) != 0}


def seen_to_vanish(expression: Any, measure: Measure, where: str) -> bool:
    """Whether it is shown that an expression is 0. **Raises:** `InputError` as `coefficients`."""
    _spend(measure, NORMAL * (100 + measure.size(expression)), where)
    return vanishes_multiplied_out(expression) is True


def _spend(measure: Measure, effort: int, where: str) -> None:
    try:
        measure.spend(effort)
    except InputError as error:
        raise error.at(where) from None
