"""Has a formula a value all along a range? What is only seen to have one somewhere says nothing of the rest.

A theorem about a range, an orbit or the neighbourhood of a place speaks of all of it. What stands in a text and in no
formula (the logarithm in 0 · log q, a bracket's arguments) bounds the domain as the rest does; and so do the file's own
sections, H and the map, whether a claim uses them or not, and what is assumed of the map's other variables.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from canon.checker.functions import Unreadable
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.shapes import SMOOTH, has_complex, is_smooth
from canon.checker.statement import Statement

POLES = {"tan": "cos", "sec": "cos", "cot": "sin", "csc": "sin", "coth": "sinh"}
"""Functions with poles, and what is 0 there."""


def unseen(s: Statement) -> list[int]:
    """What stands in the claim's texts and is in no formula, in the coordinates."""
    return [s.pull(a) for a in dict.fromkeys(s.f.unseen)]


def shared(s: Statement, *, H: bool = True) -> list[int]:
    """What the file's own sections are made of, in the coordinates: H, the map, a generating function without one."""
    own = [*([s._H] if s._H is not None and H else []), *s.images.values()]
    own += [s.generating[1]] if s.direction == "implicit" else []
    return [s.pull(a) for a in dict.fromkeys(own)]


def assumed(s: Statement) -> Iterator[tuple[int, str]]:
    """What is assumed of the variables that the map gives: formulas that are positive (or 0 nowhere)."""
    for name, image in s.images.items():
        a = s.pull(image)
        for word in {*s.words.get(name, ())} & {"positive", "nonnegative", "negative", "nonzero"}:
            yield (s.f.mul(s.f.number(-1), a) if word == "negative" else a), word


def bounding(s: Statement, names: Iterable[str]) -> list[tuple[int, str]]:
    """What is assumed of the map's other variables, and isn't so for all values of these names anyway."""
    own, signs = [*names], {"negative": "positive"}  # assumed() has turned what is negative
    moving = [(a, word) for a, word in assumed(s) if any(_moves(s, a, name) for name in own)]
    return [(a, word) for a, word in moving if not _is_as_said(s, a, signs.get(word, word))]


def _is_as_said(s: Statement, a: int, word: str) -> bool:
    """Whether a formula is seen to be, everywhere, what a word says."""
    if word == "nonzero":
        return is_nowhere_zero(s, a)
    signed = s.f.mul(s.f.number(-1), a) if word == "negative" else a
    known = word in ("positive", "nonnegative", "negative")
    return known and is_positive(s, signed, strict=word != "nonnegative", real=True)


def is_unbound(s: Statement, names: Iterable[str]) -> bool:
    """Whether what isn't seen in a claim's formulas bounds none of these names, whatever values they take."""
    hidden, own = unseen(s), [*names]
    return all(is_smooth(s, a, name) for a in hidden for name in own)


def is_everywhere(s: Statement, names: Iterable[str]) -> bool:
    """Whether the file's sections, but for H, bound none of these names."""
    own = [*names]
    return is_unbound(s, own) and all(has_values(s, x, shared(s, H=False)) for x in own) and not bounding(s, own)


def has_values(s: Statement, x: str, formulas: Iterable[int]) -> bool:
    """Whether formulas are real and smooth at all values of a name that the conditions allow: 1/q isn't, at 0."""
    f = s.f
    for a in f.reach(*formulas):
        op = f.ops[a]
        if op[0] in "ns+*" or (op[0] == "^" and op[2] > 0) or not _moves(s, a, x):
            continue
        first = op[1] if op[0] == "^" else op[3][0]
        if op[0] == "^" or op[1] in ("abs", "sign"):
            sure = is_nowhere_zero(s, first)
        elif op[1] in SMOOTH or op[1] in f.functions or (op[1] in ("power", "log") and has_complex(s, first)):
            sure = True
        elif op[1] in POLES:
            sure = is_nowhere_zero(s, f.node("f", POLES[op[1]], (), (first,)))
        elif op[1] == "atan2":
            sure = is_nowhere_zero(s, first) or is_positive(s, op[3][1], strict=True, real=True)
        else:
            sure = all(is_positive(s, b, strict=True, real=True) for b in _walls(s, op))
        if not sure:
            return False
    return True


def is_there(s: Statement, x: str, ends: Sequence[int | str], formulas: Sequence[int]) -> bool:
    """Whether formulas, and what isn't seen of their texts, have values all over a range."""
    f, t, kept, words = s.f, s.f.node("s", x), s.conditions, s.words
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
        s.words = {**words, x: ["real"]}
        if not all(_is_as_said(s, t, word) for word in {*words.get(x, ())} - {"real"}):
            return False
        s.words = words
        own = [*formulas, *(a for a in (*unseen(s), *shared(s)) if _moves(s, a, x))]
        return has_values(s, x, own) and not bounding(s, [x])
    finally:
        s.conditions, s.words = kept, words


def is_upward(s: Statement, ends: Sequence[int | str]) -> bool:
    """Whether a range is seen to run upwards. Raises Unreadable for one that begins at its upper infinity."""
    low, high = ends
    if low == "infinity" or high == "-infinity":
        raise Unreadable("a range runs upwards")
    if not (isinstance(low, int) and isinstance(high, int)):
        return True
    return is_positive(s, s.f.sub(high, low), strict=False, real=True)


def keeps_inside(s: Statement, along: Mapping[str, int], ends: Sequence[int | str], also: Sequence[int] = ()) -> bool:
    """Whether a path, between its ends, is seen to stay where the file's own sections have values, and formulas `also`
    have some."""
    f, t, kept = s.f, s.f.node("s", s.time), s.conditions
    low, high = ends
    walls = [f.sub(t, low)] if isinstance(low, int) else []
    walls += [f.sub(high, t)] if isinstance(high, int) else []
    try:
        s.conditions = [*kept, *((wall, "positive") for wall in walls)]
        there = has_values(s, s.time, [*(f.substitute(a, along) for a in shared(s)), *also])
    finally:
        s.conditions = kept
    return is_upward(s, ends) and there and not bounding(s, [*along, s.time])


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
