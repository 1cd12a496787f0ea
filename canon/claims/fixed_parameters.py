"""A region at fixed values of some of its names."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from canon.decide.derivative import substitute
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape
from canon.errors import InputError


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
