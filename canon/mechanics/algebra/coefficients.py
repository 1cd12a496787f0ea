"""Structure constants as numbers: fractions where they are rational, else sympy expressions in parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from flint import fmpq

from canon.errors import InputError
from canon.mechanics.algebra.linear import fraction
from canon.mechanics.vanishing import vanishes

Number = Fraction | sp.Expr
"""A structure constant: a rational number, or an expression in parameters (an algebraic number too)."""

Combination = Mapping[int, Number]
"""Coefficients by the position of the basis element; what isn't there is 0."""


def exact(value: Any) -> Number:
    """The number as a fraction where it is rational, else as a sympy expression.

    **Raises:** `InputError` for floats, and for what is no number (infinity).
    """
    if isinstance(value, Fraction):
        return value
    if isinstance(value, fmpq):
        return fraction(value)
    expression: Any = sp.Integer(value) if isinstance(value, int) else value
    if not isinstance(value, int | sp.Expr) or isinstance(value, sp.Lambda) or expression.has(sp.Float):
        raise InputError(f"{value!r} is no exact number: give a whole number, a fraction or an expression")
    if expression.has(sp.nan, sp.oo, sp.zoo, -sp.oo):
        raise InputError(f"{value!r} is no number")
    return Fraction(int(expression.p), int(expression.q)) if expression.is_Rational else expression


def times(a: Number, b: Number) -> Number:
    """The product of two numbers."""
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return a * b
    return exact(sp.expand(sympy_of(a) * sympy_of(b)))


def plus(a: Number, b: Number) -> Number:
    """The sum of two numbers, 0 where it is exactly 0 as far as `vanishes` sees it."""
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return a + b
    total: sp.Expr = sp.expand(sympy_of(a) + sympy_of(b))
    if is_zero(total):
        return Fraction(0)
    if total.has(sp.Pow) and not total.has(sp.Function):
        total = sp.radsimp(sp.cancel(total))
    return exact(total)


def as_sympy(element: Combination, names: Sequence[str]) -> sp.Expr:
    """A combination of the basis as a sum of symbols."""
    return sp.Add(*(sympy_of(value) * sp.Symbol(names[c]) for c, value in element.items()))


def sympy_of(value: Number) -> sp.Expr:
    """The number as sympy has it."""
    return sp.Rational(value.numerator, value.denominator) if isinstance(value, Fraction) else value


def increase(total: dict[int, Number], c: int, value: Number) -> None:
    """Add a coefficient to a combination; what is 0 is left out of it."""
    new = plus(total[c], value) if c in total else value
    if new == 0:
        total.pop(c, None)
    else:
        total[c] = new


def is_zero(value: Number | sp.Expr) -> bool | None:
    """Whether a number is exactly 0, each answer a proof (`canon.mechanics.vanishing`); None: it isn't known.

    False says of parameters that it isn't 0 for all of their values.
    """
    return value == 0 if isinstance(value, Fraction) else vanishes(value)
