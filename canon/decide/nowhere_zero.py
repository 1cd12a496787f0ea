"""Functions that aren't identically zero on any open set of the region, though they may vanish at points.

One point at which an analytic function isn't zero serves one connected component. Two arguments serve all of them:
the region's own conditions or signs keep every factor from zero, or each of its cells is a box, hence connected, with a
point of its own.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence

from canon.budget import Budget
from canon.decide.cells import cells_of
from canon.decide.derivative import substitute
from canon.decide.enclosure import excludes_zero
from canon.decide.intervals import Interval, intervals_of, may_be_zero
from canon.decide.region import Region
from canon.decide.search import samples
from canon.decide.sign_on_box import is_zero_free
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import InputError

POINTS = 3


def has_no_zero(tape: Tape, node: Node, region: Region, budget: Budget) -> bool:
    """True when no factor of the node has a zero in the region, whatever parameters and arbitrary functions are."""
    asked = {
        factor
        for requirement in region.requirements
        if requirement.kind in ("positive", "nonzero", "slit")
        for factor in factors(tape, requirement.nodes[0])
    }
    box = intervals_of(tape, region)
    first = [r.nodes[0] for r in region.requirements if r.kind == "positive"]
    positive = [n for n in first if not tape.is_complex(n)]
    return tape.value(node) != 0 and all(
        factor in asked or (not tape.is_complex(factor) and _is_zero_free(tape, factor, box, positive, budget))
        for factor in factors(tape, node)
    )


def _is_zero_free(
    tape: Tape, node: Node, box: Mapping[Node, Interval], positive: Sequence[Node], budget: Budget
) -> bool:
    """Whether the node is 0 nowhere on the box where these are positive.

    Nor where symbols that may be 0 are 0: the box is taken for open.
    """
    value = tape.value(node)
    if value is not None:
        return value != 0
    if not is_zero_free(tape, node, box, budget, positive=positive):
        return False
    weak = [x for x in sorted(tape.support(node)) if may_be_zero(tape, x)]
    try:
        return all(_is_zero_free(tape, substitute(tape, node, {x: tape.zero}), box, (), budget) for x in weak)
    except InputError:  # the node isn't defined there
        return False


def factors(tape: Tape, node: Node) -> Iterator[Node]:
    """What a product, a multiple or a root has its zeros and poles from; numbers are left out."""
    op = tape.ops[node]
    if op[0] == "*":
        inner = [factor for factor, _ in op[1]]
    elif op[0] == "+" and not op[1] and len(op[2]) == 1:
        inner = [op[2][0][0]]
    elif op[0] == "r":
        inner = [op[1]]
    else:
        if tape.value(node) is None:
            yield node
        return
    for factor in inner:
        yield from factors(tape, factor)


def nonzero_on_every_cell(tape: Tape, node: Node, region: Region, rng: random.Random, budget: Budget) -> bool:
    """True when the region is a union of boxes, each with a certified point at which the node isn't 0."""
    cells = cells_of(tape, region, [node], budget)
    if not cells or not all(cell.connected for cell in cells):
        return False
    try:
        return all(
            any(
                excludes_zero(place.balls[node])
                for place in samples(tape, [node], cell.region, rng, count=POINTS, tries=10, budget=budget)
            )
            for cell in cells
        )
    except Unsupported:
        return False
