"""The map of a generating function by another of its types, with parameters' values, where formulas lead to it.

Legendre's transform needs the arguments that give way, as functions of their conjugates. Where F's equations are linear
in them they are solved at once, for certain, and in a single branch; other equations are left alone, since several
branches, or roots, would cost the digits that the other type is to save.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Final

import sympy as sp

from canon.budget import Budget
from canon.claims.mixed_derivatives import OnTape
from canon.claims.question import Question
from canon.errors import InputError
from canon.mechanics.one_form import tidy
from canon.numeric.mixed_variables import Types

if TYPE_CHECKING:
    from canon.mechanics import GeneratingFunction

DIGITS: Final = 50
LONGEST: Final = 500
"""Equations of more operations are not solved."""

SECONDS: Final = 10.0


def valued(generating: GeneratingFunction, parameters: Mapping[str, float]) -> tuple[Question, OnTape]:
    """F's derivatives on a tape of their own, where the parameters are numbers, and the question about its map."""
    question = Question(generating.transformation().canonical(), Budget(SECONDS))
    tape = question.tape
    names = {symbol.name: symbol for symbol in (*generating.space.parameters, generating.space.t)}
    values = {tape.symbol(names[name]): tape.number(Fraction(float(value))) for name, value in parameters.items()}
    return question, OnTape.of(question, generating, values)


def of_type(generating: GeneratingFunction, types: Types, parameters: Mapping[str, float]) -> OnTape | None:
    """The derivatives of the function of these types of the same map; None where linear equations don't lead to it."""
    aim = type(generating)(generating.space, types, 0)
    formulas = generating.conjugates()
    pairs = zip(generating.mixed, generating.old_conjugates + generating.new_conjugates, strict=True)
    gone = {x: y for x, y in pairs if x not in aim.mixed}
    for y in gone.values():
        if sp.count_ops(formulas[y]) > LONGEST:
            return None
        slopes = [sp.expand(formulas[y].diff(x)) for x in gone]
        if any(slope.free_symbols & gone.keys() for slope in slopes):
            return None
    try:
        found = generating.converted(types)
        return valued(type(generating)(generating.space, types, _gathered(found)), parameters)[1]
    except InputError:
        return None


def _gathered(generating: GeneratingFunction) -> sp.Expr:
    """F with the coefficient of each monomial in a shorter form: what cancels in it would cost digits."""
    F = generating.F.expr
    try:
        terms = sp.Poly(sp.expand(F), *generating.mixed).terms()
    except sp.PolynomialError:
        return F
    powers = [(coefficient, zip(generating.mixed, exponents, strict=True)) for exponents, coefficient in terms]
    return sp.Add(*(_short(coefficient) * sp.Mul(*(u**k for u, k in monomial)) for coefficient, monomial in powers))


def _short(coefficient: sp.Expr) -> sp.Expr:
    """A shorter form of a coefficient; of a number its value, to more digits than any that is computed with it."""
    if coefficient.free_symbols or coefficient.is_Rational or not coefficient.is_real:
        return tidy(coefficient)
    return sp.Rational(coefficient.evalf(DIGITS))
