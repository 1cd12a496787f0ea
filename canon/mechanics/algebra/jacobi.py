"""Jacobi's identity for a table of brackets."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import combinations

from canon.mechanics.algebra.coefficients import Combination, Number, increase, is_zero, times

Table = Mapping[tuple[int, int], Combination]


def both_orders(table: Table) -> dict[tuple[int, int], Combination]:
    """[e_a, e_b] for a < b, and so for a > b."""
    turned = {(b, a): {c: times(v, Fraction(-1)) for c, v in row.items()} for (a, b), row in table.items()}
    return {**table, **turned}


def jacobi_failure(table: Table, size: int) -> tuple[tuple[int, int, int], Combination] | None:
    """The first triple whose cyclic sum [a, [b, c]] + … isn't proved to be 0, and that sum; None where there is none.

    `table` has the brackets in both orders. A sum that isn't certainly nonzero either is returned where no other is.
    """
    empty: Combination = {}
    unknown = None
    for a, b, c in combinations(range(size), 3):
        inner = (
            (a, table.get((b, c), empty)),
            (b, table.get((c, a), empty)),
            (c, table.get((a, b), empty)),
        )
        total: dict[int, Number] = {}
        for outer, row in inner:
            for d, u in row.items():
                for e, v in table.get((outer, d), empty).items():
                    increase(total, e, times(u, v))
        answers = {e: is_zero(value) for e, value in total.items()}
        left = {e: total[e] for e, answer in answers.items() if not answer}
        if False in answers.values():
            return (a, b, c), left
        if left and unknown is None:
            unknown = (a, b, c), left
    return unknown
