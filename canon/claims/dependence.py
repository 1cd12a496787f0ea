"""Where functions that are independent near one point are dependent: a refutation of `independent`.

The claim is made for every component of the domain, all values of the parameters and all arbitrary functions. So it is
refuted by an open set on which all maximal minors of the Jacobian vanish, by values of parameters at which they vanish
identically (a·x at a = 0), or by functions for which they do (V(x + y) and x + y where V is constant).
"""

from __future__ import annotations

import contextlib
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

import sympy as sp

from canon.budget import BudgetExceeded
from canon.claims.fixed_parameters import moved_region
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.parameters import solutions
from canon.claims.show import FAILURES, is_short
from canon.decide.derivative import rebuild, substitute
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.region import Region, Requirement, admits
from canon.decide.sample import Sample, evaluate_again
from canon.decide.search import samples
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import InputError
from canon.mechanics.formulas import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question

MOST_SIDES = 3
MOST_NAMES = 4
FURTHER = (sp.S.One, sp.S.Half, sp.Integer(2), sp.S.NegativeOne, sp.Integer(3))
POINTS = 40
WIDTH = Fraction(1, 2**20)
TINY = 1e-100
VALUES = (sp.S.Zero, sp.S.One, sp.S.NegativeOne, sp.pi, sp.pi / 2)
THEOREM = "all maximal minors of the Jacobian vanish"

Move = Callable[[Node], Node]


def dependent_somewhere(
    question: Question, minors: Sequence[Node], parameters: Sequence[Node], region: Region, *, everywhere: bool
) -> Outcome | None:
    """A refutation by an open set (`everywhere`), by parameters or by functions at which all minors vanish, or None."""
    part = replace(question, budget=question.budget.share(0.7))
    arguments = [_at_parameters, _for_functions, *((_on_a_side, _near_a_point) if everywhere else ())]
    for argument in arguments:
        try:
            found = argument(part, minors, parameters, region)
        except (BudgetExceeded, Unsupported):
            continue
        if found is not None:
            return found
    return None


# -- parameters and functions -----------------------------------------------------------------------------


def _at_parameters(
    question: Question, minors: Sequence[Node], parameters: Sequence[Node], region: Region
) -> Outcome | None:
    tape = question.tape
    for table in _tables(tape, minors, parameters):
        images = {tape.symbol(name): tape.load(value) for name, value in table.items()}

        def with_values(node: Node, images: Mapping[Node, Node] = images) -> Node:
            return substitute(tape, node, images)

        moved = moved_region(tape, region, with_values) if _allowed(tape, images) else None
        found = None if moved is None else _vanishing(question, minors, with_values, moved)
        if found is not None:
            return found.with_detail(dependent_at={str(name): str(value) for name, value in table.items()})
    return None


def _tables(tape: Tape, minors: Sequence[Node], parameters: Sequence[Node]) -> Iterator[Mapping[sp.Symbol, sp.Expr]]:
    """Values of parameters to try: solutions of the minors' coefficients, then 0 and ±1 for one or all of them."""
    used = [x for x in parameters if any(x in tape.support(minor) for minor in minors)][:MOST_NAMES]
    names = [tape.symbol_at(x) for x in used]
    if names and all(is_short(tape, minor) for minor in minors):
        with contextlib.suppress(*FAILURES):
            for table in solutions([tape.to_sympy(minor) for minor in minors], names):
                free = [name for name in names if any(name in value.free_symbols for value in table.values())]
                for number in FURTHER if free else FURTHER[:1]:
                    rest: dict[sp.Symbol, sp.Expr] = dict.fromkeys(free, number)
                    yield {**{name: replaced(value, rest) for name, value in table.items()}, **rest}
    for value in VALUES:
        yield from ({name: value} for name in names)
        if len(names) > 1:
            yield dict.fromkeys(names, value)


def _allowed(tape: Tape, images: Mapping[Node, Node]) -> bool:
    """Whether the values are numbers that the assumptions on their names certainly allow."""
    nodes = list(images.values())
    if any(tape.support(node) or tape.functions_of([node]) for node in nodes):
        return False
    try:
        with precision(128):
            balls = evaluate(tape, tape.reach(nodes), {})
            return all(admits(tape.symbol_at(name), balls[image]) for name, image in images.items())
    except (OutOfDomain, Unsupported, ZeroDivisionError):
        return False


def _for_functions(
    question: Question, minors: Sequence[Node], parameters: Sequence[Node], region: Region
) -> Outcome | None:
    tape = question.tape
    names = sorted(tape.functions_of([*minors, *region.nodes()]))
    if not names or len(names) > MOST_NAMES:
        return None
    for choice in product(CHOICES, repeat=len(names)):
        chosen = dict(zip(names, choice, strict=True))

        def with_functions(node: Node, chosen: Mapping[str, str] = chosen) -> Node:
            return in_place_of_functions(tape, node, chosen)

        moved = moved_region(tape, region, with_functions)
        found = None if moved is None else _vanishing(question, minors, with_functions, moved)
        if found is not None:
            return found.with_detail(dependent_for=chosen)
    return None


CHOICES = ("0", "1", "the sum of its arguments")


def in_place_of_functions(tape: Tape, node: Node, chosen: Mapping[str, str]) -> Node:
    """The node with 0, 1 or the sum of its arguments in place of each arbitrary function, derivatives included."""
    values: dict[Node, Node] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] != "u" or op[1] not in chosen:
            values[i] = rebuild(tape, i, values)
        elif sum(op[2]) > 1 or (chosen[op[1]] in ("0", "1") and any(op[2])):
            values[i] = tape.zero
        elif any(op[2]):
            values[i] = tape.one
        else:
            choice = chosen[op[1]]
            values[i] = tape.plus(*(values[a] for a in op[3])) if choice not in ("0", "1") else tape.number(int(choice))
    return values[node]


def _vanishing(question: Question, minors: Sequence[Node], move: Move, region: Region) -> Outcome | None:
    """A refutation, if the minors so changed vanish on the region, which is shown to have a point."""
    try:
        residuals = [Residual("a minor", move(minor)) for minor in minors]
        outcome = question.decide(residuals, region, budget=question.budget.share(0.5))
        if outcome.status != "proved":
            return None
        dependent = question.refuted_exactly(region, THEOREM)
    except (InputError, ZeroDivisionError):
        return None
    return combined([dependent, *([outcome] if dependent.status == "refuted" else [])])


# -- open sets ----------------------------------------------------------------------------------------------


def _on_a_side(
    question: Question, minors: Sequence[Node], parameters: Sequence[Node], region: Region
) -> Outcome | None:
    """One side of the zeros of an absolute value's argument."""
    tape = question.tape
    arguments = {tape.ops[i][2][0] for i in tape.reach(minors) if tape.ops[i][0] == "f" and tape.ops[i][1] == "abs"}
    for argument in sorted(arguments)[:MOST_SIDES]:
        for sign in (1, -1):
            side = tape.scaled(argument, sign)
            wall = Requirement("positive", (side,), "one side of an absolute value")
            found = _vanishing(question, minors, lambda node: node, region.also(wall))
            if found is not None:
                return found.with_detail(dependent_where=f"{question.show(side)} > 0")
    return None


def _near_a_point(
    question: Question, minors: Sequence[Node], parameters: Sequence[Node], region: Region
) -> Outcome | None:
    """A small box around a point at which all minors are within 1e-100 of 0."""
    tape = question.tape
    if region.surface or tape.functions_of([*minors, *region.nodes()]):
        return None
    rng = random.Random(question.seed)
    for place in samples(tape, minors, region, rng, count=POINTS, tries=4, budget=question.budget.share(0.5)):
        real = {x: value for x, value in place.point.items() if isinstance(value, Fraction)}
        if len(real) < len(place.point) or not _all_tiny(tape, minors, place):
            continue
        fixed = {x: tape.number(v) for x, v in real.items() if x in parameters or tape.symbol_at(x).is_integer}
        box = [wall for x, v in real.items() if x not in fixed for wall in _walls(tape, x, v)]

        def there(node: Node, fixed: Mapping[Node, Node] = fixed) -> Node:
            return substitute(tape, node, fixed)

        moved = moved_region(tape, region, there)
        found = None if moved is None else _vanishing(question, minors, there, moved.also(*box))
        if found is not None:
            point = {str(tape.symbol_at(x)): str(v) for x, v in place.point.items()}
            return found.with_detail(dependent_near=point)
    return None


def _all_tiny(tape: Tape, minors: Sequence[Node], place: Sample) -> bool:
    if any(not place.balls[minor].contains(0) for minor in minors):
        return False
    try:
        balls = evaluate_again(tape, minors, place, 512)
    except (OutOfDomain, Unsupported, ZeroDivisionError):
        return False
    with precision(64):
        return all(float(balls[minor].abs_upper()) < TINY for minor in minors)


def _walls(tape: Tape, x: Node, value: Fraction) -> Iterator[Requirement]:
    for slope in (1, -1):
        bound = tape.add(((x, slope),), WIDTH - slope * value)
        yield Requirement("positive", (bound,), f"{tape.symbol_at(x)} within {WIDTH} of {value}")
