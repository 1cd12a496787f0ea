"""The structure constants of functions that close under a bracket, as expressions in the parameters."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
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
from canon.decide.sample import Sample
from canon.mechanics.algebra import linear
from canon.sign import declared
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region
    from canon.decide.tape import Node

FACTOR = Fraction(29, 8)
"""By which a parameter is changed to see the power in which a constant depends on it; a sum is hardly one by chance."""
DEGREE = 4
MOST_MONOMIALS = 40
SPARE = 4
"""Further points than a polynomial has coefficients, at which it must be right."""


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
        values = first_values(question, region, [*basis, *products], parameters, near=True)
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
    real = {x: symbol for x in varied if not declared(symbol := question.tape.symbol_at(x)).get("integer")}

    def solved(there: Values) -> Solution | None:
        found = _solution(question, region, basis, products, there)
        return None if found is None else found[0]

    sums = Polynomials(solved, values, real)
    constants: list[dict[int, sp.Expr]] = []
    for k, row in enumerate(solution.constants):
        combination: dict[int, sp.Expr] = {}
        for c, ball in enumerate(row):
            if ball.contains(0):
                continue
            value = _expression(question, ball, values, powers.get((k, c), {}), sums, k, c)
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
        there, factor = None, FACTOR
        whole = declared(question.tape.symbol_at(x)).get("integer")
        for factor in (Fraction(7), Fraction(1, 7)) if whole else (FACTOR, 1 / FACTOR):
            moved = {**values, x: values[x] * factor} if values[x] else {**values, x: Fraction(1)}
            if not whole or moved[x].denominator == 1:
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


class Polynomials:
    """Constants that are polynomials of some parameters with rational coefficients, of degree `DEGREE` at most.

    The equations are solved at a grid of values of these parameters, once for all constants that ask for it.
    """

    def __init__(
        self, solved: Callable[[Values], Solution | None], values: Values, symbols: Mapping[Node, Any]
    ) -> None:
        self._solved = solved
        self._values = values
        self._symbols = symbols
        self._found: dict[tuple[Node, ...], list[tuple[tuple[Fraction, ...], Solution]]] = {}

    def __call__(self, k: int, c: int, powers: Mapping[Node, Fraction | None]) -> sp.Expr | None:
        """The constant number c of bracket k, of known powers in the other parameters; None where it isn't one."""
        names = tuple(x for x, power in powers.items() if power is None)
        exponents = [e for e in product(range(DEGREE + 1), repeat=len(names)) if sum(e) <= DEGREE]
        if not names or len(exponents) > MOST_MONOMIALS or any(x not in self._symbols for x in names):
            return None
        if names not in self._found:
            self._found[names] = list(self._grid(names, len(exponents) + SPARE))
        rows: list[list[fmpq]] = []
        for place, solution in self._found[names]:
            value = recognised(_without(solution.constants[k][c], self._values, powers))
            if not isinstance(value, sp.Rational):
                return None
            monomials = [math.prod((v**n for v, n in zip(place, e, strict=True)), start=Fraction(1)) for e in exponents]
            rows.append([*map(linear.rational, monomials), fmpq(int(value.p), int(value.q))])
        reduced = linear.span(rows, len(exponents) + 1)
        if linear.pivots(reduced) != list(range(len(exponents))):
            return None  # too few points, or no such polynomial
        terms = [
            sp.Rational(int(row[-1].p), int(row[-1].q))
            * sp.Mul(*(self._symbols[x] ** n for x, n in zip(names, e, strict=True)))
            for row, e in zip(linear.rows(reduced), exponents, strict=True)
        ]
        return sp.Add(*terms)

    def _grid(self, names: Sequence[Node], count: int) -> Iterator[tuple[tuple[Fraction, ...], Solution]]:
        rng, seen = random.Random(0), set[tuple[Fraction, ...]]()
        found = 0
        for _ in range(3 * count):
            place = tuple(_short(self._values[x] * Fraction(rng.randint(40, 88), 64)) for x in names)
            here = None if place in seen else self._solved({**self._values, **dict(zip(names, place, strict=True))})
            seen.add(place)
            if here is not None and here.constants and here.outside is None:
                found += 1
                yield place, here
            if found == count:
                return


def _short(value: Fraction) -> Fraction:
    """A number near it of four bits, so that its powers are recognised."""
    unit = Fraction(2) ** (math.floor(math.log2(abs(value))) - 3) if value else Fraction(1)
    return round(value / unit) * unit or unit


def _without(ball: Any, values: Values, powers: Mapping[Any, Fraction | None]) -> Any:
    """The ball divided by the known powers of parameters."""
    for x, power in powers.items():
        if power:
            with precision(BITS):
                size = arb(fmpq(abs(values[x]).numerator, abs(values[x]).denominator))
                ball = ball / size ** arb(fmpq(power.numerator, power.denominator))
    return ball


def _power(here: float, there: float, factor: float) -> Fraction | None:
    if not here or not there / here > 0:
        return None
    exponent = math.log(there / here) / math.log(factor)
    near = Fraction(round(2 * exponent), 2)
    return near if abs(float(near) - exponent) < 1e-9 else None


def _expression(
    question: Question,
    ball: Any,
    values: Values,
    powers: dict[Any, Fraction | None],
    sums: Polynomials,
    k: int,
    c: int,
) -> sp.Expr | None:
    """The constant as a number, or a polynomial of some parameters, times powers of the others."""
    symbolic = sp.S.One
    for x, power in powers.items():
        if power:
            symbol: Any = question.tape.symbol_at(x)
            positive = symbol if values[x] > 0 else -symbol
            symbolic *= positive ** sp.Rational(power.numerator, power.denominator)
    if None in powers.values():
        number = sums(k, c, powers)
    else:
        number = recognised(_without(ball, values, powers))
    return None if number is None else number * symbolic
