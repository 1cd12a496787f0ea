"""Derivatives of long sums, term by term: a term is differentiated by the symbols that it has, and by no others."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any

import sympy as sp

from canon.expected import formula_of
from canon.numeric.pair_sum import PairSum


@lru_cache(maxsize=128)
def gradient(expression: Any, symbols: tuple[sp.Symbol, ...]) -> tuple[Any, ...]:
    """∂/∂x of the expression for every symbol x. Of a sum with N terms of few symbols each that takes O(N)."""
    terms: dict[Any, list[Any]] = {symbol: [] for symbol in symbols}
    for term in sp.Add.make_args(formula_of(expression, "")):
        for symbol, value in _slopes(term, terms):
            terms[symbol].append(value)
    return tuple(sp.Add(*values) for values in terms.values())


def monomial(term: Any) -> tuple[Any, dict[Any, Any]] | None:
    """A term that is a number times powers of symbols, as (number, {symbol: whole exponent}); None where it isn't."""
    number, powers = sp.S.One, {}
    for factor in sp.Mul.make_args(term):
        base, exponent = factor.as_base_exp()
        if factor.is_number:
            number = number * factor
        elif base.is_Symbol and exponent.is_Integer:
            powers[base] = exponent
        else:
            return None
    return number, powers


def _slopes(term: Any, wanted: dict[Any, list[Any]]) -> Iterable[tuple[Any, Any]]:
    if isinstance(term, PairSum):
        yield from ((symbol, slope) for symbol, slope in term.slopes() if symbol in wanted)
        return
    found = monomial(term)
    if found is None:
        yield from ((symbol, term.diff(symbol)) for symbol in term.free_symbols if symbol in wanted)
        return
    number, powers = found
    for symbol, exponent in powers.items():
        if symbol in wanted:
            # many times as fast as sympy's derivative, for the one kind of term that there are thousands of
            others = (x**e for x, e in powers.items() if x != symbol)
            yield symbol, sp.Mul(number, exponent, symbol ** (exponent - 1), *others)


def poisson_terms(f: Any, H: Any, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> list[Any]:
    """The products whose sum is {f, H}, those that are 0 left out."""
    places = (*q, *p)
    df, dH = gradient(f, places), gradient(H, places)
    n = len(q)
    pairs = [(df[k], dH[n + k]) for k in range(n)] + [(-df[n + k], dH[k]) for k in range(n)]
    return [a * b for a, b in pairs if a != 0 and b != 0]
