"""Are formulas analytic where some of their names have given values? Each operation in them is, one by one.

A series takes derivatives at a place, and there 0 · ∞ would be 0: asin(1 − ε²), which is π/2 − √2 |ε|, has the
derivative −2 ε/√(1 − (1 − ε²)²).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from canon.checker.followed import FAILURES, at_random
from canon.checker.formulas import ONE
from canon.checker.functions import Unreadable
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.ratios import multiple
from canon.checker.shapes import ENTIRE, SMOOTH, has_complex, is_algebraic
from canon.checker.statement import Statement
from canon.checker.values import Values

EDGED = ("asin", "acos", "acosh", "atanh")
"""Functions with a branch point where their argument's square is 1."""
CUT = ("power", "log", "abs", "sign")
"""Functions that aren't smooth where their first argument is 0."""


def is_regular(s: Statement, targets: Sequence[int], at: Mapping[str, int], *, own: bool) -> bool:
    """Whether formulas are seen to be analytic in these names, at these values, where they are real.

    With `own` they are the claim's own, and the domain says already that they have a value at this place.
    """
    f, values, moving = s.f, at_random(s), set[int]()
    smooth = (*(ENTIRE if has_complex(s, *targets) else SMOOTH), *f.functions)

    def apart(a: int, *, said: bool = False) -> bool:
        try:
            there = f.substitute(a, at)
        except Unreadable:  # a pole
            return False
        return _is_not_zero(s, values, there) or (said and own and _has_value(values, there))

    for b in f.reach(*targets):
        op, parts = f.ops[b], f.parts(b)
        if not moving & {*parts} and not (op[0] == "s" and op[1] in at):
            continue
        moving.add(b)
        if op[0] in "s+*" or (op[0] == "^" and op[2] > 0) or (op[0] == "f" and op[1] in smooth):
            continue
        first = parts[0]
        if not own and not _is_real(s, op, at):
            fine = False
        elif op[0] == "^" or op[1] in CUT:
            fine = apart(first, said=True)
        elif op[1] in EDGED:
            fine = apart(f.sub(ONE, f.mul(first, first)))
        elif op[1] in ("tan", "sec", "cot", "csc"):
            fine = apart(f.node("f", "cos" if op[1] in ("tan", "sec") else "sin", (), (first,)))
        elif op[1] in ("coth", "tanh"):
            fine = apart(f.node("f", "sinh" if op[1] == "coth" else "cosh", (), (first,)))
        elif op[1] == "atan2":  # off its cut
            fine = apart(first) or _is_positive(s, parts[1], at)
        elif op[1] in ("jacobi_sn", "jacobi_cn", "jacobi_dn", "jacobi_epsilon"):
            fine = parts[1] not in moving and not has_complex(s, *targets)
        elif op[1] in ("elliptic_k", "elliptic_e") and len(parts) == 1:
            fine = apart(f.sub(ONE, first))
        else:
            fine = False
        if not fine:
            return False
    return True


def _is_real(s: Statement, op: tuple[Any, ...], at: Mapping[str, int]) -> bool:
    """Whether a function is seen to be real at the place: √(q − 1) is analytic at 0, and has no value there."""
    if op[0] == "^" or op[1] not in (*EDGED, "power", "log"):
        return True
    f, x = s.f, op[3][0]
    walls = {"acosh": f.sub(x, ONE), "power": x, "log": x}
    return _is_positive(s, walls.get(op[1], f.sub(ONE, f.mul(x, x))), at)


def _is_positive(s: Statement, a: int, at: Mapping[str, int]) -> bool:
    try:
        return is_positive(s, s.f.substitute(a, at), strict=True, real=not has_complex(s))
    except Unreadable:
        return False


def _has_value(values: Values, a: int) -> bool:
    """Whether a formula isn't seen to be 0."""
    try:
        return bool(values.value(a))
    except FAILURES:
        return False


def _is_not_zero(s: Statement, values: Values, a: int) -> bool:
    """Whether a formula is seen not to be 0: a number, one of roots that has an inverse, or one with a sign."""
    try:
        value = values.value(a)
        if multiple(value, values.one, values.t.prime) or (is_algebraic(s, a) and values.t.inverse(value)):
            return True
    except FAILURES:
        pass
    return is_nowhere_zero(s, a)
