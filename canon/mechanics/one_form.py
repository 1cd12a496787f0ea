"""One-forms: exterior derivative, and the potential of an exact one."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.mechanics.formulas import replaced
from canon.mechanics.trigonometry import contracted
from canon.mechanics.unfinished_integrals import forget_unfinished_integrals

_LARGEST = 100  # operations in a function that is still integrated


@dataclass(frozen=True)
class Potential:
    """A function meant to have a given one-form as its differential.

    `residuals` are d(function)/dx_k - a_k: whether they vanish is for the caller to decide. None of the terms of
    `function` is left as an unevaluated integral.
    """

    function: sp.Expr
    residuals: tuple[sp.Expr, ...]


def exterior_derivative(coefficients: Sequence[sp.Expr], variables: Sequence[sp.Symbol]) -> tuple[sp.Expr, ...]:
    """d(sum a_k dx_k): the components da_k/dx_j - da_j/dx_k for j < k, in the order (0, 1), (0, 2), ..., (1, 2), ...

    All of them vanish exactly when the form is closed.
    """
    size = len(variables)
    return tuple(
        coefficients[k].diff(variables[j]) - coefficients[j].diff(variables[k])
        for j in range(size)
        for k in range(j + 1, size)
    )


def potential(coefficients: Sequence[sp.Expr], variables: Sequence[sp.Symbol]) -> Potential | None:
    """A function whose differential is sum a_k dx_k, if the form is closed and sympy finds the integrals.

    It integrates one variable at a time what earlier ones have left over. `None` when an integral is not found. A
    form that is not closed shows itself by residuals that do not vanish.
    """
    found: sp.Expr = sp.S.Zero
    for index, (coefficient, variable) in enumerate(zip(coefficients, variables, strict=True)):
        rest = tidy(coefficient - found.diff(variable))
        earlier = [past for past in variables[:index] if rest.has(past)]
        if earlier:
            rest = _without(rest, earlier)
        if rest == 0:
            continue
        part = _antiderivative(rest, variable)
        if part is None:
            return None
        found = sp.Add(found, part)
    residuals = tuple(found.diff(x) - a for a, x in zip(coefficients, variables, strict=True))
    return Potential(found, residuals)


def _antiderivative(function: Any, variable: sp.Symbol) -> Any:
    """An antiderivative, if sympy finds one without its slowest method; `None` otherwise."""
    if sp.count_ops(function) > _LARGEST:
        return None
    forget_unfinished_integrals()
    found: Any = sp.integrate(function, variable, conds="none", meijerg=False)
    found = found.replace(sp.Piecewise, _real_piece)
    return None if found.has(sp.Integral, sp.Piecewise, sp.zoo, sp.nan) else found


def _real_piece(*pieces: Any) -> Any:
    """Of an antiderivative in pieces the first that is written without the imaginary unit, else the last."""
    formulas = [piece[0] for piece in pieces]
    return next((formula for formula in formulas if not formula.has(sp.I)), formulas[-1])


def tidy(expression: Any) -> Any:
    """A shorter form of the same function where one is found cheaply; never a statement that something is zero."""
    size = sp.count_ops(expression)
    if not expression.free_symbols or size > 2 * _LARGEST:
        return expression
    forms = [expression, sp.expand(expression)]
    try:
        forms.append(sp.cancel(sp.together(expression)))
    except (sp.PolynomialError, RuntimeError):
        forms.append(sp.together(expression))
    if expression.has(sp.Function):
        forms.append(contracted(expression))
    return min(forms, key=sp.count_ops)


def _without(rest: sp.Expr, earlier: Sequence[sp.Symbol]) -> sp.Expr:
    """`rest` as a function of the later variables alone, where it should not depend on the earlier ones.

    If it really does not, any value of these gives the same; the first at which `rest` is finite is taken.
    """
    for value in (sp.S.One, sp.Integer(2), sp.S.Half, sp.Integer(3)):
        there = replaced(rest, dict.fromkeys(earlier, value))
        if not there.has(sp.zoo, sp.nan, sp.oo):
            return there
    return rest
