"""Structure constants sought at sample points: nothing rests on them but what a ball at a certified point shows.

Functions f_1 … f_n and the brackets h of their pairs are evaluated at points of the domain, with the parameters fixed.
Linear equations at n points give the only constants that are possible; a further point at which they fail shows
rigorously that a bracket is no combination of the basis.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import acb, arb, arb_mat

from canon.claims.dependence import in_place_of_functions
from canon.claims.fixed_parameters import moved_region
from canon.decide.answer import largest
from canon.decide.derivative import substitute
from canon.decide.enclosure import OutOfDomain, excludes_zero, precision
from canon.decide.region import Region
from canon.decide.sample import Sample, evaluate_again
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.sign import declared
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question

BITS = 256
FURTHER_POINTS = 3
SINGULAR = 1e-12
SMALLEST = Fraction(1, 2**150)
BY_CHANCE = Fraction(1, 2**16)
CHOSEN = "the sum of its arguments"

Values = Mapping[Node, Fraction]


@dataclass(frozen=True)
class Frame:
    """Functions and brackets at sample points.

    **Arguments:** `basis` and `products`, a row of balls for each point (two for complex values); `points`, the sample
    of each row; `chosen`, whether arbitrary functions were replaced by particular ones.
    """

    basis: list[list[Any]]
    products: list[list[Any]]
    points: list[Sample]
    chosen: bool


@dataclass(frozen=True)
class Solution:
    """What the equations at sample points say.

    **Arguments:** `constants[k]`, balls of the coefficients of bracket k; `outside`, the number of the first bracket
    that is certainly no combination, with the sample that shows it; `missed`, by how much it differs there from the
    only one that is possible; `dependent`, coefficients of a relation that the basis seems to satisfy; `independent`,
    whether a determinant certainly isn't 0.
    """

    constants: list[list[Any]]
    outside: tuple[int, Sample] | None = None
    dependent: tuple[float, ...] | None = None
    independent: bool = False
    missed: Evidence | None = None


def parameters_of(question: Question, variables: Sequence[Node], nodes: Sequence[Node]) -> list[Node]:
    """The parameters that occur in the nodes."""
    tape = question.tape
    known = {tape.symbol(s) for s in question.space.parameters} - set(variables) - {question.chart.time}
    return sorted({x for node in nodes for x in tape.support(node)} & known)


def first_values(
    question: Question, region: Region, nodes: Sequence[Node], parameters: Sequence[Node], *, near: bool = False
) -> Values:
    """The parameters' values at a point of the region; one that was solved for is ±1, or a number `near` its value."""
    if not parameters:
        return {}
    rng = random.Random(question.seed)
    found = samples(question.tape, nodes, region, rng, count=1, budget=question.budget, nice=True)
    for place in found:
        return {x: _rational(question.tape, x, place, near) for x in parameters}
    return {}


def _rational(tape: Tape, x: Node, place: Sample, near: bool) -> Fraction:
    value, ball = place.point.get(x), place.balls.get(x)
    if isinstance(value, Fraction):
        return value
    if not near or ball is None or isinstance(ball, acb) or ball.contains(0):
        return Fraction(-1 if declared(tape.symbol_at(x)).get("negative") else 1)
    middle = Fraction(float(ball.mid()))
    return middle.limit_denominator(64) or middle


def frame(
    question: Question, region: Region, basis: Sequence[Node], products: Sequence[Node], values: Values
) -> Frame | None:
    """The functions at more sample points than there are of them; None where too few points were found."""
    tape = question.tape
    images = {x: tape.number(value) for x, value in values.items()}
    names = sorted(tape.functions_of([*basis, *products, *region.nodes()]))

    def move(node: Node) -> Node:
        chosen = in_place_of_functions(tape, node, dict.fromkeys(names, CHOSEN)) if names else node
        return substitute(tape, chosen, images) if images else chosen

    moved = moved_region(tape, region, move)
    if moved is None:
        return None
    fixed = Region(moved.requirements, moved.surface, tuple(x for x in moved.symbols if x not in images))
    nodes = [move(node) for node in (*basis, *products)]
    rng = random.Random(question.seed + 1)
    found = Frame([], [], [], bool(names))
    wanted = len(basis) + FURTHER_POINTS
    for place in samples(tape, nodes, fixed, rng, count=wanted, budget=question.budget):
        try:
            balls = evaluate_again(tape, nodes, place, BITS)
        except (OutOfDomain, Unsupported, ZeroDivisionError):
            continue
        entries = [balls[node] for node in nodes]
        for row in _real_rows(entries):
            found.basis.append(row[: len(basis)])
            found.products.append(row[len(basis) :])
            found.points.append(place)
    return found if len(found.basis) >= len(basis) else None


def _real_rows(entries: Sequence[Any]) -> list[list[Any]]:
    if not any(isinstance(entry, acb) for entry in entries):
        return [list(entries)]
    values = [entry if isinstance(entry, acb) else acb(entry) for entry in entries]
    return [[value.real for value in values], [value.imag for value in values]]


def solve(found: Frame) -> Solution:
    """The coefficients that the points allow."""
    import numpy as np

    size = len(found.basis[0])
    middle = np.array([[float(ball.mid()) for ball in row] for row in found.basis])
    scale = np.max(np.abs(middle), axis=0)
    chosen = _independent_rows(middle / np.where(scale > 0, scale, 1.0), size)
    if len(chosen) < size:
        _, _, vectors = np.linalg.svd(middle / np.where(scale > 0, scale, 1.0))
        relation = vectors[-1] / np.where(scale > 0, scale, 1.0)
        relation = relation / relation[np.argmax(np.abs(relation))]
        return Solution([], dependent=tuple(float(v) for v in relation))
    with precision(BITS):
        matrix = arb_mat([found.basis[k] for k in chosen])
        independent = bool(excludes_zero(matrix.det()))
        if not found.products[0]:
            return Solution([], independent=independent)
        try:
            solved = matrix.solve(arb_mat([found.products[k] for k in chosen]))
        except ZeroDivisionError:
            return Solution([], independent=False)
        constants = [[solved[c, k] for c in range(size)] for k in range(len(found.products[0]))]
        rest = [k for k in range(len(found.basis)) if k not in set(chosen)]
        for number, row in enumerate(constants):
            for k in rest:
                value = sum((c * f for c, f in zip(row, found.basis[k], strict=True)), start=arb(0))
                difference = found.products[k][number] - value
                if excludes_zero(difference):
                    missed = Evidence(len(found.points), *largest([difference]), BITS)
                    return Solution(constants, (number, found.points[k]), independent=independent, missed=missed)
    return Solution(constants, independent=independent)


def _independent_rows(values: Any, size: int) -> list[int]:
    """Rows that are independent, the best first, by elimination with pivots."""
    import numpy as np

    rest = values.copy()
    norms = np.linalg.norm(rest, axis=1)
    rest = rest / np.where(norms > 0, norms, 1.0)[:, None]
    chosen: list[int] = []
    for _ in range(size):
        sizes = np.linalg.norm(rest, axis=1)
        k = int(np.argmax(sizes))
        if sizes[k] < SINGULAR:
            break
        chosen.append(k)
        direction = rest[k] / sizes[k]
        rest = rest - np.outer(rest @ direction, direction)
    return chosen


def recognised(value: Any) -> sp.Expr | None:
    """The simplest rational number in a ball, or the root of one in its square; None: neither is simple enough."""
    with precision(BITS):
        near = _simple_in(value)
        if near is not None:
            return sp.Rational(near.numerator, near.denominator)
        square = _simple_in(value * value)
    if square is None or square < 0:
        return None
    root = sp.sqrt(sp.Rational(square.numerator, square.denominator))
    return root if float(value.mid()) > 0 else -root


def _simple_in(ball: Any) -> Fraction | None:
    """The fraction of least denominator in a ball, if so simple a one isn't there by chance."""
    mantissa, exponent = ball.mid().man_exp()
    middle = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    radius = 2 * Fraction(float(ball.rad())) + max(abs(middle), Fraction(1)) * SMALLEST
    near = _simplest_between(middle - radius, middle + radius)
    return near if near.denominator**2 * radius < BY_CHANCE else None


def _simplest_between(low: Fraction, high: Fraction) -> Fraction:
    """The fraction of least denominator in an interval, by continued fractions."""
    whole = math.ceil(low)
    if whole <= high:
        return Fraction(min(range(whole, math.floor(high) + 1), key=abs) if high - low < 3 else whole)
    floor = math.floor(low)
    return floor + 1 / _simplest_between(1 / (high - floor), 1 / (low - floor))
