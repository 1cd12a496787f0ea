"""Certified points of a constraint surface.

Each equation is one of its irreducible pieces, in turn. Some coordinates are solved for: exactly where a piece is
affine in one of them with rational data, else by Krawczyk's operator, which proves that its box holds exactly one
solution (Neumaier, Interval Methods for Systems of Equations, thm 5.1.8; for analytic functions of complex boxes too,
by the same mean-value form). Where that fails, as at singular points and for equations that depend on each other, by
Gröbner bases.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from flint import acb, acb_mat, arb, arb_mat

from canon.decide.arbitrary import ChosenFunction
from canon.decide.components import Piece, pieces
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.exact_points import NoZero, algebraic_point
from canon.decide.sample import ball_point
from canon.decide.tape import Node, Tape

if TYPE_CHECKING:
    from canon.decide.proposal import Coordinate
    from canon.decide.search import Finder

Placed = tuple[dict[Node, "Coordinate"], dict[Node, Ball]]
Choice = tuple[Piece, ...]
Gaussian = tuple[Fraction, Fraction]
MOST_CHOICES = 64
ALGEBRAIC_TRIES = range(8, 26)
ZERO = Fraction(0)


def choices_of(tape: Tape, equations: Sequence[Node]) -> list[Choice]:
    """The systems of irreducible pieces whose zeros together make up the surface (at most so many of them)."""
    alternatives = pieces(tape, equations)
    systems = itertools.islice(itertools.product(*alternatives), MOST_CHOICES)
    return list(dict.fromkeys(tuple(dict.fromkeys(system)) for system in systems))


def onto_surface(
    finder: Finder, point: Mapping[Node, Coordinate], functions: Mapping[str, ChosenFunction], bits: int, effort: int
) -> Placed | None:
    """The point moved onto the surface: exact coordinates, and enclosures of those solved for."""
    tape = finder.tape
    if finder.choices is None:
        finder.choices = choices_of(tape, finder.region.surface)
        finder.rng.shuffle(finder.choices)
    if not finder.choices:
        return None
    choice = finder.choices[effort % len(finder.choices)]
    equations = [piece.node for piece in choice]
    free = [n for n in finder.symbols if not tape.symbol_at(n).is_integer]
    candidates = [n for n in free if any(n in tape.support(e) for e in equations)]
    finder.rng.shuffle(candidates)
    turn = effort // len(finder.choices)
    shrunk = Fraction(1, 2 ** (turn % 4))
    point = dict(point) | {n: v * shrunk for n in candidates if isinstance(v := point[n], Fraction)}
    exact = _solve_affine(tape, equations, point, candidates)
    if exact is not None:
        return exact, {}
    found = _solve_newton(tape, equations, point, candidates, functions, max(bits, 128))
    if found is None and turn in ALGEBRAIC_TRIES:
        found = _solve_algebraic(finder, choice, point, max(bits, 128), singular=turn % 3 == 1)
    return found


def _solve_algebraic(
    finder: Finder, choice: Choice, point: Mapping[Node, Coordinate], bits: int, singular: bool
) -> Placed | None:
    """A common zero of polynomial pieces by Gröbner bases; a singular one of one of them, where that is asked.

    The real zeros of an irreducible polynomial that doesn't change its sign are singular ones, as of x² + y².
    """
    tape = finder.tape
    symbols = sorted(set().union(*(tape.support(e) for e in finder.region.surface)))
    numbers = {k: point[n] for k, n in enumerate(symbols)}
    values = {k: v for k, v in numbers.items() if isinstance(v, Fraction)}
    polynomials = [piece.polynomial for piece in choice]
    if len(values) < len(symbols) or not polynomials or any(p is None for p in polynomials):
        return None
    if singular:
        p: Any = finder.rng.choice(polynomials)
        polynomials += [slope for k in range(len(symbols)) if (slope := p.derivative(k))]
    terms = [
        {tuple(map(int, m)): Fraction(int(c.p), int(c.q)) for m, c in p.to_dict().items()}  # type: ignore[union-attr]
        for p in polynomials
    ]
    fixed = [k for k, n in enumerate(symbols) if tape.symbol_at(n).is_integer]
    terms += [{_power(k, len(symbols)): Fraction(1), (0,) * len(symbols): -values[k]} for k in fixed]
    try:
        found = algebraic_point(terms, values, finder.rng, bits, finder.budget)
    except NoZero:
        if not singular and not fixed and finder.choices is not None:
            finder.choices = [other for other in finder.choices if other != choice]
        return None
    if found is None:
        return None
    exact, solved = found
    place = dict(point) | {symbols[k]: v for k, v in exact.items()}
    enclosed = {symbols[k]: ball for k, ball in solved.items()}
    return {n: v for n, v in place.items() if n not in enclosed}, enclosed


def _power(k: int, size: int) -> tuple[int, ...]:
    return tuple(int(j == k) for j in range(size))


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
            below = exact_value(tape, substitute(tape, equation, {node: tape.zero}), place)
            factor = exact_value(tape, slope, place)
            if below is None or factor is None or not any(factor):
                continue
            re, im = _times(below, _inverse(factor))
            real = bool(tape.symbol_at(node).is_real)
            if real and im:
                continue
            place[node] = -re if real else (-re, -im)
            used.add(node)
            break
        else:
            return None
    values = [exact_value(tape, equation, place) for equation in equations]
    return place if all(value == (ZERO, ZERO) for value in values) else None


def exact_value(tape: Tape, node: Node, point: Mapping[Node, Coordinate]) -> Gaussian | None:
    """The value (re, im) at a rational point of a node made of rational operations and i alone, else None."""
    values: dict[Node, Gaussian] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] == "n":
            values[i] = op[1], ZERO
        elif op == ("c", "I"):
            values[i] = ZERO, Fraction(1)
        elif op[0] == "s":
            coordinate = point[i]
            values[i] = coordinate if isinstance(coordinate, tuple) else (coordinate, ZERO)
        elif op[0] == "+":
            re = op[1] + sum((c * values[a][0] for a, c in op[2]), ZERO)
            values[i] = re, sum((c * values[a][1] for a, c in op[2]), ZERO)
        elif op[0] == "*":
            product = Fraction(1), ZERO
            for a, e in op[1]:
                if e < 0 and not any(values[a]):
                    return None
                factor = values[a] if e > 0 else _inverse(values[a])
                for _ in range(abs(e)):
                    product = _times(product, factor)
            values[i] = product
        else:
            return None
    return values[node]


def _times(a: Gaussian, b: Gaussian) -> Gaussian:
    if not a[1] and not b[1]:
        return a[0] * b[0], ZERO
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def _inverse(a: Gaussian) -> Gaussian:
    size = a[0] * a[0] + a[1] * a[1]
    return a[0] / size, -a[1] / size


def _solve_newton(
    tape: Tape,
    equations: Sequence[Node],
    point: Mapping[Node, Coordinate],
    candidates: Sequence[Node],
    functions: Mapping[str, ChosenFunction],
    bits: int,
) -> Placed | None:
    """Newton's method in as many coordinates as there are equations, and Krawczyk's proof of what it finds.

    Real equations are solved for real coordinates, complex ones for complex ones; not both at once.
    """
    kinds = {tape.is_complex(e) for e in equations}
    real = kinds == {False}
    unknowns = [n for n in candidates if bool(tape.symbol_at(n).is_real) is real][: len(equations)]
    if len(kinds) != 1 or len(unknowns) < len(equations):
        return None
    slopes = [[derivative(tape, equation, node) for node in unknowns] for equation in equations]
    order = tape.reach([*equations, *(s for row in slopes for s in row)])
    exact = {n: v for n, v in point.items() if n not in unknowns}
    Matrix: Any = arb_mat if real else acb_mat
    size = len(unknowns)
    with precision(bits):
        fixed = ball_point(exact, {})
        centre = list(ball_point({n: point[n] for n in unknowns}, {}).values())

        def look(box: Sequence[Ball]) -> tuple[Any, Any]:
            balls = evaluate(tape, order, fixed | dict(zip(unknowns, box, strict=True)), functions)
            return Matrix([[balls[e]] for e in equations]), Matrix([[balls[s] for s in row] for row in slopes])

        try:
            for _ in range(60):
                values, matrix = look(centre)
                step = matrix.mid().solve(values.mid())
                centre = [(c - step[k, 0]).mid() for k, c in enumerate(centre)]
                if all(abs(step[k, 0]) < arb(2) ** (-bits // 2) for k in range(size)):
                    break
            else:
                return None
            width = arb(0, arb(2) ** (-bits // 3))
            box = [c + (width if real else acb(width, width)) for c in centre]
            values, at_centre = look(centre)
            _, matrix = look(box)
            inverse = at_centre.mid().inv().mid()
            identity = Matrix([[int(i == j) for j in range(size)] for i in range(size)])
            spread = Matrix([[box[k] - centre[k]] for k in range(size)])
            image = Matrix([[c] for c in centre]) - inverse * values + (identity - inverse * matrix) * spread
            solved = [image[k, 0] for k in range(size)]
        except (OutOfDomain, ZeroDivisionError, OverflowError, ValueError):
            return None
        if not all(b.contains_interior(s) for b, s in zip(box, solved, strict=True)):
            return None
    return exact, dict(zip(unknowns, solved, strict=True))
