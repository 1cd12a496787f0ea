"""What holds of a whole domain by its shape: forms that are exact there, functions that are 0 on no open part of it.

A closed form is exact on a convex domain (Poincaré's lemma). A quotient of functions that are analytic at all complex
values is 0 on an open set only if it is 0 everywhere: one value that isn't 0 speaks of each component of any domain.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from canon.checker.followed import FAILURES
from canon.checker.functions import Unreadable
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.shapes import ENTIRE, has_complex, is_rational, is_smooth
from canon.checker.statement import Statement

TRIED = 6
"""At so many points, beside 0, a formula is looked at: whole numbers, and whole right angles."""
SIDES = {"real", "positive", "negative", "nonnegative", "nonpositive"}


def _moves(s: Statement, a: int, names: set[str]) -> bool:
    return any(s.f.ops[b][0] == "s" and s.f.ops[b][1] in names for b in s.f.reach(a))


def is_convex(s: Statement, names: Sequence[str]) -> bool:
    """Whether the domain is convex in these names: an intersection of half-spaces, with other names constant."""
    f, own = s.f, {*names}
    images = {*s.q, *s.p, *s.Q, *s.P} - own  # what is said of these cuts the domain, too
    if s.surface or any(not {*s.words.get(name, ())} <= SIDES for name in names):
        return False
    if any({*s.words.get(name, ())} - {"real"} for name in images):
        return False
    for a, kind in s.conditions:
        if _moves(s, a, own) and (kind != "positive" or any(_moves(s, f.slope(a, name), own) for name in names)):
            return False
    return True


def is_exact(s: Statement, written: Sequence[int]) -> bool:
    """Whether a closed form is exact: the domain is convex, and what the form is made of is smooth all over it."""
    names = [*s.coordinates, s.time]
    if not is_convex(s, names) or has_complex(s):
        return False
    return all(is_smooth(s, a, name, anywhere=False) for a in written for name in names)


def is_nearly(s: Statement, minors: Sequence[int], names: Sequence[str]) -> bool:
    """Whether what isn't 0 at a point, one of these, is so nearly everywhere, whatever the parameters are."""
    if all(is_rational(s, a, names) for a in minors):
        return True
    return any(is_nowhere_zero(s, a) or is_somewhere(s, a, names) for a in minors)


def is_somewhere(s: Statement, a: int, names: Sequence[str] = ()) -> bool:
    """Whether a quotient of entire functions of these names, or the coordinates, isn't 0 at some point, whatever the
    parameters are."""
    f, own = s.f, {*(names or s.coordinates)}
    if s.surface or has_complex(s, a):
        return False
    moving = [b for b in f.reach(a) if _moves(s, b, own)]
    if any(f.ops[b][0] == "f" and f.ops[b][1] not in ENTIRE for b in moving):
        return False
    inside = [b for b in moving if f.ops[b][0] == "f"]  # whose arguments have poles nowhere
    if any(f.ops[c][0] == "^" and f.ops[c][2] < 0 and _moves(s, c, own) for c in f.reach(*inside)):
        return False
    under = [f.ops[b][1] for b in moving if f.ops[b][0] == "^" and f.ops[b][2] < 0]
    for unit, k in product((f.number(1), f.mul(f.number("1/2"), f.node("s", "pi"))), range(-1, TRIED)):
        places = (0 if k < 0 else (7 * i * i + 3 * i + k * (i + 2)) % 11 + 1 for i in range(1, len(own) + 1))
        at = {name: f.mul(f.number(n), unit) for name, n in zip(names or s.coordinates, places, strict=True)}
        try:
            if all(_is_apart(s, f.substitute(b, at)) for b in (*under, a)):
                return True
        except (Unreadable, *FAILURES):
            continue
    return False


def _is_apart(s: Statement, a: int) -> bool:
    opposite = s.f.mul(s.f.number(-1), a)
    return is_nowhere_zero(s, a) or any(is_positive(s, b, strict=True, real=True) for b in (a, opposite))
