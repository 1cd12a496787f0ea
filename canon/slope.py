"""Derivatives of formulas as they are read: bounded before they are computed, and smooth where the formulas are."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.errors import InputError
from canon.measure import WIDEST, Measure


def differentiated(value: Any, symbol: Any, measure: Measure) -> Any:
    """The partial derivative of a formula's value by a symbol, on the domain where the formula is smooth.

    **Raises:** `InputError` if it would be too large, or isn't in the language.
    """
    if not value.has(symbol):
        return sp.Integer(0)
    measure.spend(5 * measure.size(value))
    bound = derivative_size(value, measure)
    if bound > 5 * WIDEST:
        raise InputError("too large to differentiate here")
    measure.spend(1_000 + 10 * bound)
    smooth, signs = without_kinks(value, symbol, measure)
    result = smooth.diff(symbol)
    for dummy, kink in signs:
        result = result.xreplace({dummy: kink})
    for derivative in result.atoms(sp.Derivative):
        if not isinstance(derivative.expr, AppliedUndef):
            name = derivative.expr.func.__name__
            raise InputError(f"the derivative of {name} in its parameter is not in the language")
    return measure.admit(result)


def derivative_size(expression: Any, measure: Measure) -> int:
    """A bound on the tree size of a derivative, from the rules that compute it and before they do."""
    sizes: dict[Any, int] = {}
    stack = [expression]
    while stack:
        node = stack[-1]
        missing = [part for part in node.args if part not in sizes]
        if missing:
            stack.extend(missing)
            continue
        stack.pop()
        parts = sum(sizes[part] for part in node.args)
        if isinstance(node, sp.Add):
            sizes[node] = 1 + parts
        elif isinstance(node, sp.Mul):
            sizes[node] = 1 + parts + len(node.args) * measure.size(node)
        elif isinstance(node, (AppliedUndef, sp.Subs)):
            sizes[node] = 8 + parts + 30 * measure.size(node)
        elif node.args:
            sizes[node] = 8 + parts + 6 * len(node.args) * measure.size(node)
        else:
            sizes[node] = 1
    return sizes[expression]


def without_kinks(value: Any, symbol: Any, measure: Measure) -> tuple[Any, list[tuple[Any, Any]]]:
    """`value` with |u| as s·u and sign(u) as s, and what each s stands for, outermost first.

    Where a real u ≠ 0 its sign s is constant nearby, so that derivatives may take it for a constant.
    """
    smooth: dict[Any, Any] = {}
    signs: dict[Any, Any] = {}
    kinks = [kink for kink in value.atoms(sp.Abs, sp.sign) if kink.has(symbol)]
    for kink in kinks:
        if measure.is_complex(kink.args[0]):
            raise InputError("abs of a complex expression has no derivative: write x + 1j*y for its names")
    for kink in sorted(kinks, key=lambda node: (measure.size(node), str(node.func))):
        inner = kink.args[0].xreplace(smooth)
        sign = signs.setdefault(inner, sp.Dummy(real=True))
        smooth[kink] = sign * inner if isinstance(kink, sp.Abs) else sign
    back = [(sign, sp.sign(inner)) for inner, sign in signs.items()]
    return value.xreplace(smooth), back[::-1]
