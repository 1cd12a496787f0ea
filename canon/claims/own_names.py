"""Names that a claim declares for something of its own: a formula that has another thing of that name is another claim.

The constant of a complete integral, the energy by which a frequency is differentiated, a velocity, the parameters of
another element of a group: in H, or wherever they would be a fixed parameter of the system, they would be varied with
it. W = √(2mE) q solves p²/(2m) = E for every mass m, but m is no constant of integration.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import sympy as sp

from canon.claim import Claim
from canon.errors import InputError
from canon.expression import Formula

VARIED = ("velocities", "accelerations", "coordinates", "constants", "energy", "parameter", "first", "second")
"""Keys whose names are differentiated by."""
DISCRETE = ("matrix_group",)
"""Kinds that differentiate by none of them."""


def are_continuous(claim: Claim) -> None:
    """**Raises** `InputError` where a name that is differentiated by is an integer: cos 2πn is 1 for all integers n."""
    if claim.kind in DISCRETE:
        return
    for word in VARIED:
        value: Any = claim.keys.get(word)
        for item in value if isinstance(value, tuple | list) else (value,):
            of_integers(item.expr if isinstance(item, Formula) else item, f"key {word!r}")


def of_integers(name: Any, where: str) -> None:
    """**Raises** `InputError` for a name that is an integer, by which there is no derivative."""
    if isinstance(name, sp.Symbol) and name.is_integer:
        raise InputError(f"{name} is an integer: there is no derivative by it", where)


def is_free_of(formula: Formula, names: Iterable[sp.Symbol], what: str, where: str) -> None:
    """**Raises** `InputError` where the formula, called `what`, contains one of the names that a key declares."""
    for symbol in sorted(formula.symbols & {*names}, key=str):
        raise InputError(f"{symbol} is in {what} too: what a claim varies needs a name of its own", where)
