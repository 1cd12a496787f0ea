"""Is a quantity a constant, the same at all values of the variables, and which?

The constant is guessed at a point where the quantity was looked at, and the guess is then decided. That it is no
constant follows from two points of the domain at which it differs, the parameters being the same at both.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.outcome import Outcome, Residual
from canon.claims.show import FAILURES, is_short, neat
from canon.decide.derivative import substitute
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import InputError
from canon.sign import known_sign

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.answer import Witness

SIMPLE = 10_000
Values = dict[Node, Node]


def constant_of(
    question: Question, region: Region, node: Node, variables: set[Node], witness: Witness, label: str
) -> tuple[Node | None, Outcome]:
    """The constant that the node is on the region, with the outcome that says so; None where none was found.

    **Arguments:** `variables`, on which a constant doesn't depend; `witness`, a point of the region with the value of
    node − 1 there; `label`, the node's name for people.
    """
    tape = question.tape
    name = f"{label} is constant"
    values = _values(tape, witness.coordinates, variables)
    place = values if values is not None and tape.support(node) & variables <= set(values) else None
    for guess in _guesses(tape, node, place, witness):
        if tape.support(guess) & variables or not _defined_everywhere(tape, guess):
            continue
        same = question.decide([Residual(name, tape.minus(node, guess))], region)
        if same.status == "proved":
            return guess, same
    there = None if place is None or _is_approximate(witness) else _also_at(tape, region, place)
    if place is None or there is None:
        return None, Outcome("undecided", note=f"the constant that {label} may be was not found")
    value = substitute(tape, node, place)
    same = question.decide([Residual(name, tape.minus(node, value))], there)
    if same.status == "refuted":
        return None, same
    if same.status == "proved" and len(there.requirements) > len(region.requirements):
        same = same.with_status("supported", f"{label} is constant where the parameters leave one point in the domain")
    return value if same.status in ("proved", "supported") else None, same


def _values(tape: Tape, point: Mapping[str, Any], variables: set[Node]) -> Values | None:
    """The variables' values at a point of a witness; None where one of them is no number."""
    values: Values = {}
    for node in variables:
        value = point.get(str(tape.symbol_at(node)))
        try:
            if isinstance(value, Mapping):
                unit = tape.constant("I")
                values[node] = tape.add([(tape.one, Fraction(value["re"])), (unit, Fraction(value["im"]))])
            elif value is not None:
                values[node] = tape.number(Fraction(value))
        except ValueError:
            return None
    return values


def _is_approximate(witness: Witness) -> bool:
    """True where a coordinate was solved for and is known by its decimals only."""
    return any(isinstance(value, str) and "." in value for value in witness.coordinates.values())


def _guesses(tape: Tape, node: Node, place: Values | None, witness: Witness) -> Iterator[Node]:
    """Simple constants that the node may be: the nearest simple number, the value at the point, parameters left free.

    Nothing rests on a guess, so that it may come from an approximate point.
    """
    near = _near(witness.value)
    if near is not None:
        yield tape.number(near)
    if place is None:
        return
    try:
        value = substitute(tape, node, place)
    except InputError:
        return
    if tape.functions_of([value]) or not is_short(tape, value):
        return
    expression = tape.to_sympy(value)
    try:
        shorter = neat(expression)
        guesses = [_rounded(shorter)] if _is_approximate(witness) else [shorter, expression]
        nodes = [tape.load(guess) for guess in dict.fromkeys(guesses)]
    except (*FAILURES, Unsupported, InputError):
        return
    yield from nodes


def _near(text: str) -> Fraction | None:
    """One more than the value in a witness, as the simple number that it is nearly."""
    try:
        value = Fraction(text) + 1
    except ValueError:
        return None
    simple = value.limit_denominator(SIMPLE)
    return simple if abs(simple - value) <= Fraction(1, 10**9) * max(1, abs(value)) else None


def _rounded(expression: sp.Expr) -> sp.Expr:
    """The expression with simple numbers in place of those that are nearly so."""
    numbers: dict[Any, Any] = {}
    for number in sp.expand(expression).atoms(sp.Rational):
        simple = sp.Rational(Fraction(int(number.p), int(number.q)).limit_denominator(SIMPLE))
        if abs(simple - number) < sp.Rational(1, 10**20):
            numbers[number] = simple
    return sp.expand(expression).xreplace(numbers)


def _defined_everywhere(tape: Tape, node: Node) -> bool:
    """True when the node is smooth at almost all values of its symbols, as it is written."""
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] == "u":
            return False
        if op[0] == "r" and tape.support(i) and known_sign(tape.to_sympy(op[1])) != "positive":
            return False
        if op[0] == "f" and tape.support(i) and op[1] not in ("sin", "cos", "exp"):
            return False
    return True


def _also_at(tape: Tape, region: Region, place: Values) -> Region | None:
    """The region where its own point with these values of the variables lies in it too, parameters being the same.

    None where a surface would have to be met by both points.
    """
    requirements: list[Requirement] = []
    try:
        if any(tape.support(substitute(tape, equation, place)) for equation in region.surface):
            return None
        for requirement in region.requirements:
            nodes = tuple(substitute(tape, node, place) for node in requirement.nodes)
            if any(tape.support(node) for node in nodes) and nodes != requirement.nodes:
                requirements.append(Requirement(requirement.kind, nodes, requirement.said, " (at the first point)"))
    except InputError:
        return None
    return region.also(*requirements)
