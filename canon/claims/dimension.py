"""Physical dimensions: what becomes of a formula when the units are changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.dimension_keys import Dimension, Dimensions, written
from canon.claims.other_units import Degree, in_other_units
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.own_names import of_integers
from canon.decide.derivative import derivative, substitute
from canon.decide.tape import Node, Tape
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

DENOMINATORS = 6


def dimension(question: Question) -> Outcome:
    """`dimension`: each of `functions` has the dimension `equals`, where names have those of the table `dimensions`.

    A name that isn't listed is a pure number. In units smaller by factors λ of the base, a quantity of dimension
    L^d grows by λ^d; a formula has the dimension L^D if its value then grows by λ^D, at every point and for every λ,
    which is Euler's identity Σ d x ∂f/∂x = D f for each base (Bridgman, Dimensional Analysis, ch. 2), wherever the
    domain is carried along; else the values in other units are compared themselves. For an arbitrary function, its own
    dimension and those of its arguments are listed: V = ["M*L**2/T**2", "L"].
    """
    functions = question.formulas("functions", side="both")
    table: Dimensions = question.key("dimensions")
    claimed: Dimension = question.key("equals")
    for name, listed in table.items():
        if any(listed):
            of_integers(question.space.vocabulary.get(name), "key 'dimensions'")
    bases = sorted({b for listed in table.values() for d in listed for b in d} | {*claimed})
    region = question.region(*functions)
    residuals = []
    for formula in functions:
        node = question.load(formula)
        for base in bases or [""]:
            growth = _Growth(question.tape, table, base)
            change = question.tape.minus(growth.of(node), question.tape.scaled(node, claimed.get(base, Fraction(0))))
            residuals.append(Residual(f"power of {base or 'no base'} in {formula}", question.chart.pull(change)))
            residuals += [Residual(said, question.chart.pull(n)) for said, n in growth.arguments.items()]
    outcome = question.decide(residuals, region)
    if outcome.status == "refuted":
        found = [_own_dimension(question, question.load(f), table, bases, region, outcome) for f in functions]
        if None not in found:
            return outcome.with_detail(dimensions=[written(d) for d in found if d is not None])
        return outcome

    def power(name: str, position: int) -> Degree:
        listed = table.get(name)
        return tuple(Fraction(0) if listed is None else listed[position].get(b, Fraction(0)) for b in bases)

    afar = in_other_units(question, functions, bases, power, tuple(claimed.get(b, Fraction(0)) for b in bases))
    return outcome if afar is None else combined([outcome, afar])


@dataclass
class _Growth:
    """The rate at which nodes grow with the logarithm of one base's factor."""

    tape: Tape
    table: Dimensions
    base: str

    def __post_init__(self) -> None:
        self.arguments: dict[str, Node] = {}

    def power(self, name: str, position: int = 0) -> Fraction:
        """The power of the base in a name's dimension, or in that of an argument of a function."""
        listed = self.table.get(name)
        return Fraction(0) if listed is None else listed[position].get(self.base, Fraction(0))

    def of(self, node: Node) -> Node:
        """Σ d x ∂f/∂x, and what changes of units do to the arbitrary functions."""
        known: dict[Node, Node] = {}
        for i in self.tape.reach([node]):
            known[i] = self._step(i, known)
        return known[node]

    def _step(self, i: Node, known: Mapping[Node, Node]) -> Node:
        tape, op = self.tape, self.tape.ops[i]
        if op[0] == "s":
            return tape.scaled(i, self.power(str(tape.symbol_at(i))))
        if op[0] == "+":
            return tape.add([(known[a], c) for a, c in op[2]])
        if op[0] == "*":
            terms = [(tape.mul(((i, 1), (known[a], 1), (a, -1))), e) for a, e in op[1] if known[a] != tape.zero]
            return tape.add(terms)
        if op[0] == "r":
            if known[op[1]] == tape.zero:
                return tape.zero
            return tape.mul(((i, 1), (known[op[1]], 1), (op[1], -1)), Fraction(op[2], op[3]))
        if op[0] == "f":
            return self._called(op[1], op[2], known)
        return self._arbitrary(i, known) if op[0] == "u" else tape.zero

    def _called(self, name: str, arguments: tuple[Node, ...], known: Mapping[Node, Node]) -> Node:
        tape = self.tape
        if all(known[a] == tape.zero for a in arguments):
            return tape.zero
        places = [tape.symbol(sp.Dummy(real=True)) for _ in arguments]
        call, images = tape.call(name, *places), dict(zip(places, arguments, strict=True))
        terms = [
            tape.times(substitute(tape, derivative(tape, call, x), images), known[a])
            for x, a in zip(places, arguments, strict=True)
            if known[a] != tape.zero
        ]
        return tape.plus(*terms)

    def _arbitrary(self, i: Node, known: Mapping[Node, Node]) -> Node:
        tape = self.tape
        _, name, orders, arguments = tape.ops[i]
        listed = self.table.get(name)
        if listed is not None and len(listed) != len(arguments) + 1:
            said = f"{name!r} has {len(arguments)} arguments: list its own dimension, then those of its arguments"
            raise InputError(said, "key 'dimensions'")
        powers = [self.power(name, k) for k in range(1, len(arguments) + 1)]
        total = self.power(name) - sum((d * n for d, n in zip(powers, orders, strict=True)), Fraction(0))
        terms = [tape.scaled(i, total)]
        for k, (a, d) in enumerate(zip(arguments, powers, strict=True)):
            change = tape.minus(known[a], tape.scaled(a, d))
            if change != tape.zero:
                self.arguments[f"power of {self.base} in argument {k + 1} of {name}"] = change
                slope = tape.arbitrary(name, (*orders[:k], orders[k] + 1, *orders[k + 1 :]), arguments)
                terms.append(tape.times(slope, change))
        return tape.plus(*terms)


def _own_dimension(
    question: Question, node: Node, table: Dimensions, bases: list[str], region: Region, outcome: Outcome
) -> Dimension | None:
    """The dimension that the formula has, where it has one with small exponents."""
    tape, found = question.tape, {}
    failed = outcome.failed
    sample = failed.answer.witness.sample if failed is not None and failed.answer.witness is not None else None
    if sample is None:
        return None
    from canon.decide.enclosure import OutOfDomain
    from canon.decide.sample import evaluate_again
    from canon.decide.tape import Unsupported

    for base in bases:
        growth = _Growth(tape, table, base).of(node)
        pulled = [question.chart.pull(n) for n in (node, growth)]
        try:
            balls = evaluate_again(tape, pulled, sample, 64)
            ratio = balls[pulled[1]] / balls[pulled[0]]  # which is complex where values are
            power = Fraction(float(getattr(ratio, "real", ratio).mid())).limit_denominator(DENOMINATORS)
        except (AttributeError, ArithmeticError, OutOfDomain, Unsupported, ValueError, OverflowError, KeyError):
            return None
        rest = Residual("", tape.minus(pulled[1], tape.scaled(pulled[0], power)))
        if question.decide([rest], region).status != "proved":
            return None
        if power:
            found[base] = power
    return found


KINDS = {"dimension": dimension}
