"""Convex cells: the region cut along the zeros of its conditions, so that signs and connectedness are known.

The cut set has measure zero and every residual is continuous on the region, so what vanishes on every
cell vanishes on the region. A cell whose remaining conditions all have a definite sign on its box is
the box itself: convex, hence connected.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from flint import fmpq_poly

from canon.budget import Budget
from canon.decide.components import pieces
from canon.decide.connected import is_connected
from canon.decide.defined_functions import conjugate
from canon.decide.derivative import derivative, substitute
from canon.decide.intervals import ORIGIN, Edge, Interval, declared, exact_affine, intervals_of, leaves_out_zero
from canon.decide.region import Region, Requirement
from canon.decide.regular_on_box import is_regular
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Node, Tape

MOST_CELLS, MOST_QUARTERS = 48, 20


@dataclass(frozen=True)
class Cell:
    """A box of exact intervals; `whole` says that all of it is in the region, `connected` that the part of it is that
    is there."""

    intervals: dict[Node, Interval]
    connected: bool
    whole: bool
    region: Region

    def slice(self, tape: Tape, symbol: Node, value: Node, *, inside: bool = True) -> Cell:
        """The box where one coordinate has a value inside its interval (or at its end), of a cell that is whole."""
        fixed = {symbol: value}
        asked = [r for r in self.region.requirements if inside or not any(symbol in tape.support(n) for n in r.nodes)]
        kept = [replace(r, nodes=tuple(substitute(tape, n, fixed) for n in r.nodes)) for r in asked]
        intervals = {node: interval for node, interval in self.intervals.items() if node != symbol}
        symbols = tuple(node for node in self.region.symbols if node != symbol)
        return Cell(intervals, True, True, Region(tuple(kept), (), symbols))

    def describe(self, tape: Tape) -> str:
        """The cell in words, for the certificate."""
        parts = []
        for node, interval in sorted(self.intervals.items()):
            low = "" if interval.low is None else f"{_shown(interval.low)} < "
            high = "" if interval.high is None else f" < {_shown(interval.high)}"
            if low or high:
                parts.append(f"{low}{tape.symbol_at(node)}{high}")
        return ", ".join(parts) or "everywhere"


def cells_of(
    tape: Tape, region: Region, nodes: Sequence[Node], budget: Budget, *, finer: bool = False
) -> list[Cell] | None:
    """The cells of the region that can contain points, or None where it can't be cut so (surfaces, complex symbols).

    `finer`: cut where the derivatives of conditions vanish too, and look whether what is left of a box is connected;
    None where that shows no more.
    """
    if region.surface:
        return None
    symbols = set().union(*(tape.support(n) for n in [*nodes, *region.nodes()]))
    if any(not tape.symbol_at(n).is_real or tape.symbol_at(n).is_integer for n in symbols):
        return None
    box = {n: declared(tape, n) for n in symbols}
    box.update({n: i for n, i in intervals_of(tape, region).items() if n in symbols})
    cuts: dict[Node, list[Edge]] = {n: [ORIGIN] for n in symbols if leaves_out_zero(tape, n, box[n])}
    for requirement in region.requirements:
        for node in _factors(tape, requirement):
            for symbol, edge in _zeros(tape, node):
                known = cuts.setdefault(symbol, [])
                if all(edge.compare(other) for other in known):
                    known.append(edge)
        for symbol, edge in (*_quarter_turns(tape, requirement, box), *_turning_points(tape, requirement, finer)):
            known = cuts.setdefault(symbol, [])
            if all(edge.compare(other) for other in known):
                known.append(edge)
    pieces = {n: _pieces(box[n], cuts.get(n, ())) for n in symbols}
    total = 1
    for intervals in pieces.values():
        total *= max(1, len(intervals))
    if total > MOST_CELLS:
        return None
    names = sorted(pieces)
    out = []
    for choice in itertools.product(*(pieces[n] for n in names)):
        budget.check()
        intervals = dict(zip(names, choice, strict=True))
        state, unsure = state_on(tape, region, intervals, budget)
        if state != "outside":
            whole = state == "inside"
            joined = whole or (finer and unsure is not None and is_connected(tape, unsure, intervals, budget))
            out.append(Cell(intervals, joined, whole, region.also(*_walls(tape, intervals))))
    return out


def _factors(tape: Tape, requirement: Requirement) -> Iterable[Node]:
    if requirement.kind == "slit":
        for found in pieces(tape, parts_of_slit(tape, requirement)[:1]):
            yield from (piece.node for piece in found)
        return
    for node in requirement.nodes:
        yield node
        op = tape.ops[node]
        bare = op[2][0][0] if op[0] == "+" and not op[1] and len(op[2]) == 1 else node  # without a number as a factor
        yield from (inner for inner, _ in tape.ops[bare][1]) if tape.ops[bare][0] == "*" else (bare,)


def parts_of_slit(tape: Tape, requirement: Requirement) -> tuple[Node, ...]:
    """The imaginary and the real part of what must not lie in (−∞, 0], for an expression in real names."""
    (node,) = requirement.nodes
    unit, other = tape.constant("I"), conjugate(tape, node)
    imaginary = tape.scaled(tape.times(unit, tape.minus(node, other)), Fraction(-1, 2))
    return imaginary, tape.scaled(tape.plus(node, other), Fraction(1, 2))


def _quarter_turns(tape: Tape, requirement: Requirement, box: dict[Node, Interval]) -> Iterable[tuple[Node, Edge]]:
    """Where a bounded angle passes a multiple of π/2, so that its cosine or sine changes sign.

    It is the argument of a sine or cosine that is a factor of the condition, or is i times in an exponent of a slit's.
    """
    unit, every, even, odd = tape.constant("I"), range(4), (0, 2), (1, 3)
    if requirement.kind == "slit":
        exponents = [op[2][0] for i in tape.reach(requirement.nodes) if (op := tape.ops[i])[:2] == ("f", "exp")]
        angles = [(tape.mul(((node, 1), (unit, -1))), every) for node in exponents]
    else:
        factors = [tape.ops[node] for node in _factors(tape, requirement)]
        waves = [op for op in factors if op[:2] in (("f", "sin"), ("f", "cos"))]
        angles = [(op[2][0], even if op[1] == "sin" else odd) for op in waves]
    for angle, quarters in angles:
        form = exact_affine(tape, angle)
        if form is None or form[2] not in box:
            continue
        constant, slope, symbol = form
        image = box[symbol].affine(slope, constant)
        if image.low is None or image.high is None:
            continue
        first = Edge(image.low.rational * 2, image.low.pi * 2).floor_of_multiple_of_pi()
        for k in (k for k in range(first, first + MOST_QUARTERS) if k % 4 in quarters):
            yield symbol, Edge(Fraction(0), Fraction(k, 2)).plus(constant.scaled(Fraction(-1))).scaled(1 / slope)


def _zeros(tape: Tape, node: Node) -> list[tuple[Node, Edge]]:
    """Zeros in Q + Q·π of a node in one symbol: of an affine one, or of a polynomial's linear factors."""
    form = exact_affine(tape, node)
    if form is not None:
        constant, slope, symbol = form
        return [(symbol, constant.scaled(-1 / slope))]
    support = tape.support(node)
    if len(support) != 1:
        return []
    (symbol,) = support
    polynomial = univariate(tape, node, symbol)
    if polynomial is None or polynomial.degree() < 1:
        return []
    _, factors = polynomial.factor()
    out = []
    for f, _ in factors:
        if f.degree() == 1:
            root = -f[0] / f[1]
            out.append((symbol, Edge(Fraction(int(root.p), int(root.q)))))
    return out


def univariate(tape: Tape, node: Node, symbol: Node) -> fmpq_poly | None:
    """The node as a polynomial over Q in one symbol, or None."""
    values: dict[Node, fmpq_poly] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] == "n":
            values[i] = fmpq_poly([_fmpq(op[1])])
        elif i == symbol:
            values[i] = fmpq_poly([0, 1])
        elif op[0] == "+":
            total = fmpq_poly([_fmpq(op[1])])
            for a, c in op[2]:
                total = total + values[a] * _fmpq(c)
            values[i] = total
        elif op[0] == "*" and all(0 < e <= 40 for _, e in op[1]):
            total = fmpq_poly([1])
            for a, e in op[1]:
                total = total * values[a] ** e
            values[i] = total
        else:
            return None
    return values[node]


def _fmpq(value: Fraction):
    from canon.decide.arbitrary import rational

    return rational(value)


def _pieces(box: Interval, cuts: Iterable[Edge]) -> list[Interval]:
    """The box cut at the edges that lie inside it."""
    out = [box]
    for edge in cuts:
        split: list[Interval] = []
        for piece in out:
            split += [piece.meet(Interval(high=edge)), piece.meet(Interval(low=edge))]
        out = [piece for piece in split if not piece.is_empty()]
    return out


def _turning_points(tape: Tape, requirement: Requirement, finer: bool) -> Iterable[tuple[Node, Edge]]:
    """Zeros of the derivatives of a condition that isn't affine."""
    if not finer or requirement.kind != "positive" or exact_affine(tape, requirement.nodes[0]) is not None:
        return
    for symbol in sorted(tape.support(requirement.nodes[0])):
        for found in pieces(tape, [derivative(tape, requirement.nodes[0], symbol)]):
            for piece in found:
                yield from _zeros(tape, piece.node)


State = tuple[str, list[Node] | None]


def state_on(tape: Tape, region: Region, intervals: dict[Node, Interval], budget: Budget) -> State:
    """ "inside", "outside" or "unsure": whether each condition has a definite sign on the box.

    With it those that must be positive and aren't known to be; None where there are others of which nothing is known.
    """
    open_ones: list[Node] = []
    others: list[Node | None] = []
    for requirement in region.requirements:
        if requirement.kind == "slit":
            imaginary, real = (definite_sign(tape, n, intervals, budget) for n in parts_of_slit(tape, requirement))
            others += [None] * (imaginary is None and real != "pos")
            continue
        node = requirement.nodes[0]
        sign = definite_sign(tape, node, intervals, budget)
        if requirement.kind == "positive":
            if sign == "neg":
                return "outside", None
            open_ones += [node] * (sign != "pos")
        elif requirement.kind == "nonzero":
            others += [node] * (sign is None)
        elif requirement.kind == "uncut":
            x = definite_sign(tape, requirement.nodes[1], intervals, budget)
            others += [None] * (sign is None and x != "pos")
        else:
            others += [None] * (not is_regular(tape, node, intervals, budget))
    if not open_ones and not others:
        return "inside", []
    implied = {*open_ones, *(tape.negative(node) for node in open_ones)}
    return "unsure", open_ones if all(node in implied for node in others) else None


def _walls(tape: Tape, intervals: dict[Node, Interval]) -> list[Requirement]:
    """The cell's own bounds as requirements, so that sample points lie in it."""
    out = []
    for node, interval in intervals.items():
        for edge, slope in ((interval.low, 1), (interval.high, -1)):
            if edge is not None:
                bound = tape.add(((node, slope), (tape.constant("pi"), -slope * edge.pi)), -slope * edge.rational)
                out.append(Requirement("positive", (bound,), f"{tape.symbol_at(node)} in its cell"))
    return out


def _shown(edge: Edge) -> str:
    parts = [str(edge.rational)] if edge.rational or not edge.pi else []
    if edge.pi:
        parts.append(f"{edge.pi}*pi")
    return " + ".join(parts)
