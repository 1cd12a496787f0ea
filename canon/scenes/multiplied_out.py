"""How many terms a formula has when it is multiplied out, which is what splittings and monitors do to it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

import sympy as sp

from canon.errors import InputError

if TYPE_CHECKING:
    from canon.scenes.model import Model

MOST: Final = 20_000
"""The most terms of one power or product, multiplied out: twenty thousand take sympy some seconds."""


def check_size(expression: Any, where: str) -> Any:
    """The expression itself. **Raises:** `InputError` where a power or product in it has too many terms."""
    counts: dict[Any, int] = {}
    for node in sp.postorder_traversal(expression):
        if node not in counts:
            counts[node] = _terms(node, counts)
            if counts[node] > MOST and not node.is_Add:
                reason = f"multiplied out it has more than {MOST} terms, which is too much: lower its powers"
                raise InputError(reason, where)
    return expression


def check_model(model: Model) -> None:
    """**Raises** `InputError`, with the effect, where a term of the Hamiltonian is too large to be multiplied out."""
    for part in (model, *model.beside):
        for term in part.terms:
            check_size(term.expr, f"effect {term.effect!r}" if term.effect else "")


def _terms(node: Any, counts: Mapping[Any, int]) -> int:
    """The terms of a node, when those of its parts are known."""
    if node.is_Add:
        return sum(counts[part] for part in node.args)
    if node.is_Mul:
        return math.prod(counts[part] for part in node.args)
    if node.is_Pow and node.exp.is_Rational:
        n, k = counts[node.base], int(abs(node.exp))
        return math.comb(n + k - 1, k)
    return 1
