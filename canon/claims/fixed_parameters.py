"""A region at fixed values of some of its names, and one whose surface says what a parameter is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from canon.decide.derivative import derivative, substitute
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape
from canon.errors import InputError
from canon.sign import declared

if TYPE_CHECKING:
    import sympy as sp

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
    """The surfaces F_k(z) = E_k of all values of parameters E_k, as the whole space with F_k(z) in place of E_k.

    What holds on all these surfaces holds there, and the other way round. None where the surface is no such graph: a
    whole number, or a real one beside complex variables, has not every value of F_k.
    """
    from canon.claims.chart import required_of

    tape = question.tape
    images: dict[Node, Node] = {}
    symbols = {tape.symbol(symbol): symbol for symbol in question.space.parameters}
    for equation in region.surface:
        for x in symbols:
            slope = tape.value(derivative(tape, equation, x)) if x in tape.support(equation) else None
            if slope and x not in images:
                images[x] = tape.scaled(substitute(tape, equation, {x: tape.zero}), -1 / slope)
                break
        else:
            return None
    if not images or any(x in tape.support(image) for image in images.values() for x in images):
        return None
    if not all(_takes_all_values(tape, symbols[x], image) for x, image in images.items()):
        return None
    moved = fixed_region(tape, Region(region.requirements, (), region.symbols), images)
    if moved is None:
        return None
    for x, image in images.items():
        moved = moved.also(*required_of(tape, symbols[x], image))
    return images, moved


def _takes_all_values(tape: Tape, symbol: sp.Symbol, image: Node) -> bool:
    """Whether a name may be any value of the node that its sign allows."""
    facts = declared(symbol)
    return not facts.get("integer") and not (facts.get("real") and tape.is_complex(image))
