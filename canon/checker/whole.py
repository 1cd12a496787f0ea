"""Whole numbers, and inequalities with >=: between whole numbers their edge is in the domain, as no value is near it.

Elsewhere they say as much as >, if their sides are equal on no part of the domain; that is seen or taken on trust.
"""

from __future__ import annotations

from collections.abc import Set as AbstractSet
from math import lcm

from canon.checker.formulas import ONE, Formulas
from canon.checker.functions import Unreadable

MOST = 100
"""The largest exponent of what has a denominator."""


def at_least_zero(f: Formulas, a: int, whole: AbstractSet[str]) -> int:
    """What is positive where a isn't negative: of whole numbers alone, with values in ℤ/d, that is 2 d a + 1.

    Else it is a, if its zeros have no inner point whatever the whole numbers are: by one slope that is a number.
    Raises Unreadable where neither is seen.
    """
    names = {f.ops[b][1] for b in f.reach(a) if f.ops[b][0] == "s"}
    if not names & whole:
        return a
    if names <= whole and (d := _denominator(f, a)):
        return f.add(f.mul(f.number(2 * d), a), ONE)
    if any(f.value(f.slope(a, name)) for name in sorted(names - whole - {"pi", "1j"})):
        return a
    raise Unreadable("an inequality of whole numbers whose sides may be equal all over a part of the domain")


CONTINUOUS = {
    "identity", "bracket", "jacobi", "conserved", "involution", "casimir", "infinitesimal", "equations_of_motion",
    "invariant_interval", "matrix_group", "field_equations", "solves", "noether",
}  # fmt: skip
"""Kinds of claims that say no more than that something vanishes: in a limit, too, whatever a map does there."""
MOST_SLOPES = 4


def is_thin(f: Formulas, a: int, moving: AbstractSet[str], kind: str) -> bool:
    """Whether a is 0 on no part of what these names say, whatever all others are: by a slope of slopes, a number.

    Of the kinds in CONTINUOUS it is enough if one fixed name has a number for its slope: a is positive near by.
    """
    names = {f.ops[b][1] for b in f.reach(a) if f.ops[b][0] == "s"} - {"pi", "1j"}
    if kind in CONTINUOUS and any(f.value(f.slope(a, name)) for name in names - moving):
        return True
    for name in names & moving:
        slope = a
        for _ in range(MOST_SLOPES):
            slope = f.slope(slope, name)
            if f.value(slope):
                return True
    return False


def is_whole(f: Formulas, a: int) -> bool:
    """Whether a formula is seen to be a whole number: a polynomial of whole numbers, with whole coefficients."""
    whole = {name for name, words in f.words.items() if "integer" in words}
    return {f.ops[b][1] for b in f.reach(a) if f.ops[b][0] == "s"} <= whole and _denominator(f, a) == 1


def _denominator(f: Formulas, a: int) -> int:
    """A number d for which d a is whole for all whole numbers in it; 0 for what isn't seen to be a polynomial."""
    seen = dict[int, int]()
    for b in f.reach(a):
        op = f.ops[b]
        parts = [seen[c] for c in f.parts(b)]
        if op[0] in "ns":
            seen[b] = op[1].denominator if op[0] == "n" else 1
        elif op[0] == "+":
            seen[b] = lcm(*parts)
        elif op[0] == "*":
            seen[b] = parts[0] * parts[1]
        elif op[0] == "^" and op[2] > 0 and (parts[0] == 1 or op[2] <= MOST):
            seen[b] = parts[0] ** op[2]
        else:
            seen[b] = parts[0] if op[:2] in (("f", "abs"), ("f", "sign")) else 0
    return seen[a]
