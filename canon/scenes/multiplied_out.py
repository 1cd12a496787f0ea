"""How many terms a formula has when it is multiplied out, which is what splittings and monitors do to it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from canon.errors import InputError
from canon.mechanics.multiplied import counted

if TYPE_CHECKING:
    from canon.scenes.model import Model

MOST: Final = 20_000
"""The most terms of one power or product, multiplied out: twenty thousand take sympy some seconds."""


def check_size(expression: Any, where: str) -> Any:
    """The expression itself. **Raises:** `InputError` where a power or product in it has too many terms."""
    for node, terms in counted(expression):
        if terms > MOST and not node.is_Add:
            reason = f"multiplied out it has more than {MOST} terms, which is too much: lower its powers"
            raise InputError(reason, where)
    return expression


def check_model(model: Model) -> None:
    """**Raises** `InputError`, with the effect, where a term of the Hamiltonian is too large to be multiplied out."""
    for part in (model, *model.beside):
        for term in part.terms:
            check_size(term.expr, f"effect {term.effect!r}" if term.effect else "")
