"""Which variables the formulas of a claim may use: of one made in Python, those that a file's reader leaves open.

A structure constant that is a function on phase space, or an energy that moves, makes true equations of false claims.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

import sympy as sp

from canon.claim import Claim
from canon.claims.keys import KEYS, WRITTEN, Key
from canon.errors import InputError
from canon.expression import Formula

_WORDS: Final = {
    "parameters": "an expression in parameters alone",
    "lagrangian": "a formula of velocities and of the coordinates",
    "jet": "a formula of accelerations, velocities and coordinates",
    "integral": "a formula of the coordinates and of the constants",
    "constant": "an expression of the constants",
    "group": "a formula of the group's parameters",
    "coordinates": "a formula of the coordinates that have the tensor's brackets",
}
_CONSTANTS: Final = "brackets"
"""The form of the structure constants that are claimed."""


def check_variables(claim: Claim) -> None:
    """**Raises** `InputError` for a formula of variables that have no place in it.

    Formulas of old, of new and of mixed variables are looked at where they are decided about.
    """
    known = KEYS[claim.kind].keys
    for name, value in claim.keys.items():
        entry = known[WRITTEN.get(name, name)]
        side = "parameters" if entry.form == _CONSTANTS else entry.side
        own = "coordinates" if claim.keys.get("coordinates") is not None and side == "old" else side
        if own not in _WORDS:
            continue
        closed = _closed(claim, own, entry)
        words = _WORDS["constant" if entry.form == "constant" else own]
        for formula in _formulas(value):
            for symbol in sorted(formula.symbols & closed, key=str):
                raise InputError(f"{symbol} is out of place: this is {words}", f"key {WRITTEN.get(name, name)!r}")


def _closed(claim: Claim, side: str, entry: Key) -> set[Any]:
    space = claim.subject.space
    moving = {*space.old, *space.new}
    if side == "parameters":
        return moving | {space.t}
    words = {"integral": ("constants",), "group": ("first", "second"), "coordinates": ("coordinates",)}.get(side, ())
    mine = {symbol for word in words for symbol in claim.keys.get(word) or ()}
    coordinates = side in ("lagrangian", "jet") or (side == "integral" and entry.form != "constant")
    return moving - mine - (set(space.q) if coordinates else set())


def _formulas(value: Any) -> Iterator[Formula]:
    """The formulas in a key's value: itself, or those of its lists and tables."""
    if isinstance(value, Formula):
        yield value
    elif isinstance(value, Mapping):
        for part in value.values():
            yield from _formulas(part)
    elif isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        for part in value:
            yield from _formulas(part)
    elif isinstance(value, sp.MatrixBase):
        yield from (Formula(part) for part in value.flat())
