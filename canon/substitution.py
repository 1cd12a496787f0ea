"""Symbols replaced by expressions, all at once, the variables of derivatives of arbitrary functions being bound."""

from collections.abc import Mapping
from typing import Any

import sympy as sp

from canon.calls import at_places, derivative_of


def replaced(expression: Any, mapping: Mapping[Any, Any]) -> Any:
    """`expression` with all symbols of `mapping` replaced at once, inside derivatives of arbitrary functions too.

    The variable of a derivative is bound: ∂₁f(x, y) under x → x + y is (∂₁f)(x + y, y), whatever the names are.
    """
    if not expression.has(sp.Derivative, sp.Subs):
        return expression.xreplace(dict(mapping))
    if (found := at_places(expression)) is not None:
        call, orders, arguments = found
        return derivative_of(call, orders, [sp.sympify(replaced(argument, mapping)) for argument in arguments])
    if isinstance(expression, sp.Derivative):
        return _derivative(expression, mapping)
    if isinstance(expression, sp.Subs):
        bound: Any = expression.variables
        fresh = {v: _fresh(v) for v in bound}
        inner = replaced(expression.expr, {**mapping, **fresh})
        values: Any = expression.point
        point = tuple(replaced(at, mapping) for at in values)
        return sp.Subs(inner, tuple(fresh.values()), point)
    return expression.func(*(replaced(part, mapping) for part in expression.args))


def _derivative(derivative: Any, mapping: Mapping[Any, Any]) -> Any:
    """The derivative by variables of its own, at their images."""
    fresh: dict[Any, Any] = {v: _fresh(v) for v, _ in derivative.variable_count}
    inner = replaced(derivative.expr, {**mapping, **fresh})
    images = {own: sp.sympify(replaced(v, mapping)) for v, own in fresh.items()}
    others = inner.free_symbols - {*images}
    plain = {own: at for own, at in images.items() if at.is_Symbol and at not in others}
    if len({*plain.values()}) < len(plain):
        plain = {}
    names: dict[Any, Any] = {v: plain.get(own, own) for v, own in fresh.items()}
    found = inner.xreplace(plain).diff(*((names[v], n) for v, n in derivative.variable_count))
    left = {own: at for own, at in images.items() if own not in plain}
    return sp.Subs(found, tuple(left), tuple(left.values())) if left else found


def _fresh(symbol: Any) -> sp.Dummy:
    return sp.Dummy(symbol.name, **symbol.assumptions0)
