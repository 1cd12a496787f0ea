"""What a formula tends to where a name tends to something: its expansion; or 0, as what falls exponentially does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

from canon.checker.defined import assumed, shared, unseen
from canon.checker.expansions import EXPONENTIAL, Expansion, NoSeries, Series
from canon.checker.followed import FAILURES
from canon.checker.formulas import ZERO
from canon.checker.positive import is_positive
from canon.checker.shapes import SMOOTH, has_complex
from canon.checker.statement import Statement

ORDERS, ROOTS = (6, 14), (1, 2)
"""So many coefficients are tried; y, or its square, is the distance."""


def towards(s: Statement, inside: int, x: str, to: Any, side: int) -> Series | None:
    """The expansion of a formula where a name tends to a formula, or an infinity, from one side; None where none is
    seen. It is known up to the constant, or has a pole."""
    if has_complex(s):
        return None
    for expansion in _expansions(s, inside, x, to, side):
        try:
            found = expansion.of(inside)
            first = expansion.stripped(found) if found.low < 0 else found
        except (NoSeries, *FAILURES):
            continue
        if first.end > 0 or first.low < 0:
            return first
    return None


def is_near(s: Statement, x: str, to: int | str, sides: Sequence[int]) -> bool:
    """Whether the domain is seen to reach there, from each side, and what isn't seen of the texts to have values."""
    f, t = s.f, s.f.node("s", x)
    signs = {"positive": 1, "nonnegative": 1, "negative": -1}
    walls = [f.mul(f.number(signs[word]), t) for word in s.words.get(x, ()) if word in signs]
    walls += [a for a, kind in s.conditions if kind == "positive" and _moves(s, a, x)]
    others = [a for a, kind in s.conditions if kind == "nonzero" and _moves(s, a, x)]
    others += [a for a in unseen(s) if _moves(s, a, x)]
    given = [(a, word) for a, word in assumed(s) if _moves(s, a, x)]
    walls += [a for a, word in given if word != "nonzero"]
    others += [a for a, word in given if word == "nonzero"]
    if not _have_values(s, shared(s), x, to, sides):
        return False
    for side in sides:
        for a in walls:
            series = _first_term(s, a, x, to, side)
            if series is None or not is_positive(s, series, strict=True, real=True):
                return False
        if any(_first_term(s, a, x, to, side) is None for a in others):
            return False
    return not any(_moves(s, a, x) for a in s.surface)


def _have_values(s: Statement, formulas: Sequence[int], x: str, to: int | str, sides: Sequence[int]) -> bool:
    """Whether formulas are seen to have values near there: what may lack one in them, radicands and divisors, does."""
    for a in s.f.reach(*formulas):
        op = s.f.ops[a]
        if not _moves(s, a, x) or op[0] in "ns+*" or (op[0] == "^" and op[2] > 0):
            continue
        if op[0] == "f" and (op[1] in (*SMOOTH, *s.f.functions, "abs", "sign")):
            continue
        if any(_first_term(s, a, x, to, side) is None for side in sides):
            return False
    return True


def _first_term(s: Statement, inside: int, x: str, to: Any, side: int) -> int | None:
    """The first coefficient of a formula's expansion there, which tells its sign near; None where none is seen."""
    for expansion in _expansions(s, inside, x, to, side):
        try:
            return expansion.stripped(expansion.of(inside)).terms[0]
        except (NoSeries, *FAILURES):
            continue
    return None


def _moves(s: Statement, a: int, x: str) -> bool:
    return any(s.f.ops[b] == ("s", x) for b in s.f.reach(a))


def _expansions(s: Statement, inside: int, x: str, to: Any, side: int) -> Iterator[Expansion]:
    f = s.f
    for root, order in product(ROOTS, ORDERS):
        if isinstance(to, int):
            at = Series(0, (to, *[ZERO] * (root - 1), f.number(side)))
        else:
            at = Series(-root, (f.number(1 if to == "infinity" else -1),))
        yield Expansion(s, x, at, order)
    inner = [op[3][0] for op in (f.ops[a] for a in f.reach(inside)) if op[0] == "f" and op[1] in EXPONENTIAL]
    for a in inner if not isinstance(to, int) else ():
        slope = f.slope(a, x)
        for sign in (1, -1):
            pace = f.mul(f.number(sign), slope)
            if is_positive(s, f.mul(f.number(1 if to == "infinity" else -1), pace), strict=True, real=True):
                yield Expansion(s, x, None, ORDERS[0], pace)


def fades(s: Statement, target: int, x: str) -> bool:
    """Whether a formula tends to 0 at infinity: a sum of exponentials that fall, times what is bounded."""
    return _tendencies(s, target, x)[0]


def is_bounded(s: Statement, target: int, x: str) -> bool:
    """Whether a formula is seen to be bounded for all large values of a name."""
    return _tendencies(s, target, x)[1]


def _tendencies(s: Statement, target: int, x: str) -> tuple[bool, bool]:
    """Whether a formula is seen to tend to 0, and to be bounded."""
    f, out = s.f, dict[int, tuple[bool, bool]]()
    moving = set[int]()
    for a in f.reach(target):
        op, parts = f.ops[a], f.parts(a)
        if op != ("s", x) and not moving & {*parts}:
            out[a] = False, True
            continue
        moving.add(a)
        known = [out[b] for b in parts]
        bounded = all(is_so for _, is_so in known)
        if op[0] == "+":
            out[a] = all(falls for falls, _ in known), bounded
        elif op[0] == "*":
            falls = bounded and any(falls for falls, _ in known)
            out[a] = falls, bounded
        elif op[:2] == ("f", "exp"):
            falls = _falls(s, op[3][0], x)
            out[a] = falls, falls
        else:
            out[a] = False, op[0] == "f" and op[1] in ("sin", "cos")
    return out[target]


def _falls(s: Statement, exponent: int, x: str) -> bool:
    slope = s.f.slope(exponent, x)
    constant = all(s.f.ops[b] != ("s", x) for b in s.f.reach(slope))
    return constant and is_positive(s, s.f.mul(s.f.number(-1), slope), strict=True, real=True)
