"""Structure constants as numbers: fractions where they are rational, else sympy expressions in parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from flint import fmpq

from canon.errors import InputError
from canon.mechanics.algebra.linear import fraction

Number = Fraction | sp.Expr
"""A structure constant: a rational number, or an expression in parameters (an algebraic number too)."""

Combination = Mapping[int, Number]
"""Coefficients by the position of the basis element; what isn't there is 0."""


def exact(value: Any) -> Number:
    """The number as a fraction where it is rational, else as a sympy expression; **raises** `InputError` for floats."""
    if isinstance(value, Fraction):
        return value
    if isinstance(value, fmpq):
        return fraction(value)
    expression: Any = sp.Integer(value) if isinstance(value, int) else value
    if not hasattr(expression, "is_commutative") or not hasattr(expression, "expand") or expression.has(sp.Float):
        raise InputError(f"{value!r} is no exact number: give a whole number, a fraction or an expression")
    return Fraction(int(expression.p), int(expression.q)) if expression.is_Rational else expression


def times(a: Number, b: Number) -> Number:
    """The product of two numbers."""
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return a * b
    return exact(sp.expand(sympy_of(a) * sympy_of(b)))


def plus(a: Number, b: Number) -> Number:
    """The sum of two numbers, 0 where it is recognised as 0."""
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return a + b
    total = sp.expand(sympy_of(a) + sympy_of(b))
    if total != 0 and total.has(sp.Pow):
        total = sp.radsimp(sp.cancel(total)) if not total.has(sp.Function) else sp.simplify(total)
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


def is_zero(value: Number) -> bool | None:
    """Whether a number is exactly 0: False where a value in 60 digits isn't, True where algebra shows it; else None."""
    if isinstance(value, Fraction):
        return value == 0
    for shift in range(3):
        values = {}
        for k, symbol in enumerate(sorted(value.free_symbols, key=str)):
            number = sp.Rational(7 + 4 * k + shift, 5 + 2 * shift)
            values[symbol] = -number if symbol.is_negative else number
        if abs(sp.N(value.xreplace(values), 60, chop=True)) > sp.Float("1e-40", 60):
            return False
    if sp.expand(value) == 0 or sp.radsimp(sp.cancel(sp.together(value))) == 0:
        return True
    return True if sp.simplify(value) == 0 else None
