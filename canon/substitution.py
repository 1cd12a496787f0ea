"""Symbols replaced by expressions, all at once, the variables of derivatives of arbitrary functions being bound."""

from collections.abc import Iterable, Mapping
from typing import Any, Final

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.calls import at_places, derivative_of
from canon.constants import FRAGILE, constant, is_constant, put_in
from canon.errors import InputError

QUOTIENTS: Final[dict[Any, tuple[Any, Any]]] = {
    sp.tan: (sp.sin, sp.cos), sp.cot: (sp.cos, sp.sin), sp.tanh: (sp.sinh, sp.cosh), sp.coth: (sp.cosh, sp.sinh),
}  # fmt: skip
"""What is read as a quotient beside integers: sympy 1.14 makes tan x of tan(x + nπ + π/2), as it is written or whenever
something is put in for a name; and tangents of the others."""


def replaced(expression: Any, mapping: Mapping[Any, Any]) -> Any:
    """`expression` with all symbols of `mapping` replaced at once, inside derivatives of arbitrary functions too.

    The variable of a derivative is bound: ∂₁f(x, y) under x → x + y is (∂₁f)(x + y, y), whatever the names are.
    """
    if expression.has(*QUOTIENTS) and are_beside_integers((expression, *mapping.values())):
        expression = with_quotients(expression)
    if not expression.has(sp.Derivative, sp.Subs):
        return put_in(expression, mapping) if expression.has(*FRAGILE) else expression.xreplace(dict(mapping))
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
    arguments = [replaced(part, mapping) for part in expression.args]
    fragile = isinstance(expression, FRAGILE) and is_constant(arguments)
    return constant(expression.func, *arguments) if fragile else expression.func(*arguments)


def are_beside_integers(expressions: Iterable[Any]) -> bool:
    """Whether a name of theirs is an integer."""
    return any(symbol.is_integer for each in expressions for symbol in sp.sympify(each).free_symbols)


def with_quotients(expression: Any) -> Any:
    """The expression with its tangents as sines over cosines, before anything is put into them."""
    for function, (over, under) in QUOTIENTS.items():
        expression = expression.replace(function, lambda a, over=over, under=under: over(a) / under(a))
    return expression


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


def parts_of(node: Any) -> tuple[Any, ...]:
    """The subexpressions that are evaluated where the node is, bound variables of derivatives left out."""
    if isinstance(node, sp.Subs):
        _check_order(node)
        return (*node.args[2].args, *_nodes_to_substitute(node))
    return (node.expr,) if isinstance(node, sp.Derivative) else node.args


def _check_order(node: Any) -> None:
    """**Raises** `InputError` where it matters in which order the values of a `Subs` are put in.

    sympy makes one of nested ones, Subs(x q, (x, q), (q, p)), and puts them in one after the other, which gives p²; in
    all other uses of it they are put in at once.
    """
    names: Any = node.variables
    for k, at in enumerate(node.point):
        if later := sorted(at.free_symbols & {*names[k + 1 :]}, key=str):
            raise InputError(
                f"in {node}, {at} is put in for {names[k]} and then something for {later[0]}: write what is meant, as "
                "by its .doit()"
            )


def _nodes_to_substitute(node: Any) -> list[Any]:
    """What to look at inside a `Subs`: nothing more if it is the derivative of an arbitrary function."""
    inner = node.expr
    if isinstance(inner, sp.Derivative) and isinstance(inner.expr, AppliedUndef):
        return [argument for argument in inner.expr.args if not argument.free_symbols & set(node.variables)]
    return [inner.doit().xreplace(dict(zip(node.variables, node.point, strict=True)))]
