"""Arguments cell by cell: signs known, then connectedness.

What one normal form cannot show on the whole region may hold on each convex cell of it: because signs
are known there (√(x²) = −x for x < 0), or because the cell is connected, so that a residual with zero
gradient, or with values in 2πZ or 2πiZ, or with a vanishing product of conjugates, is constant on it.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction

from flint import arb

from canon.budget import Budget
from canon.decide.arbitrary import rational
from canon.decide.cells import Cell, cells_of
from canon.decide.constants import multiples, number_is_zero
from canon.decide.continuous_at import at_edge, is_continuous_at
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import OutOfDomain, excludes_zero, precision
from canon.decide.fraction_field import Element, FractionField
from canon.decide.generator_values import GeneratorBalls
from canon.decide.intervals import Edge, Interval
from canon.decide.normal_form import reduce_to_zero
from canon.decide.region import Region, admits
from canon.decide.ring import TooCostly
from canon.decide.sample import Sample, ball_point
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.decide.tower import Tower
from canon.errors import InputError

INVERSE = ("atan", "asin", "acos", "atan2")
DEEPEST = 3
SIMPLE = (
    *(Edge(Fraction(n)) for n in (0, 1, -1)),
    *(Edge(Fraction(0), Fraction(n, 2)) for n in (1, -1, 2, -2, 3, -3)),
)


def vanishes_by_cells(
    tape: Tape, node: Node, region: Region, rng: random.Random, budget: Budget
) -> tuple[str, list[str]] | None:
    """A proof that the node is 0 on every cell: (the arguments used, the cells), or None."""
    coarse = cells_of(tape, region, [node], budget)
    found = _on_all(tape, node, coarse, rng, budget)
    if found is None and coarse and not all(cell.connected for cell in coarse):
        found = _on_all(tape, node, cells_of(tape, region, [node], budget, finer=True), rng, budget)
    return found


def _on_all(
    tape: Tape, node: Node, cells: Sequence[Cell] | None, rng: random.Random, budget: Budget
) -> tuple[str, list[str]] | None:
    if not cells:
        return None
    arguments: set[str] = set()
    for cell in cells:
        used = vanishes_on_cell(tape, node, cell, rng, budget, DEEPEST)
        if used is None:
            return None
        arguments.add(used)
    return ", ".join(sorted(arguments)), [cell.describe(tape) for cell in cells]


def vanishes_on_cell(tape: Tape, node: Node, cell: Cell, rng: random.Random, budget: Budget, depth: int) -> str | None:
    """The argument by which the node is 0 on the cell, or None."""
    budget.check()
    if node == tape.zero:
        return "normal form"
    reduced = _reduce(tape, node, cell, budget)
    if reduced is not None and reduced[0]:
        return "normal form"
    if not tape.support(node):
        return "exact constant" if number_is_zero(tape, node, budget) else None
    if not cell.connected or tape.functions_of([node]):
        return None
    point = _base_point(tape, node, cell, rng, budget)
    if point is None or _refuted(tape, node, point):
        return None
    if _contains(tape, node, ("log",)) and tape.is_complex(node) and _winds(tape, node, cell, point, budget):
        return "values in 2 pi i Z on a connected cell"
    if _contains(tape, node, INVERSE) and _turns(tape, node, cell, point, budget):
        return "values in 2 pi Z on a connected cell"
    if reduced is not None and reduced[1] is not None and _conjugates(reduced[1], reduced[2], reduced[3], point):
        return "conjugates on a connected cell"
    if depth and _gradient(tape, node, cell, point, rng, budget, depth):
        return "zero gradient on a connected cell"
    return None


Reduced = tuple[bool, Element | None, FractionField, Tower]


def _reduce(tape: Tape, node: Node, cell: Cell, budget: Budget) -> Reduced | None:
    """(is it 0, the normal form if not, its field, the tower), or None where the tower can't be built."""
    try:
        positive = [r.nodes[0] for r in cell.region.requirements if r.kind == "positive"]
        tower = Tower(tape, [node], positive=positive, intervals=cell.intervals, budget=budget)
        zero, nonzero, field = reduce_to_zero(tower, [node], budget)
    except (Unsupported, TooCostly, ZeroDivisionError):
        return None
    if node in zero:
        return True, None, field, tower
    if _contains(tape, node, ("log",)) and not tape.is_complex(node):
        powered = tape.add(((tape.call("exp", node), 1),), -1)
        try:
            higher = Tower(tape, [powered], positive=positive, intervals=cell.intervals, budget=budget)
            if powered in reduce_to_zero(higher, [powered], budget)[0]:
                return True, None, field, tower
        except (Unsupported, TooCostly, ZeroDivisionError):
            pass
    return False, nonzero.get(node), field, tower


def _base_point(tape: Tape, node: Node, cell: Cell, rng: random.Random, budget: Budget) -> Sample | None:
    return next(samples(tape, [node], cell.region, rng, count=1, bits=128, tries=40, budget=budget, nice=True), None)


def _refuted(tape: Tape, node: Node, point: Sample) -> bool:
    return excludes_zero(point.balls[node])


def _turns(tape: Tape, node: Node, cell: Cell, point: Sample, budget: Budget) -> bool:
    """cos(k·x) = 1 on the cell puts k·x into 2πZ; a ball within the circle at one point makes it 0.

    Angles that are counted in turns, atan2(y, x)/2π, are multiplied by π first.
    """
    at_point, in_turns = point.balls[node], _over_pi(tape, node)
    larger = 1 if in_turns is None else 4  # 4 > π
    node = node if in_turns is None else in_turns
    for k in multiples(tape, node):
        turned = tape.add(((tape.call("cos", tape.scaled(node, k)), 1),), -1)
        reduced = _reduce(tape, turned, cell, budget)
        if reduced is not None and reduced[0]:
            with precision(64):
                return bool(abs(at_point) * larger * arb(rational(k)) < 2 * arb.pi())
    return False


def _over_pi(tape: Tape, node: Node) -> Node | None:
    """π times a sum that has π below a term, term by term; None for other nodes."""
    op, pi = tape.ops[node], tape.constant("pi")
    terms = op[2] if op[0] == "+" else ((node, Fraction(1)),)
    if not any(tape.ops[a][0] == "*" and (pi, -1) in tape.ops[a][1] for a, _ in terms):
        return None
    constant = [(pi, op[1])] if op[0] == "+" else []
    return tape.add([*((tape.times(pi, a), c) for a, c in terms), *constant])


def _winds(tape: Tape, node: Node, cell: Cell, point: Sample, budget: Budget) -> bool:
    """exp(x) = 1 on the cell puts x into 2πiZ; a ball within the circle at one point makes it 0."""
    reduced = _reduce(tape, tape.add(((tape.call("exp", node), 1),), -1), cell, budget)
    if reduced is None or not reduced[0]:
        return False
    with precision(64):
        return bool(abs(point.balls[node]) < 2 * arb.pi())


def _gradient(
    tape: Tape, node: Node, cell: Cell, point: Sample, rng: random.Random, budget: Budget, depth: int
) -> bool:
    """The gradient in all symbols is 0 on the cell, and the value at one point of it is exactly 0.

    Of a cell that is a whole box, the derivative by one symbol is enough where the node is 0 on a slice of it.
    """
    flat = True
    for symbol in sorted(tape.support(node)):
        slope = derivative(tape, node, symbol)
        if vanishes_on_cell(tape, slope, cell, rng, budget, depth - 1) is None:
            flat = False
        elif cell.whole and _on_a_slice(tape, node, symbol, cell, rng, budget, depth):
            return True
    values = {n: tape.number(v) for n, v in point.point.items() if isinstance(v, Fraction)}
    return flat and number_is_zero(tape, substitute(tape, node, values), budget) is True


def _on_a_slice(
    tape: Tape, node: Node, symbol: Node, cell: Cell, rng: random.Random, budget: Budget, depth: int
) -> bool:
    """Whether the node is 0 where the symbol has a value at which functions are likely to be known: 0, ±1, multiples of
    π/2, or an end of its interval up to which the node is continuous."""
    interval = cell.intervals.get(symbol, Interval())
    for edge in _simple_places(interval):
        inside = interval.contains(edge)
        place = at_edge(tape, edge)
        with precision(64):
            there_is = admits(tape.symbol_at(symbol), arb(rational(edge.rational)) + arb.pi() * rational(edge.pi))
        if not there_is or not (inside or is_continuous_at(tape, node, symbol, place, cell.intervals, budget)):
            continue
        try:
            part = cell.slice(tape, symbol, place, inside=inside)
            there = substitute(tape, node, {symbol: place})
        except (InputError, ZeroDivisionError):
            continue
        if vanishes_on_cell(tape, there, part, rng, budget, depth - 1) is not None:
            return True
    return False


def _simple_places(interval: Interval) -> list[Edge]:
    inside = [edge for edge in SIMPLE if interval.contains(edge)]
    return inside + [edge for edge in (interval.low, interval.high) if edge is not None]


def _conjugates(form: Element, field: FractionField, tower: Tower, point: Sample) -> bool:
    """f · Π conjugates = 0 by the relations, with every conjugate certainly nonzero at a point of the cell.

    Near that point f is then 0, and f is analytic on the connected cell.
    """
    ring = field.ring
    product, others = form[0], []
    for generator, degree, lower, _ in reversed(field.relations):
        if ring.degrees(product)[generator] <= 0:
            continue
        if degree != 2 or ring.degrees(lower)[generator] > 0 or len(product) > 4000:
            return False
        conjugate = ring.polynomial({m: -c if m[generator] % 2 else c for m, c in ring.terms(product).items()})
        others.append(conjugate)
        try:
            product = field.normal(ring.times(product, conjugate))
        except TooCostly:
            return False
        if not product:
            break
    if product or not others:
        return False
    with precision(512):
        try:
            balls = GeneratorBalls(tower, ball_point(point.point, point.solved))
            return all(excludes_zero(balls.value_of_terms(ring.terms(p))) for p in others)
        except (OutOfDomain, Unsupported, ZeroDivisionError):
            return False


def _contains(tape: Tape, node: Node, names: Sequence[str]) -> bool:
    return any(tape.ops[i][0] == "f" and tape.ops[i][1] in names for i in tape.reach([node]))
