"""The one door from sympy's formulas to jax's functions: common subexpressions shared, numbers in float64."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Any, Final

import sympy as sp

from canon.errors import InputError
from canon.numeric.pair_kernel import pair_slopes, pair_total
from canon.numeric.pair_sum import SQUARE, PairSlope, PairSum
from canon.numeric.term_table import term_table

Lowered = Callable[..., tuple[Any, ...]]

_NAMES: Final[dict[Any, str]] = {
    sp.exp: "exp",
    sp.log: "log",
    sp.sin: "sin",
    sp.cos: "cos",
    sp.tan: "tan",
    sp.asin: "arcsin",
    sp.acos: "arccos",
    sp.atan: "arctan",
    sp.atan2: "arctan2",
    sp.sinh: "sinh",
    sp.cosh: "cosh",
    sp.tanh: "tanh",
    sp.asinh: "arcsinh",
    sp.acosh: "arccosh",
    sp.atanh: "arctanh",
    sp.Abs: "abs",
    sp.sign: "sign",
}
_RECIPROCALS: Final[dict[Any, str]] = {sp.cot: "tan", sp.sec: "cos", sp.csc: "sin", sp.coth: "tanh"}


@lru_cache(maxsize=256)
def lower(expressions: tuple[sp.Expr, ...], arguments: tuple[sp.Symbol, ...]) -> Lowered:
    """The jax function of `arguments`, in this order, whose values are those of the expressions.

    It is elementwise: scalars or arrays of one shape. Subexpressions that occur twice are computed once; rational
    numbers are rounded to the nearest double. Nothing is compiled here; with `numbers=numpy` it is numpy's.

    **Raises:** `InputError` for a name that is no argument, or a function that has no numerical form.
    """
    free = {symbol for expression in expressions for symbol in expression.free_symbols} - {*arguments}
    if free:
        names = ", ".join(sorted(map(str, free)))
        raise InputError(f"no value is given for {names}: give one in `parameters`")
    table, expressions = term_table(expressions, arguments) or (None, expressions)
    shared, reduced = sp.cse(list(expressions), order="none")
    for expression in (*(value for _, value in shared), *reduced):
        for part in sp.preorder_traversal(expression):
            _check(part)

    def function(*values: Any, numbers: Any = None) -> tuple[Any, ...]:
        numbers = numbers or _jax()
        place: dict[Any, Any] = dict(zip(arguments, values, strict=True))
        for name, value in shared:
            place[name] = _value(value, place, numbers)
        found = tuple(_value(value, place, numbers) for value in reduced)
        if table is None:
            return found
        return tuple(a + b for a, b in zip(table(values, numbers), found, strict=True))

    return function


def _jax() -> Any:
    import jax.numpy

    return jax.numpy


def lower_map(
    expressions: Sequence[sp.Expr], arguments: Sequence[sp.Symbol], parameters: Mapping[sp.Symbol, Any]
) -> Callable[[Any], Any]:
    """The jax function z -> (values of the expressions), one array to one array, at fixed parameters."""
    names = tuple(parameters)
    fixed = tuple(float(parameters[name]) for name in names)
    function = lower(tuple(expressions), (*arguments, *names))

    def mapped(z: Any) -> Any:
        import jax.numpy as jnp

        values = function(*(z[k] for k in range(len(arguments))), *fixed)
        return jnp.stack([jnp.broadcast_to(jnp.asarray(value, z.dtype), z.shape[1:]) for value in values])

    return mapped


def _check(part: Any) -> None:
    """Raise unless the node is one that `_value` knows."""
    if (
        isinstance(part, (sp.Add, sp.Mul, sp.Pow, sp.Symbol, PairSum, PairSlope))
        or part.func in _NAMES
        or part.func in _RECIPROCALS
    ):
        return
    if part.is_number and part.is_real and not part.args:
        return
    if part is sp.I or part.has(sp.I):
        raise InputError("a complex formula: audits are of real maps")
    raise InputError(f"{part.func} has no numerical form here")


def pair_values(expression: PairSum | PairSlope, place: Mapping[Any, Any], places: Any, numbers: Any) -> Any:
    """A sum over pairs (…), or its slopes (B, d, …), of the bodies' places (B, d, …); `place` has the time, `numbers`
    is the module to compute with.
    """
    of, formula = (expression, "squared_law") if isinstance(expression, PairSum) else (expression.of, "slope")
    law = getattr(of, formula)
    rest = {symbol: place[symbol] for symbol in law.free_symbols if symbol != SQUARE}
    sums: Any = pair_total if isinstance(expression, PairSum) else pair_slopes
    weights = [float(w) for w in of.weights]
    return sums(lambda square: _value(law, {**rest, SQUARE: square}, numbers), places, weights, numbers)


def _of_pairs(expression: PairSum | PairSlope, place: dict[Any, Any], numbers: Any) -> Any:
    """The same of coordinates one by one; all slopes of a sum are found with the first of them."""
    of = expression if isinstance(expression, PairSum) else expression.of
    known = (type(expression), of)
    if known not in place:
        columns = [numbers.asarray(place[x], float) for x in of.coordinates]
        rows = numbers.stack(numbers.broadcast_arrays(*columns))
        place[known] = pair_values(expression, place, rows.reshape(len(of.places), -1, *rows.shape[1:]), numbers)
    found = place[known]
    return found if isinstance(expression, PairSum) else found.reshape(-1, *found.shape[2:])[expression.index]


def _double(number: sp.Rational) -> float:
    try:
        return int(number.p) / int(number.q)
    except OverflowError:
        raise InputError("a number of more than 308 digits arises, which is beyond double precision") from None


def _value(expression: Any, place: dict[Any, Any], numbers: Any) -> Any:
    if expression in place:
        return place[expression]
    if isinstance(expression, (PairSum, PairSlope)):
        return _of_pairs(expression, place, numbers)
    if isinstance(expression, sp.Rational):
        return _double(expression)
    if not expression.args:
        return float(expression)
    if isinstance(expression, sp.Pow):
        return _power(expression, place, numbers)
    values = [_value(argument, place, numbers) for argument in expression.args]
    if isinstance(expression, sp.Add):
        return sum(values[1:], start=values[0])
    if isinstance(expression, sp.Mul):
        product = values[0]
        for value in values[1:]:
            product = product * value
        return product
    if expression.func in _RECIPROCALS:
        return 1 / getattr(numbers, _RECIPROCALS[expression.func])(values[0])
    return getattr(numbers, _NAMES[expression.func])(*values)


def _power(expression: Any, place: dict[Any, Any], numbers: Any) -> Any:
    base, exponent = _value(expression.base, place, numbers), expression.exp
    if exponent.is_Integer:
        return base ** int(exponent) if exponent > 0 else 1 / base ** int(-exponent)
    if exponent.is_Rational and exponent.q == 2:
        root = numbers.sqrt(base)
        odd = abs(int(exponent.p))
        power = root if odd == 1 else root**odd
        return power if exponent > 0 else 1 / power
    return numbers.power(base, _value(exponent, place, numbers))
