"""Certified real points of a constraint surface.

Some coordinates are solved for: exactly where the equation is affine in one of them with rational
data, else by Krawczyk's operator, which proves that its box holds exactly one solution
(Neumaier, Interval Methods for Systems of Equations, thm 5.1.8).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from flint import arb, arb_mat

from canon.decide.arbitrary import ChosenFunction, rational
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.tape import Node, Tape

if TYPE_CHECKING:
    from canon.decide.search import Coordinate, Finder

Placed = tuple[dict[Node, "Coordinate"], dict[Node, Ball]]


def onto_surface(
    finder: Finder, point: Mapping[Node, Coordinate], functions: Mapping[str, ChosenFunction], bits: int
) -> Placed | None:
    """The point moved onto the surface: exact coordinates, and enclosures of those solved for."""
    tape, equations = finder.tape, finder.region.surface
    free = [n for n in finder.symbols if tape.symbol_at(n).is_real and not tape.symbol_at(n).is_integer]
    candidates = [n for n in free if any(n in tape.support(e) for e in equations)]
    finder.rng.shuffle(candidates)
    exact = _solve_affine(tape, equations, point, candidates)
    if exact is not None:
        return exact, {}
    if len(candidates) < len(equations):
        return None
    return _solve_newton(tape, equations, point, candidates[: len(equations)], functions, max(bits, 128))


def _solve_affine(
    tape: Tape, equations: Sequence[Node], point: Mapping[Node, Coordinate], candidates: Sequence[Node]
) -> dict[Node, Coordinate] | None:
    """Solve equation by equation, each for a coordinate that it contains to the first power, in exact arithmetic."""
    place = dict(point)
    used: set[Node] = set()
    for equation in equations:
        for node in candidates:
            if node in used or node not in tape.support(equation):
                continue
            slope = derivative(tape, equation, node)
            if node in tape.support(slope):
                continue
            below, factor = (
                exact_value(tape, substitute(tape, equation, {node: tape.zero}), place),
                exact_value(tape, slope, place),
            )
            if below is None or not factor:
                continue
            place[node] = -below / factor
            used.add(node)
            break
        else:
            return None
    values = [exact_value(tape, equation, place) for equation in equations]
    return place if all(value == 0 for value in values) else None


def exact_value(tape: Tape, node: Node, point: Mapping[Node, Coordinate]) -> Fraction | None:
    """The rational value at a rational point of a node made of rational operations alone, else None."""
    values: dict[Node, Fraction] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] == "n":
            values[i] = op[1]
        elif op[0] == "s":
            coordinate = point[i]
            if isinstance(coordinate, tuple):
                return None
            values[i] = coordinate
        elif op[0] == "+":
            values[i] = op[1] + sum((c * values[a] for a, c in op[2]), Fraction(0))
        elif op[0] == "*":
            product = Fraction(1)
            for a, e in op[1]:
                if e < 0 and not values[a]:
                    return None
                product *= values[a] ** e
            values[i] = product
        else:
            return None
    return values[node]


def _solve_newton(
    tape: Tape,
    equations: Sequence[Node],
    point: Mapping[Node, Coordinate],
    unknowns: Sequence[Node],
    functions: Mapping[str, ChosenFunction],
    bits: int,
) -> Placed | None:
    slopes = [[derivative(tape, equation, node) for node in unknowns] for equation in equations]
    order = tape.reach([*equations, *(s for row in slopes for s in row)])
    exact = {n: v for n, v in point.items() if n not in unknowns}
    if any(isinstance(value, tuple) for value in point.values()):
        return None
    size = len(unknowns)
    with precision(bits):
        fixed = {n: arb(rational(v)) for n, v in exact.items() if isinstance(v, Fraction)}
        start = [point[n] for n in unknowns]
        centre = [arb(rational(v)) for v in start if isinstance(v, Fraction)]

        def look(box: Sequence[Ball]) -> tuple[arb_mat, arb_mat]:
            balls = evaluate(tape, order, fixed | dict(zip(unknowns, box, strict=True)), functions)
            values = arb_mat([[balls[e]] for e in equations])
            return values, arb_mat([[balls[s] for s in row] for row in slopes])

        try:
            for _ in range(60):
                values, matrix = look(centre)
                step = matrix.mid().solve(values.mid()) if hasattr(matrix, "mid") else matrix.solve(values)
                centre = [(c - step[k, 0]).mid() for k, c in enumerate(centre)]
                if all(abs(step[k, 0]) < arb(2) ** (-bits // 2) for k in range(size)):
                    break
            else:
                return None
            width = arb(0, arb(2) ** (-bits // 3))
            box = [c + width for c in centre]
            values, _ = look(centre)
            _, matrix = look(box)
            inverse = arb_mat([[look(centre)[1][i, j].mid() for j in range(size)] for i in range(size)]).inv()
            inverse = arb_mat([[inverse[i, j].mid() for j in range(size)] for i in range(size)])
            identity = arb_mat([[int(i == j) for j in range(size)] for i in range(size)])
            spread = arb_mat([[box[k] - centre[k]] for k in range(size)])
            image = arb_mat([[c] for c in centre]) - inverse * values + (identity - inverse * matrix) * spread
            solved = [image[k, 0] for k in range(size)]
        except (OutOfDomain, ZeroDivisionError, OverflowError, ValueError):
            return None
        if not all(b.contains_interior(s) for b, s in zip(box, solved, strict=True)):
            return None
    return exact, dict(zip(unknowns, solved, strict=True))
