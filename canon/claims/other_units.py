"""Formulas in other units, by any factors: are they what they were, times a power?

Euler's identity says so of factors near 1. It says so of all of them where the domain is carried along: where each of
its conditions has a dimension of its own, so that its sign stays what it is. sign(x − 1) has the slope 0 everywhere,
and is another number in other units.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.outcome import Outcome, Residual
from canon.decide.derivative import rebuild
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.expression import Formula

Degree = tuple[Fraction, ...]
"""The power of each base."""
Power = Callable[[str, int], Degree]
"""The dimension of a name; of an arbitrary function that of its k-th argument, or, for k = 0, its own."""
NOT_SEEN = "whether both values are in the domain isn't seen, which the map bounds: leave it out of this claim's file"
NOT_CARRIED = "the surface is another one in other units: no formula on it has a dimension"


def in_other_units(
    question: Question, functions: Sequence[Formula], bases: Sequence[str], power: Power, claimed: Degree
) -> Outcome | None:
    """Are the functions, at two points of the domain that differ by factors of the units, as these say?

    None where Euler's identity suffices, since every condition of the domain holds at both or at neither.
    """
    tape = question.tape
    written = Region.of(tape, question.domain(*functions))
    if all(_degree(tape, n, power, len(bases)) is not None for n in _conditions(question, written)):
        return None
    if any(_degree(tape, n, power, len(bases)) is None for n in written.surface):
        return Outcome("undecided", note=NOT_CARRIED)
    moved = _Moved(tape, power, [tape.symbol(sp.Symbol(f"#{b}", positive=True)) for b in bases])
    there = [
        Requirement(r.kind, tuple(question.chart.pull(moved(n)) for n in r.nodes), r.said, " (in other units)")
        for r in written.requirements
    ]
    residuals = []
    for formula in functions:
        node = question.load(formula)
        change = tape.minus(moved(node), tape.times(moved.factor(claimed), node))
        residuals.append(Residual(f"{formula} in other units", question.chart.pull(change)))
    region = question.region(*functions).also(*there)
    found = question.decide(residuals, region)
    return Outcome("undecided", note=NOT_SEEN) if found.status == "refuted" and _is_bound_by_map(question) else found


def _is_bound_by_map(question: Question) -> bool:
    """Whether the map restricts old variables to its image, or to what is assumed of the new ones."""
    signs = (x.is_extended_nonnegative or x.is_extended_nonpositive or x.is_zero is False for x in question.space.new)
    return question.chart.direction in ("backward", "implicit") or (
        question.chart.direction == "forward" and any(signs)
    )


def _conditions(question: Question, written: Region) -> list[Node]:
    """What the domain and the surface ask about, as functions of the names."""
    singular = question.chart.hessian
    return [*written.nodes(), *(() if singular is None else (singular,))]


def _degree(tape: Tape, node: Node, power: Power, count: int) -> Degree | None:
    """The dimension of a formula as it is built up; None where it isn't seen to have one."""
    nothing = (Fraction(0),) * count
    known: dict[Node, Degree | None] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        parts = [known[a] for a in tape.arguments(i)]
        if None in parts:
            return None
        if op[0] == "s":
            known[i] = power(str(tape.symbol_at(i)), 0)
        elif op[0] == "+":
            known[i] = parts[0] if len({*parts, *((nothing,) if op[1] else ())}) == 1 else None
        elif op[0] == "*":
            known[i] = _total(count, [(known[a] or nothing, Fraction(e)) for a, e in op[1]])
        elif op[0] == "r":
            known[i] = _total(count, [(parts[0] or nothing, Fraction(op[2], op[3]))])
        elif op[0] == "u":
            listed = [power(op[1], k) for k in range(1, len(op[3]) + 1)]
            slopes = [(d, Fraction(-n)) for d, n in zip(listed, op[2], strict=True)]
            known[i] = _total(count, [(power(op[1], 0), Fraction(1)), *slopes]) if parts == listed else None
        elif op[0] == "f" and op[1] == "abs":
            known[i] = parts[0]
        elif op[0] == "f":
            same = op[1] in ("sign", "atan2") and len({*parts}) == 1
            known[i] = nothing if same or all(d == nothing for d in parts) else None
        else:
            known[i] = nothing
    return known[node]


def _total(count: int, parts: Sequence[tuple[Degree, Fraction]]) -> Degree:
    return tuple(sum((d[k] * e for d, e in parts), Fraction(0)) for k in range(count))


class _Moved:
    """A formula at the names' values in other units; arbitrary functions are those that they are in these units."""

    def __init__(self, tape: Tape, power: Power, factors: Sequence[Node]) -> None:
        self.tape, self.power, self.factors = tape, power, factors
        self.values: dict[Node, Node] = {}

    def factor(self, degree: Degree, sign: int = 1) -> Node:
        """By what a quantity of this dimension grows."""
        tape = self.tape
        return tape.times(*(tape.root(x, sign * d) for x, d in zip(self.factors, degree, strict=True) if d))

    def __call__(self, node: Node) -> Node:
        for i in self.tape.reach([node]):
            if i not in self.values:
                self.values[i] = self._step(i, self.values)
        return self.values[node]

    def _step(self, i: Node, values: Mapping[Node, Node]) -> Node:
        tape, op = self.tape, self.tape.ops[i]
        if op[0] == "s":
            return tape.times(self.factor(self.power(str(tape.symbol_at(i)), 0)), i)
        if op[0] != "u":
            return rebuild(tape, i, values)
        name, orders, arguments = op[1:]
        listed = [self.power(name, k) for k in range(1, len(arguments) + 1)]
        own = [self.power(name, 0), *(tuple(-n * x for x in d) for d, n in zip(listed, orders, strict=True))]
        at = [tape.times(self.factor(d, -1), values[a]) for a, d in zip(arguments, listed, strict=True)]
        return tape.times(*(self.factor(d) for d in own), tape.arbitrary(name, orders, tuple(at)))
