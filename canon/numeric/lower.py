"""The one door from sympy's formulas to jax's functions: common subexpressions shared, numbers in float64."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Any, Final

import sympy as sp

from canon.errors import InputError

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
    numbers are rounded to the nearest double. Nothing is compiled here.

    **Raises:** `InputError` for a name that is no argument, or a function that has no numerical form.
    """
    free = {symbol for expression in expressions for symbol in expression.free_symbols} - {*arguments}
    if free:
        names = ", ".join(sorted(map(str, free)))
        raise InputError(f"no value is given for {names}: give one in `parameters`")
    shared, reduced = sp.cse(list(expressions), order="none")
    for expression in (*(value for _, value in shared), *reduced):
        for part in sp.preorder_traversal(expression):
            _check(part)

    def function(*values: Any) -> tuple[Any, ...]:
        place: dict[Any, Any] = dict(zip(arguments, values, strict=True))
        for name, value in shared:
            place[name] = _value(value, place)
        return tuple(_value(value, place) for value in reduced)

    return function


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
    if isinstance(part, (sp.Add, sp.Mul, sp.Pow, sp.Symbol)) or part.func in _NAMES or part.func in _RECIPROCALS:
        return
    if part.is_number and part.is_real and not part.args:
        return
    if part is sp.I or part.has(sp.I):
        raise InputError("a complex formula: audits are of real maps")
    raise InputError(f"{part.func} has no numerical form here")


def _value(expression: Any, place: Mapping[Any, Any]) -> Any:
    import jax.numpy as jnp

    if expression in place:
        return place[expression]
    if isinstance(expression, sp.Rational):
        return int(expression.p) / int(expression.q)
    if not expression.args:
        return float(expression)
    if isinstance(expression, sp.Pow):
        return _power(expression, place)
    values = [_value(argument, place) for argument in expression.args]
    if isinstance(expression, sp.Add):
        return sum(values[1:], start=values[0])
    if isinstance(expression, sp.Mul):
        product = values[0]
        for value in values[1:]:
            product = product * value
        return product
    if expression.func in _RECIPROCALS:
        return 1 / getattr(jnp, _RECIPROCALS[expression.func])(values[0])
    return getattr(jnp, _NAMES[expression.func])(*values)


def _power(expression: Any, place: Mapping[Any, Any]) -> Any:
    import jax.numpy as jnp

    base, exponent = _value(expression.base, place), expression.exp
    if exponent.is_Integer:
        return base ** int(exponent) if exponent > 0 else 1 / base ** int(-exponent)
    if exponent.is_Rational and exponent.q == 2:
        root = jnp.sqrt(base)
        odd = abs(int(exponent.p))
        power = root if odd == 1 else root**odd
        return power if exponent > 0 else 1 / power
    return jnp.power(base, _value(exponent, place))
