"""Values of parameters at which expressions might vanish for all values of the variables: guesses for the decider."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import sympy as sp

from canon.claims.show import FAILURES, is_steep, neat
from canon.mechanics.formulas import replaced

LONGEST = 100
MOST_NAMES = 5
DEPTH = 3
MOST = 6
MOST_STEPS = 60
"""How many equations are solved in all: work is counted, not timed, so that every machine finds the same."""

Table = dict[sp.Symbol, sp.Expr]


def solutions(expressions: Sequence[sp.Expr], names: Sequence[sp.Symbol]) -> list[Table]:
    """Up to six tables of values of the parameters `names`; none is more than a guess."""
    found: list[Table] = []
    if not names or len(names) > 4:
        return found
    for table in _search(list(expressions), list(names), {}, DEPTH, iter(range(MOST_STEPS))):
        if table and table not in found:
            found.append(table)
        if len(found) >= MOST:
            break
    return found


def _search(
    expressions: list[sp.Expr], names: list[sp.Symbol], known: Table, depth: int, steps: Iterator[int]
) -> Iterator[Table]:
    """Solve one factor that contains parameters alone, put the result in, and go on while `steps` last."""
    open_expressions = [neat(e) for e in expressions if neat(e) != 0]
    if not open_expressions:
        yield known
        return
    if depth == 0:
        return
    for factor in _factors(open_expressions, names):
        for name in names:
            if name not in factor.free_symbols or not factor.is_polynomial(name):
                continue
            if sp.Poly(factor, name).degree() > 2:
                continue
            if next(steps, None) is None:
                return
            for value in sp.solve(factor, name):
                step = {name: value}
                table = {**{k: replaced(v, step) for k, v in known.items()}, **step}
                rest = [replaced(e, step) for e in open_expressions]
                if any(e.has(sp.zoo, sp.nan, sp.oo) for e in rest):
                    continue
                yield from _search(rest, [n for n in names if n != name], table, depth - 1, steps)
            break


def _factors(expressions: Sequence[sp.Expr], names: Sequence[sp.Symbol]) -> list[sp.Expr]:
    """Expressions in parameters alone, one of which must vanish: factors of the expressions or of their derivatives."""
    parameters = set(names)
    found: dict[sp.Expr, None] = {}
    for expression in sorted(expressions, key=sp.count_ops)[:3]:
        if sp.count_ops(expression) > LONGEST:
            continue
        variables = sorted((s for s in expression.free_symbols if s not in parameters), key=str)
        for candidate in (expression, *(sp.diff(expression, x) for x in variables[:3])):
            if candidate == 0 or sp.count_ops(candidate) > LONGEST or is_steep(candidate):
                continue
            numerator: Any = sp.fraction(sp.together(neat(candidate)))[0]
            if sp.count_ops(numerator) > LONGEST or len(numerator.free_symbols) > MOST_NAMES:
                continue
            try:
                numerator = sp.factor(numerator)
            except FAILURES:
                continue
            for factor in sp.Mul.make_args(numerator):
                base = factor.base if isinstance(factor, sp.Pow) else factor
                if base.free_symbols and base.free_symbols <= parameters and base.is_polynomial(*names):
                    found.setdefault(base)
            if found:
                break
    return list(found)[:4]
