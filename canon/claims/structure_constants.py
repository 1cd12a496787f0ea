"""The structure constants of functions that close under a bracket, as expressions in the parameters."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb, fmpq

from canon.claims.structure_search import (
    BITS,
    Solution,
    Values,
    first_values,
    frame,
    parameters_of,
    recognised,
    solve,
)
from canon.decide.enclosure import precision
from canon.decide.search import Sample
from canon.sign import declared
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region
    from canon.decide.tape import Node

FACTOR = 4
"""By which a parameter is changed to see the power in which a constant depends on it."""


@dataclass(frozen=True)
class Found:
    """Structure constants, guessed; or why there are none.

    **Arguments:** `constants[k]`, the combination {position: expression} of bracket k; `outside`, the number of a
    bracket that is certainly no combination, and a sample that shows it; `chosen`, whether that was for particular
    functions in place of arbitrary ones; `missed`, by how much the bracket `outside` is none there; `dependent`, a
    relation that the basis seems to satisfy, guessed; `unknown`, the number of a bracket whose constants weren't
    recognised; `independent`, whether the basis certainly is, at the parameters' `values`.
    """

    constants: list[dict[int, sp.Expr]]
    values: Values
    independent: bool = False
    outside: tuple[int, Sample] | None = None
    chosen: bool = False
    dependent: dict[int, sp.Expr] | None = None
    unknown: int | None = None
    nothing: str = ""
    missed: Evidence | None = None


def find_constants(
    question: Question, region: Region, basis: Sequence[Node], products: Sequence[Node], variables: Sequence[Node]
) -> Found:
    """The constants by which each of `products` is a combination of `basis`, as far as sample points show them."""
    shown = [*basis, *products, *region.surface]
    parameters = parameters_of(question, variables, [*shown, *region.nodes()])
    values = first_values(question, region, [*basis, *products], parameters)
    varied = parameters_of(question, variables, shown)
    here = _solution(question, region, basis, products, values)
    if here is None:
        return Found([], values, nothing="too few points of the domain were found")
    solution, chosen = here
    if solution.dependent is not None:
        relation = {c: recognised(arb(v, 1e-12)) for c, v in enumerate(solution.dependent) if abs(v) > 1e-9}
        guess = {c: v for c, v in relation.items() if v is not None}
        return Found([], values, dependent=guess if len(guess) == len(relation) else None, nothing="dependent")
    if solution.outside is not None:
        return Found([], values, solution.independent, solution.outside, chosen, missed=solution.missed)
    if products and not solution.constants:
        return Found([], values, nothing="the equations at sample points are singular")
    powers = _powers(question, region, basis, products, varied, values, solution)
    constants: list[dict[int, sp.Expr]] = []
    for k, row in enumerate(solution.constants):
        combination: dict[int, sp.Expr] = {}
        for c, ball in enumerate(row):
            if ball.contains(0):
                continue
            value = _expression(question, ball, values, powers.get((k, c), {}))
            if value is None:
                return Found(constants, values, solution.independent, chosen=chosen, unknown=k)
            combination[c] = value
        constants.append(combination)
    return Found(constants, values, solution.independent, chosen=chosen)


def _solution(
    question: Question, region: Region, basis: Sequence[Node], products: Sequence[Node], values: Values
) -> tuple[Solution, bool] | None:
    found = frame(question, region, basis, products, values)
    return None if found is None else (solve(found), found.chosen)


Powers = dict[tuple[int, int], dict[Any, Fraction | None]]


def _powers(
    question: Question,
    region: Region,
    basis: Sequence[Node],
    products: Sequence[Node],
    parameters: Sequence[Node],
    values: Values,
    here: Solution,
) -> Powers:
    """The power of each parameter in each constant that isn't 0; None where it is no power."""
    powers: Powers = {}
    for x in parameters:
        there = None
        for factor in (FACTOR, Fraction(1, FACTOR)):
            moved = {**values, x: values[x] * factor} if values[x] else {**values, x: Fraction(1)}
            if not declared(question.tape.symbol_at(x)).get("integer"):
                there = _solution(question, region, basis, products, moved)
            if there is not None:
                break
        for k, row in enumerate(here.constants):
            for c, ball in enumerate(row):
                power: Fraction | None = None
                if there is not None and there[0].constants and values[x]:
                    power = _power(float(ball.mid()), float(there[0].constants[k][c].mid()), float(factor))
                powers.setdefault((k, c), {})[x] = power
    return powers


def _power(here: float, there: float, factor: float) -> Fraction | None:
    if not here or not there / here > 0:
        return None
    exponent = math.log(there / here) / math.log(factor)
    near = Fraction(round(2 * exponent), 2)
    return near if abs(float(near) - exponent) < 1e-9 else None


def _expression(question: Question, ball: Any, values: Values, powers: dict[Any, Fraction | None]) -> sp.Expr | None:
    """The constant as a number times powers of parameters."""
    symbolic = sp.S.One
    for x, power in powers.items():
        if power is None:
            return None
        if power:
            with precision(BITS):
                size = arb(fmpq(abs(values[x]).numerator, abs(values[x]).denominator))
                ball = ball / size ** arb(fmpq(power.numerator, power.denominator))
            symbol: Any = question.tape.symbol_at(x)
            positive = symbol if values[x] > 0 else -symbol
            symbolic *= positive ** sp.Rational(power.numerator, power.denominator)
    number = recognised(ball)
    return None if number is None else number * symbolic
