"""Long polynomials as a table of coefficients and exponents, in place of thousands of operations written out.

A potential of two thousand monomials is a program of ten thousand operations, which takes XLA a quarter of a minute to
compile; as powers of each variable, looked up and multiplied, it is a dozen operations on arrays, however many terms.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.numeric.gradient import monomial

MANY: Final = 1500
"""Terms of all formulas together from which on they are a table. Written out they take a millisecond each to compile,
and are evaluated two to three times as fast."""
HIGHEST: Final = 64
"""Exponents up to which powers are looked up."""


def term_table(
    expressions: Sequence[Any], arguments: Sequence[sp.Symbol]
) -> tuple[Callable[..., tuple[Any, ...]], tuple[Any, ...]] | None:
    """The function (values of the arguments, module) -> the sum of each expression's monomials, and what else each
    expression has; None where the monomials of all of them are fewer than `MANY`.
    """
    if sum(len(e.args) for e in expressions if e.is_Add) < MANY:
        return None
    index = {symbol: k for k, symbol in enumerate(arguments)}
    rows, exponents, coefficients, rests = list[int](), list[list[int]](), list[float](), list[Any]()
    for row, expression in enumerate(expressions):
        left = []
        for term in sp.Add.make_args(expression):
            found = monomial(term)
            if found is None or not _listed(*found, index):
                left.append(term)
                continue
            powers = [0] * len(arguments)
            for symbol, exponent in found[1].items():
                powers[index[symbol]] = int(exponent)
            rows.append(row)
            exponents.append(powers)
            coefficients.append(float(found[0]))
        rests.append(sp.Add(*left))
    if len(rows) < MANY:
        return None
    return _summed(len(expressions), np.array(rows), np.array(exponents), np.array(coefficients)), tuple(rests)


def _listed(number: Any, powers: dict[Any, Any], index: dict[Any, int]) -> bool:
    if not (number.is_Rational or number.is_Float) or not powers or not np.isfinite(float(number)):
        return False
    return all(symbol in index and 0 < exponent <= HIGHEST for symbol, exponent in powers.items())


def _summed(count: int, rows: Any, exponents: Any, coefficients: Any) -> Callable[..., tuple[Any, ...]]:
    used = [k for k in range(exponents.shape[1]) if exponents[:, k].any()]
    ends = np.searchsorted(rows, np.arange(count + 1))

    def function(values: Sequence[Any], numbers: Any) -> tuple[Any, ...]:
        columns = numbers.broadcast_arrays(*(numbers.asarray(values[k], float) for k in used))
        shape = (-1,) + (1,) * columns[0].ndim
        terms = coefficients.reshape(shape)
        for k, column in zip(used, columns, strict=True):
            powers = [numbers.ones_like(column)]
            for _ in range(int(exponents[:, k].max())):
                powers.append(powers[-1] * column)
            terms = terms * numbers.stack(powers)[exponents[:, k]]
        return tuple(terms[first:last].sum(axis=0) for first, last in pairwise(ends))

    return function
