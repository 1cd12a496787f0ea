"""Whether a domain has the same points, whatever the values of the parameters and the arbitrary functions are.

What doesn't vanish at one point of a domain vanishes identically nowhere else only if that point is in the domain of
other values, too: of q > d nothing is left for d = 10 where q < 10, and of q = |d| another point for each d.
"""

from __future__ import annotations

from collections.abc import Collection

from canon.decide.region import Region
from canon.decide.tape import Node, Tape


def has_the_same_points(tape: Tape, region: Region, parameters: Collection[Node]) -> bool:
    """No condition, and no equation, ties variables to these parameters or to a function: each is about one of them."""
    tied = [requirement.nodes for requirement in region.requirements] + [(equation,) for equation in region.surface]
    return all(_is_of_one_kind(tape, nodes, frozenset(parameters)) for nodes in tied)


def _is_of_one_kind(tape: Tape, nodes: Collection[Node], parameters: frozenset[Node]) -> bool:
    names = frozenset[Node]().union(*(tape.support(node) for node in nodes))
    return names <= parameters or (names.isdisjoint(parameters) and not tape.functions_of(nodes))
