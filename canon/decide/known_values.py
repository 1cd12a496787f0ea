"""What functions are at arguments that are known: at 0 and 1, and incomplete elliptic integrals at quarter turns."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from canon.decide.tape import Node, Tape

AT_0: Final = {"sin": 0, "asin": 0, "atan": 0, "cos": 1, "exp": 1}
AT_1: Final = {"log": 0}
ANGLES: Final = {"elliptic_f": 0, "elliptic_ei": 0, "elliptic_pii": 1}
"""Which argument of an incomplete elliptic integral is its angle."""
COMPLETE: Final = {"elliptic_f": "elliptic_k", "elliptic_ei": "elliptic_e"}
"""What an incomplete elliptic integral is at π/2; at n π/2 it is n times as much."""


def at_known_arguments(tape: Tape, name: str, arguments: tuple[Node, ...]) -> Node | None:
    """The value of a function as a node of its own, where it is known; else None."""
    value = tape.value(arguments[0])
    if value is not None and len(arguments) == 1:
        table = AT_0 if value == 0 else AT_1 if value == 1 else {}
        if name in table:
            return tape.number(table[name])
        if name == "abs":
            return tape.number(abs(value))
    if name in ANGLES and tape.value(arguments[ANGLES[name]]) == 0:
        return tape.zero
    if name in COMPLETE and (quarters := _quarter_turns(tape, arguments[0])) is not None:
        return tape.scaled(tape.make(("f", COMPLETE[name], arguments[1:])), quarters)
    return None


def _quarter_turns(tape: Tape, node: Node) -> Fraction | None:
    """n of n π/2, for a whole number n other than 0."""
    op, pi = tape.ops[node], tape.constant("pi")
    turns = Fraction(1) if node == pi else op[2][0][1] if op[0] == "+" and not op[1] and op[2][0][0] == pi else None
    whole = turns is not None and (op[0] != "+" or len(op[2]) == 1) and (2 * turns).denominator == 1
    return 2 * turns if whole and turns is not None else None
