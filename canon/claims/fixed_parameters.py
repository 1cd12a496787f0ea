"""A region at fixed values of some of its names, and one whose surface says what a parameter is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from canon.decide.derivative import derivative, substitute
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question


def fixed_region(tape: Tape, region: Region, values: Mapping[Node, Node]) -> Region | None:
    """The region with these names replaced; None where one of its conditions can't hold there."""
    moved = moved_region(tape, region, lambda node: substitute(tape, node, values))
    return (
        None
        if moved is None
        else Region(moved.requirements, moved.surface, tuple(x for x in moved.symbols if x not in values))
    )


def moved_region(tape: Tape, region: Region, move: Callable[[Node], Node]) -> Region | None:
    """The region with each of its nodes replaced by another; None where a condition can't hold any more."""
    try:
        requirements = [Requirement(r.kind, tuple(map(move, r.nodes)), r.said, r.note) for r in region.requirements]
        surface = tuple(map(move, region.surface))
    except (InputError, ZeroDivisionError):
        return None
    left = []
    for r in requirements:
        value = tape.value(r.nodes[0])
        if value is None or r.kind not in ("positive", "nonzero"):
            left.append(r)
        elif value == 0 or (r.kind == "positive" and value < 0):
            return None
    return Region(tuple(left), surface, region.symbols)


def unfolded(question: Question, region: Region) -> tuple[dict[Node, Node], Region] | None:
    """The surface H(z) = E of every value of a parameter E, as the whole space with H(z) in place of E.

    What holds on all these surfaces holds there, and the other way round. None where the surface is no such graph.
    """
    from canon.claims.question import required_of

    tape = question.tape
    if len(region.surface) != 1:
        return None
    (equation,) = region.surface
    for symbol in question.space.parameters:
        x = tape.symbol(symbol)
        slope = tape.value(derivative(tape, equation, x)) if x in tape.support(equation) else None
        if not slope:
            continue
        images = {x: tape.scaled(substitute(tape, equation, {x: tape.zero}), -1 / slope)}
        open_part = Region(region.requirements, (), region.symbols)
        moved = fixed_region(tape, open_part, images)
        if x in tape.support(images[x]) or moved is None:
            continue
        return images, moved.also(*required_of(tape, symbol, images[x]))
    return None
