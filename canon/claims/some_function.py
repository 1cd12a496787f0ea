"""Are there functions with the values that formulas demand of them along a range?

A claim with √V(u) all along a range is one of functions with such values. That there are any is shown by one of
±exp(±a₁ ± a₂ …), which has its signs everywhere: where V(u) > 0 and V(1 − u) < 0 are demanded at once none has them,
and a claim of functions that don't exist is none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import TYPE_CHECKING

from canon.decide.derivative import rebuild
from canon.decide.region import Requirement
from canon.decide.tape import Node, Tape

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

MOST = 64
"""Choices of signs that are tried."""

Signs = tuple[int, ...]


def bare_call(tape: Tape, node: Node) -> Node | None:
    """The value of an arbitrary function, or of a derivative, of which the node is a multiple by a number."""
    op = tape.ops[node]
    if op[0] == "+" and not op[1] and len(op[2]) == 1:
        node = op[2][0][0]
    return node if tape.ops[node][0] == "u" else None


def some_function_has(
    tape: Tape, demanded: Sequence[Requirement], also: Sequence[Requirement], shown: Callable[[Requirement], bool]
) -> bool:
    """Whether the functions whose values are `demanded` can have them, and what is asked of them `also`.

    **Arguments:** `shown`, of a condition without these functions, whether it holds.
    """
    bare = [bare_call(tape, r.nodes[0]) for r in demanded if r.kind in ("positive", "nonzero")]
    arity = {tape.ops[call][1]: len(tape.ops[call][3]) for call in bare if call is not None}
    asked = [r for r in (*demanded, *also) if tape.functions_of(r.nodes) & {*arity}]
    return not asked or any(
        all(shown(Requirement(r.kind, tuple(_put(tape, n, signs) for n in r.nodes), r.said)) for r in asked)
        for signs in _choices(arity)
    )


def _choices(arity: Mapping[str, int]) -> Iterator[dict[str, Signs]]:
    """For each function its own sign, and those of its slopes."""
    ways = product(*(product((1, -1), repeat=n + 1) for n in arity.values()))
    for k, chosen in enumerate(ways):
        if k < MOST:
            yield dict(zip(arity, chosen, strict=True))


def _put(tape: Tape, node: Node, signs: Mapping[str, Signs]) -> Node:
    """The node with ±exp(±a₁ ± …) for the functions named."""
    values: dict[Node, Node] = {}
    for i in tape.reach([node]):
        op = tape.ops[i]
        if op[0] == "u" and op[1] in signs:
            first, *slopes = signs[op[1]]
            for slope, order in zip(slopes, op[2], strict=True):
                first *= slope**order
            power = tape.add([(values[a], slope) for a, slope in zip(op[3], slopes, strict=True)])
            values[i] = tape.scaled(tape.call("exp", power), first)
        else:
            values[i] = rebuild(tape, i, values)
    return values[node]
