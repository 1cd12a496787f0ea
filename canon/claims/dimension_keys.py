"""Dimensions as a claim file writes them: products of powers of base quantities, "M*L**2/T**2"."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Final

import sympy as sp

from canon.claims import document
from canon.claims.names import Names
from canon.errors import InputError
from canon.expression import Vocabulary, read

Dimension = Mapping[str, Fraction]
"""The power of each base that occurs."""
Dimensions = Mapping[str, tuple[Dimension, ...]]
"""Each name's dimension; for an arbitrary function its own, then those of its arguments."""

BASES: Final = ("L", "M", "T", "I", "Theta", "N", "J")
"""Length, mass, time, electric current, temperature, amount of substance, luminous intensity (ISO 80000-1)."""


def bases_of(table: document.Table) -> tuple[str, ...]:
    """The base quantities of a claim: its key `base`, or those of the SI."""
    return document.names(table["base"], document.key("base")) if "base" in table else BASES


def read_dimension(value: Any, bases: tuple[str, ...], where: str) -> Dimension:
    """A product of rational powers of the bases; 1 is a pure number. **Raises:** `InputError`."""
    symbols = {name: sp.Symbol(name, positive=True) for name in bases}
    text = document.expression_text(value, where)
    expression: Any = read(text, Vocabulary(symbols=symbols), where).expr
    found: dict[str, Fraction] = {}
    for base, exponent in expression.as_powers_dict().items():
        if base == 1:
            continue
        if not (base.is_Symbol and exponent.is_Rational):
            wanted = ", ".join(bases)
            raise InputError(f"a product of rational powers of {wanted} is expected, not {text[:80]}", where)
        found[str(base)] = Fraction(int(exponent.p), int(exponent.q))
    return found


def read_dimensions(value: Any, bases: tuple[str, ...], names: Names, where: str) -> Dimensions:
    """The table name = dimension, or function = [dimension, those of its arguments]. **Raises:** `InputError`."""
    found: dict[str, tuple[Dimension, ...]] = {}
    for name, given in document.table(value, where).items():
        place = f"{where}, {name[:80]!r}"
        if not names.vocabulary.declares(name):
            compared = names.measure.compares(names.vocabulary.words)
            raise InputError(names.vocabulary.unknown(name, compared=compared), place)
        if name in names.vocabulary.definitions:
            raise InputError(f"{name!r} is an abbreviation: its dimension follows from its formula", place)
        is_function = name in names.vocabulary.functions
        if is_function != isinstance(given, list):
            wanted = "a list, its own dimension and those of its arguments," if is_function else "a dimension"
            raise InputError(f"{wanted} is expected", place)
        listed = given if isinstance(given, list) else [given]
        found[name] = tuple(read_dimension(item, bases, place) for item in listed)
    return found


def written(dimension: Dimension) -> str:
    """The dimension as text."""
    parts = [base if power == 1 else f"{base}**({power})" for base, power in sorted(dimension.items())]
    return "*".join(parts).replace("**(2)", "**2").replace("**(3)", "**3") or "1"
