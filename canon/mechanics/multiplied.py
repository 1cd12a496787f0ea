"""How many terms a formula has when it is multiplied out: what is asked before that is done."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import sympy as sp


def counted(expression: Any) -> Iterator[tuple[Any, int]]:
    """Each distinct part of an expression, with the terms that it has when it is multiplied out, at most."""
    counts: dict[Any, int] = {}
    for node in sp.postorder_traversal(expression):
        if node not in counts:
            counts[node] = _terms(node, counts)
            yield node, counts[node]


def _terms(node: Any, counts: Mapping[Any, int]) -> int:
    """The terms of a node, when those of its parts are known."""
    if node.is_Add:
        return sum(counts[part] for part in node.args)
    if node.is_Mul:
        return math.prod(counts[part] for part in node.args)
    if node.is_Pow and node.exp.is_Rational:
        return terms_of_power(counts[node.base], int(abs(node.exp)))
    return 1


def terms_of_power(terms: int, exponent: int) -> int:
    """The terms of a power of a sum of so many terms, at most."""
    return math.comb(terms + exponent - 1, exponent)
