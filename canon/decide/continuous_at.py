"""Whether a node is continuous at an end of a symbol's interval, for all values of the other symbols in their box.

It is if each part of it is: sums and products of what is continuous, quotients by what isn't 0 there, roots and
logarithms of what is positive there, special functions where they are regular. Its values there are analytic in the
other symbols, too: an absolute value's argument, that is, has a sign there or is 0 all along.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from canon.budget import Budget
from canon.decide.derivative import substitute
from canon.decide.intervals import Edge, Interval
from canon.decide.regular_on_box import BELOW_ONE, is_regular
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Node, Tape
from canon.errors import InputError

EVERYWHERE: Final = ("sin", "cos", "exp", "atan", "jacobi_sn", "jacobi_cn", "jacobi_dn")
"""Functions that are analytic at all real arguments."""
KINKS: Final = {"abs": (0,), "asin": (1, -1), "acos": (1, -1)}
"""Where functions are continuous without being analytic."""


def at_edge(tape: Tape, edge: Edge) -> Node:
    """The number at an edge."""
    return tape.add(((tape.constant("pi"), edge.pi),), edge.rational)


def is_continuous_at(
    tape: Tape, node: Node, x: Node, place: Node, box: Mapping[Node, Interval], budget: Budget
) -> bool:
    """Whether the node, real on a box one end of which x = `place` is, tends to its value there as x does."""
    others = {symbol: interval for symbol, interval in box.items() if symbol != x}

    def sign(inner: Node) -> str | None:
        there = substitute(tape, inner, {x: place})
        value = tape.value(there)
        if value is not None:
            return "pos" if value > 0 else "neg" if value < 0 else None
        return definite_sign(tape, there, others, budget)

    def fits(i: Node) -> bool:
        op = tape.ops[i]
        if x not in tape.support(i) or op[0] in ("s", "+"):
            return True
        if tape.is_complex(i):
            return False
        if op[0] == "*":
            return all(e > 0 or x not in tape.support(a) or sign(a) is not None for a, e in op[1])
        if op[0] == "r":
            return sign(op[1]) == "pos"
        if op[0] != "f":
            return False
        if op[1] == "log":
            return sign(op[2][0]) == "pos"
        if op[1] == "atan2":
            return sign(op[2][0]) is not None or sign(op[2][1]) == "pos"
        if op[1] in BELOW_ONE:
            parts = tape.reach([substitute(tape, i, {x: place})])
            calls = [j for j in parts if tape.ops[j][0] == "f" and tape.ops[j][1] in BELOW_ONE]
            return all(is_regular(tape, j, others, budget) for j in calls)
        if op[1] in KINKS:  # they may be at one, all along the slice, but not cross it
            inner, kinks = op[2][0], [tape.number(kink) for kink in KINKS[op[1]]]
            known = tape.value(substitute(tape, inner, {x: place}))
            return known in KINKS[op[1]] or all(sign(tape.minus(inner, kink)) is not None for kink in kinks)
        return op[1] in EVERYWHERE

    try:
        return all(fits(i) for i in tape.reach([node]))
    except (InputError, ZeroDivisionError):
        return False
