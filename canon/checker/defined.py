"""Has a formula a value all along a range? What is only seen to have one somewhere says nothing of the rest.

A theorem about a range, an orbit or the neighbourhood of a place speaks of all of it. What stands in a text and in no
formula (the logarithm in 0 · log q, a bracket's arguments) bounds the domain as the rest does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.shapes import SMOOTH, has_complex, is_rational, is_smooth
from canon.checker.statement import Statement

ALWAYS = (*SMOOTH, "abs", "sign", "atan2")
"""Functions that have a value at every real argument, but for single ones."""
CIRCULAR = ("tan", "cot", "sec", "csc", "coth")


def unseen(s: Statement) -> list[int]:
    """What stands in the claim's texts and is in no formula, in the coordinates."""
    return [s.pull(a) for a in dict.fromkeys(s.f.unseen)]


def is_unbound(s: Statement, names: Iterable[str]) -> bool:
    """Whether what isn't seen in a claim's formulas bounds none of these names, whatever values they take."""
    hidden, own = unseen(s), [*names]
    return all(is_smooth(s, a, name) for a in hidden for name in own)


def has_values(s: Statement, x: str, formulas: Iterable[int]) -> bool:
    """Whether formulas have real values at all of a name's that the conditions allow, but for single places."""
    f, beside = s.f, has_complex(s)
    for a in f.reach(*formulas):
        op = f.ops[a]
        if op[0] in "ns+*" or (op[0] == "^" and op[2] > 0) or not _moves(s, a, x):
            continue
        if op[0] == "^":
            if not (_is_generic(s, op[1]) or is_nowhere_zero(s, op[1])):
                return False
        elif op[1] in ALWAYS or op[1] in f.functions or (beside and op[1] in ("power", "log")):
            continue
        elif op[1] in CIRCULAR:
            if not _is_generic(s, op[3][0]):
                return False
        elif not all(is_positive(s, b, strict=False, real=True) for b in _walls(s, op)):
            return False
    return True


def is_there(s: Statement, x: str, ends: Sequence[int | str], formulas: Sequence[int]) -> bool:
    """Whether formulas, and what isn't seen of their texts, have values all over a range, but at single places."""
    f, t, kept = s.f, s.f.node("s", x), s.conditions
    low, high = ends
    if isinstance(low, int) and isinstance(high, int):
        if is_positive(s, f.sub(low, high), strict=True, real=True):
            low, high = high, low
        elif not is_positive(s, f.sub(high, low), strict=True, real=True):
            low = high = ""  # nothing is known of their order
    walls = [f.sub(t, low)] if isinstance(low, int) and high != "-infinity" else []
    walls += [f.sub(high, t)] if isinstance(high, int) and low != "infinity" else []
    try:
        s.conditions = [*kept, *((wall, "positive") for wall in walls)]
        return has_values(s, x, [*formulas, *(a for a in unseen(s) if _moves(s, a, x))])
    finally:
        s.conditions = kept


def _walls(s: Statement, op: tuple[str, str, tuple[int, ...], tuple[int, ...]]) -> Iterator[int]:
    """What mustn't be negative for a function to have a value; -1 where that isn't known."""
    f, x, one = s.f, op[3][0], s.f.number(1)
    if op[1] in ("power", "log"):
        yield x
    elif op[1] in ("asin", "acos", "atanh"):
        yield f.sub(one, f.mul(x, x))
    elif op[1] == "acosh":
        yield f.sub(x, one)
    elif op[1] in ("elliptic_k", "elliptic_e", "elliptic_f") or (op[1] == "elliptic_pi" and len(op[3]) == 2):
        yield f.sub(one, op[3][-1])
        yield f.sub(one, x) if op[1] == "elliptic_pi" else one
    elif op[1].startswith("jacobi_"):
        yield f.sub(one, op[3][1])
        yield op[3][1]
    else:
        yield f.number(-1)


def _moves(s: Statement, a: int, x: str) -> bool:
    return any(s.f.ops[b] == ("s", x) for b in s.f.reach(a))


def _is_generic(s: Statement, a: int) -> bool:
    """Whether a formula is 0 at single places only, if anywhere it isn't: |a| + a may be 0 on a half of the line."""
    ops = [s.f.ops[b] for b in s.f.reach(a)]
    analytic = all(op[0] != "f" or op[1] in SMOOTH for op in ops) and all(op[0] != "^" or op[2] > 0 for op in ops)
    return analytic or is_rational(s, a)
