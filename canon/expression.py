"""The safe reader of formulas: text to a sympy expression and the conditions under which it is smooth.

A formula is data. Its text is parsed by `canon.syntax`, its names are looked up in a `Vocabulary`, and `canon.building`
makes its expression.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from canon.building import Builder
from canon.domain import Condition, leans_on_kinks, nonzero, positive, unique
from canon.errors import InputError
from canon.measure import Measure
from canon.syntax import parse, parse_relation
from canon.vocabulary import Formula, Vocabulary
from canon.whole_bounds import at_least_zero

__all__ = ["Formula", "Vocabulary", "read", "read_relation"]


def read(text: str, vocabulary: Vocabulary, where: str = "", measure: Measure | None = None) -> Formula:
    """The formula that `text` states.

    **Arguments:** `where`, the place of the text in its file, for errors; `measure`, one for all texts of a file.

    **Raises:** `InputError` with the place in the text: outside the language, a name that isn't declared or is out of
    place, a value that is undefined everywhere, or too large.
    """
    return _guarded(lambda: _read(text, vocabulary, measure), where)


def read_relation(
    text: str, vocabulary: Vocabulary, where: str = "", measure: Measure | None = None
) -> tuple[Condition, ...]:
    """The conditions that a chain of inequalities states, and those of its sides.

    `>=` says as much as `>`, since claims speak of the open part of a domain; but among whole numbers it is what it is.

    **Raises:** `InputError` as `read` does; for `==` too, and where the inequality can't hold anywhere.
    """
    return _guarded(lambda: _read_relation(text, vocabulary, measure), where)


def _guarded(reading: Callable[[], Any], where: str) -> Any:
    try:
        return reading()
    except InputError as error:
        raise error.at(where) from None
    except RecursionError:
        raise InputError("nested too deeply: use [definitions]", where) from None


def _read(text: str, vocabulary: Vocabulary, measure: Measure | None) -> Formula:
    builder = Builder(text, vocabulary, measure)
    value = builder.value_of(parse(text))
    written = " ".join(text.split())
    names, calls = frozenset(builder.names), frozenset(builder.calls)
    slopes, granted = frozenset(builder.slopes), tuple(builder.granted)
    conditions = tuple(builder.conditions.values())
    return Formula(value, conditions, written, names, builder.has_bracket, calls, slopes, granted)


def _read_relation(text: str, vocabulary: Vocabulary, measure: Measure | None) -> tuple[Condition, ...]:
    sides, signs = parse_relation(text)
    if "==" in signs:
        raise InputError("an equation restricts to a surface: write it as a difference under `on`")
    builder = Builder(text, vocabulary, measure)
    values = [builder.value_of(side) for side in sides]
    found = list[Condition]()
    for i, sign in enumerate(signs):
        left, right = (builder.source(side) for side in sides[i : i + 2])
        difference = builder.measure.admit(values[i] - values[i + 1])
        if builder.measure.is_complex(difference) and sign != "!=":
            raise InputError(f"{left} {sign} {right} compares complex values")
        make, written = (nonzero, "!=") if sign == "!=" else (positive, sign.rstrip("="))
        difference, closed = -difference if written == "<" else difference, ""
        if sign in ("<=", ">="):
            bound = at_least_zero(difference, f"{left} {sign} {right}")
            closed = f"{left} {sign} {right}" if bound is difference else ""
            difference, written = (difference, written) if closed else (bound, sign)
        try:
            conditions = make(difference)
        except InputError:
            raise InputError(f"the inequality {left} {sign} {right} can't hold anywhere") from None
        found += [Condition(c.kind, c.terms, f"{left} {written} {right}", closed) for c in conditions]
        if not conditions or any(leans_on_kinks(sp.log, (power,)) for power in difference.atoms(sp.Pow)):
            builder.drop_kinks([difference])
    return unique(builder.conditions.values(), found)
