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
from canon.sign import is_complex, known_sign

VARIED = ("velocities", "accelerations", "coordinates", "constants", "energy", "parameter", "first", "second")
"""Keys whose names are differentiated by."""
ASSUMED = ("integer", "positive", "negative", "nonnegative", "nonzero", "real")
"""Words for what is assumed of a name."""
SHOWS = {
    "positive": ("positive",),
    "negative": ("negative",),
    "nonnegative": ("positive", "nonnegative", "zero"),
    "nonzero": ("positive", "negative", "nonzero"),
}
"""Signs of a formula, where it is defined, that show it."""
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


def are_allowed(claim: Claim) -> None:
    """**Raises** `InputError` where a name is `fixed` to what isn't seen to be what is assumed of the name.

    H is simplified by that: √a² is a where a is positive, and cos 2πn is 1 for whole numbers n.
    """
    for name, value in dict(claim.keys.get("fixed") or {}).items():
        expression = value.expr if isinstance(value, Formula) else value
        for word in ASSUMED if isinstance(name, sp.Symbol) else ():
            if getattr(name, f"is_{word}") and not _is_seen_to_be(word, sp.sympify(expression)):
                seen = f"{name} is {word}, and {expression} is not seen to be"
                raise InputError(f"{seen}: say more of its names, or less of {name}", "key 'fixed'")


def _is_seen_to_be(word: str, expression: Any) -> bool:
    if word == "real":
        return not is_complex(expression)
    return bool(getattr(expression, f"is_{word}")) or known_sign(expression) in SHOWS.get(word, ())


def of_integers(name: Any, where: str) -> None:
    """**Raises** `InputError` for a name that is an integer, by which there is no derivative."""
    if isinstance(name, sp.Symbol) and name.is_integer:
        raise InputError(f"{name} is an integer: there is no derivative by it", where)


def is_free_of(formula: Formula, names: Iterable[sp.Symbol], what: str, where: str) -> None:
    """**Raises** `InputError` where the formula, called `what`, contains one of the names that a key declares."""
    for symbol in sorted(formula.expr.free_symbols & {*names}, key=str):
        raise InputError(f"{symbol} is in {what} too: what a claim varies needs a name of its own", where)
