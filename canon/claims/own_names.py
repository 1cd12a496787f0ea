"""Names that a claim declares for something of its own: a formula that has another thing of that name is another claim.

The constant of a complete integral, the energy by which a frequency is differentiated, a velocity, the parameters of
another element of a group: in H, or wherever they would be a fixed parameter of the system, they would be varied with
it. W = √(2mE) q solves p²/(2m) = E for every mass m, but m is no constant of integration.
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from canon.errors import InputError
from canon.expression import Formula


def is_free_of(formula: Formula, names: Iterable[sp.Symbol], what: str, where: str) -> None:
    """**Raises** `InputError` where the formula, called `what`, contains one of the names that a key declares."""
    for symbol in sorted(formula.expr.free_symbols & {*names}, key=str):
        raise InputError(f"{symbol} is in {what} too: what a claim varies needs a name of its own", where)
