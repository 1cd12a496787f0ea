"""What is seen at points of the domain for some values of the parameters: does it hold for all of them?

Values at points of q > 0 speak of functions in which no parameter stands. Of q > d they don't: what isn't 0 somewhere
in it for d = −1 may be 0 all over it for d = 10⁹. So no formula that bounds the domain may tie a coordinate to a
parameter, or to a function that is declared; unless the functions are analytic on a connected part of complex space,
as quotients of entire functions are: then what isn't 0 at a point is 0 on no open set, in whichever domain.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from canon.checker.defined import assumed
from canon.checker.points import domain_of
from canon.checker.shapes import ENTIRE, SMOOTH, is_rational
from canon.checker.statement import Statement

EVERYWHERE = (*SMOOTH, "abs", "sign")
"""Functions with values at all real numbers."""


def speak_of_all_parameters(s: Statement, functions: Sequence[int], moving: Collection[str]) -> bool:
    """Whether values of functions without parameters at some points of the domain speak of it for all parameters."""
    inside = (s.f.ops[b] for b in s.f.reach(*functions))
    if all(op[0] != "f" or op[1] in ENTIRE for op in inside):
        return True
    return not any(_is_tied(s, a, moving) for a in _bounds(s))


def _bounds(s: Statement) -> list[int]:
    """What says where the domain is: conditions, assumptions, and what is divided by or has no value everywhere.

    Of rational formulas that mustn't be 0 nothing is asked: they are nearly nowhere, whatever the parameters are.
    """
    f, found = s.f, [a for a, kind in (*s.conditions, *assumed(s)) if kind != "nonzero" or not is_rational(s, a)]
    for b in f.reach(*domain_of(s)):
        op = f.ops[b]
        if op[0] == "^" and op[2] < 0 and not is_rational(s, op[1]):
            found.append(op[1])
        elif op[0] == "f" and op[1] not in (*EVERYWHERE, *f.functions):
            found += f.parts(b)
    return found


def _is_tied(s: Statement, a: int, moving: Collection[str]) -> bool:
    """Whether a coordinate stands in a formula beside a parameter, or a function that is declared."""
    ops = [s.f.ops[b] for b in s.f.reach(a)]
    names = {op[1] for op in ops if op[0] == "s"} - {"pi"}
    called = any(op[0] == "f" and op[1] in s.f.functions for op in ops)
    return not names.isdisjoint(moving) and (called or not names <= {*moving})
