"""Whether a special function is finite and analytic on a whole box of intervals.

K(m), E(m), F(φ, m) and E(φ, m) are for m < 1, and the incomplete ones for m = 1 where |φ| < π/2; Π for n < 1 besides;
Γ(x) and Lambert's W(x) for x > 0 (DLMF 19.2, 5.2 and 4.13).
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Final

from canon.budget import Budget
from canon.decide.intervals import Edge, Interval, exact_affine
from canon.decide.sign_on_box import definite_sign
from canon.decide.tape import Node, Tape

BELOW_ONE: Final = {
    "elliptic_k": (0,),
    "elliptic_e": (0,),
    "elliptic_ei": (1,),
    "elliptic_f": (1,),
    "elliptic_pi": (0, 1),
    "elliptic_pii": (0, 2),
}
"""Which arguments of a function must be smaller than 1."""
QUARTER: Final = Edge(Fraction(0), Fraction(1, 2))


def is_regular(tape: Tape, call: Node, intervals: Mapping[Node, Interval], budget: Budget) -> bool:
    """True where the call is shown to be regular on the whole box, at real arguments."""
    op = tape.ops[call]
    if op[0] == "+" and not op[1] and len(op[2]) == 1:  # a multiple, as 2 K(m) for F(π, m)
        return is_regular(tape, op[2][0][0], intervals, budget)
    if op[0] != "f" or any(tape.is_complex(argument) for argument in op[2]):
        return False
    name, arguments = op[1], op[2]
    if name in ("gamma", "lambertw"):
        return _sign(tape, arguments[0], intervals, budget) == "pos"
    if name not in BELOW_ONE:
        return False
    small = [arguments[k] for k in BELOW_ONE[name]]
    if name in ("elliptic_ei", "elliptic_f") and tape.value(small[0]) == 1:
        return _within_a_quarter(tape, arguments[0], intervals)
    return all(_sign(tape, tape.minus(tape.one, argument), intervals, budget) == "pos" for argument in small)


def _sign(tape: Tape, node: Node, intervals: Mapping[Node, Interval], budget: Budget) -> str | None:
    value = tape.value(node)
    if value is not None:
        return "pos" if value > 0 else None
    return definite_sign(tape, node, intervals, budget)


def _within_a_quarter(tape: Tape, angle: Node, intervals: Mapping[Node, Interval]) -> bool:
    """Whether −π/2 < angle < π/2 on the box, for an angle that is affine in one symbol."""
    form = exact_affine(tape, angle)
    if form is None or form[2] not in intervals:
        return False
    constant, slope, symbol = form
    image = intervals[symbol].affine(slope, constant)
    if image.low is None or image.high is None:
        return False
    return image.low.compare(QUARTER.scaled(Fraction(-1))) >= 0 and image.high.compare(QUARTER) <= 0
