"""A bracket of a map at one exact point, in balls: what turns numerical evidence into a refutation."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from canon.budget import Budget
from canon.claims.question import Question
from canon.decide.answer import Witness
from canon.decide.derivative import poisson_bracket
from canon.decide.enclosure import excludes_zero
from canon.decide.search import Finder
from canon.decide.series_program import Unenclosed
from canon.decide.symplectic_defect import defect_at
from canon.decide.tape import Unsupported
from canon.program import Program

if TYPE_CHECKING:
    import sympy as sp

    from canon.mechanics.transformation import Transformation

BITS: Final = 128


def certified_failure(
    transformation: Transformation,
    row: int,
    column: int,
    expected: Fraction,
    point: Sequence[float],
    parameters: Mapping[sp.Symbol, Any],
) -> Witness | None:
    """The witness, if the bracket of components `row` and `column` certainly differs from `expected` at the point.

    Components are those of (Q, P) for a forward map, of (q, p) for a backward one; floats stand for themselves
    exactly. None where the ball does not exclude equality, or the point is not certified to lie in the domain.
    """
    question = Question(transformation.canonical(), Budget(5.0), 0, "numeric")
    tape, chart = question.tape, question.chart
    functions = chart.new if transformation.direction == "forward" else chart.old
    n = len(chart.coordinates) // 2
    q, p = chart.coordinates[:n], chart.coordinates[n:]
    bracket = poisson_bracket(tape, functions[row], functions[column], q, p)
    residual = tape.minus(bracket, tape.number(expected))
    place: dict[Any, Any] = {node: Fraction(x) for node, x in zip(chart.coordinates, point, strict=True)}
    place.update({tape.symbol(name): Fraction(value) for name, value in parameters.items()})
    try:
        region = question.region()
        finder = Finder(tape, [residual], region, random.Random(0), question.budget)
        if region.surface or not set(finder.symbols) <= set(place):
            return None
        sample = finder.certify({node: place[node] for node in finder.symbols}, {}, {}, BITS)
    except Unsupported:
        return None
    if sample is None or not excludes_zero(sample.balls[residual]):
        return None
    return Witness.of(tape, sample, sample.balls[residual])


def confirmed_by_program(
    values: Program, row: int, column: int, scale: Fraction, point: Sequence[float], bound: float
) -> bool:
    """Whether the entry of M J Mᵀ − scale J in a row and column certainly exceeds the rounding `bound` at a point.

    `values` is the program of a map's 2n values, its numbers taken exactly; M is its true Jacobian, whatever
    derivatives the map's author has declared. More than 0 is asked for because those numbers were rounded.
    """
    try:
        entries = defect_at(values, [Fraction(x) for x in point], scale)
    except (Unenclosed, Unsupported):
        return False
    if row == column:
        return False
    return bool(entries[min(row, column), max(row, column)].abs_lower() > bound)
