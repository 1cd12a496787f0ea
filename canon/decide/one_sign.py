"""Values of one sign: what a smooth function without a zero has wherever it is defined.

Between a value above 0 and one below a continuous function has a zero. So a place at which X(q) > 0 and X(p) < 0 is
none for an X that is declared `nonzero`, though both values are not 0; no such function goes through them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from flint import arb

from canon.decide.tape import Node, Tape

if TYPE_CHECKING:
    from canon.decide.enclosure import Ball
    from canon.decide.region import Requirement


def have_one_sign(tape: Tape, requirements: Iterable[Requirement], balls: Mapping[Node, Ball]) -> bool:
    """Whether each arbitrary function that is demanded not to vanish has one sign at all calls of which that is asked.

    Coarser than what a claim says: V(q) and V(p) of any function, where both are divided by, may differ in sign. A
    place where they do is left out, and with it a refutation, never a proof.
    """
    asked = [(tape.ops[node], node, r.kind) for r in requirements for node in _calls(tape, r)]
    without_zero = {op[1] for op, _, kind in asked if kind == "nonzero"}
    signs: dict[str, bool] = {}
    for op, node, _ in asked:
        ball = balls[node]
        if op[1] in without_zero and isinstance(ball, arb) and signs.setdefault(op[1], ball > 0) != (ball > 0):
            return False
    return True


def _calls(tape: Tape, requirement: Requirement) -> list[Node]:
    """The value of an arbitrary function of which a requirement demands that it has a sign, or isn't 0."""
    node = requirement.nodes[0]
    op = tape.ops[node]
    if op[0] == "+" and not op[1] and len(op[2]) == 1:
        node = op[2][0][0]
        op = tape.ops[node]
    bare = requirement.kind in ("nonzero", "positive") and op[0] == "u" and not any(op[2])
    return [node] if bare else []
