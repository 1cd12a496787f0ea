"""Independence for all values of the parameters, by scaling: units in which each parameter is 1, −1 or 0.

Where λ^w(n) n for each name n, coordinates and parameters, multiplies every formula of the domain by a power of λ > 0,
it takes the domain for some values of the parameters to the domain for others, and functions to multiples of
themselves. Weights w solve linear equations: the terms of a sum have the same one. If those of the parameters are
independent, there are scalings that take every value to 1, −1 or 0, by its sign. So it is enough that the functions are
independent at these: values at points that lie in the domain, or on the surface, have a determinant that isn't 0.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

from canon.checker.intervals import Intervals, Open
from canon.checker.linear import kernel, rank
from canon.checker.points import domain_of
from canon.checker.statement import Statement
from canon.checker.witness import lies_inside, point_of

Form = dict[str, Fraction]
DIGITS, TRIED, STEPS, MOST = 60, 60, 24, 27
"""Digits; points that are tried for each that is needed; steps towards a surface; values of the parameters."""
FAR, NEAR = (1, -1, 4, -4, 20, -20), 40
"""How far from a point a surface is looked for, and in how many digits."""
STANDS = {
    "positive": (1,), "negative": (-1,), "nonnegative": (1, 0), "nonpositive": (-1, 0), "nonzero": (1, -1),
    "any": (1, 0, -1),
}  # fmt: skip
"""What a parameter is in its unit, by what is said of it."""


def are_independent_by_scaling(s: Statement, functions: Sequence[int], moving: Sequence[str]) -> bool:
    """Whether functions of the `moving` coordinates are seen to be independent, whatever the parameters are."""
    f = s.f
    everything = [*functions, *_written(s), *s.surface]
    names = sorted({f.ops[b][1] for b in f.reach(*everything) if f.ops[b][0] == "s"} - {"pi"})
    parameters = [n for n in names if n not in moving]
    values = [(1,) if n[0] == "#" else STANDS.get(_word(s, n), ()) for n in parameters]  # marks are in no formula
    if s.f.is_complex or len(s.surface) > 1 or not all(values):
        return False
    equations = _equations(s, everything)
    if equations is None:
        return False
    rows = [[form.get(n, Fraction(0)) for n in names] for form in equations] or [[Fraction(0)] * len(names)]
    weights = [[w[names.index(n)] for n in parameters] for w in kernel(rows)]
    if parameters and (not weights or rank(weights) < len(parameters)):
        return False
    cases = list(product(*values))
    return len(cases) <= MOST and all(
        _are_at(s, functions, {n: Fraction(x) for n, x in zip(parameters, case, strict=True)}, moving) for case in cases
    )


def _word(s: Statement, name: str) -> str:
    """What is said of a name's sign; "any" where nothing is, and "" where it is something else."""
    words = {*s.words.get(name, ())} - {"real"}
    return (min(words) if len(words) == 1 else "") if words else "any"


def _written(s: Statement) -> list[int]:
    return [*domain_of(s), *(s.pull(a) for a in s.images.values()), *(a for a, _ in s.conditions)]


def _equations(s: Statement, targets: Sequence[int]) -> list[Form] | None:
    """What must be 0 for all sums to have terms of one weight; None where a formula has none."""
    f, weights, found = s.f, dict[int, Form](), list[Form]()
    for a in f.reach(*targets):
        op, parts = f.ops[a], [weights[b] for b in f.parts(a)]
        if op[0] in "ns":
            weights[a] = {op[1]: Fraction(1)} if op[0] == "s" and op[1] != "pi" else {}
        elif op[0] == "+":
            weights[a] = parts[0]
            found.append(_sum(parts[0], parts[1], Fraction(-1)))
        elif op[0] == "*":
            weights[a] = _sum(parts[0], parts[1], Fraction(1))
        elif op[0] == "^" or (op[1] == "power" and f.value(op[3][1]) is not None):
            exponent = Fraction(op[2]) if op[0] == "^" else f.value(op[3][1]) or Fraction(0)
            weights[a] = {n: exponent * c for n, c in parts[0].items()}
        elif op[1] == "abs":
            weights[a] = parts[0]
        elif op[1] in f.functions:
            return None
        else:
            weights[a] = {}
            found += parts
    return found


def _sum(x: Form, y: Form, c: Fraction) -> Form:
    return {n: x.get(n, Fraction(0)) + c * y.get(n, Fraction(0)) for n in {*x, *y}}


def _are_at(s: Statement, functions: Sequence[int], given: Mapping[str, Fraction], moving: Sequence[str]) -> bool:
    """Whether the functions are independent for these values of the parameters."""
    own, rows = Intervals(DIGITS), list[Any]()
    for of in _places(s, own, given, moving, TRIED * len(functions)):
        try:
            found = own.values(s.f, [*functions, *_written(s)], of)
        except Open:
            continue
        if lies_inside(s, own, of, found):
            rows.append([found[a] for a in functions])
        if len(rows) == len(functions):
            return own.is_regular(rows)
    return False


def _places(
    s: Statement, own: Intervals, given: Mapping[str, Fraction], moving: Sequence[str], count: int
) -> Iterator[dict[str, Any]]:
    """Points in intervals, which hold one of the surface."""
    rng = random.Random(5)
    for k in range(count):
        exact = {n: Fraction(rng.randint(-99, 99), 10 + 30 * (k % 3)) for n in moving} | {**given}
        try:
            if s.surface:
                name = rng.choice(sorted(moving))
                exact[name] = _root(s, own, exact, name)
            yield point_of(s, own, {n: (x, Fraction(0)) for n, x in exact.items()}, {})
        except Open:
            continue


def _root(s: Statement, own: Intervals, exact: Mapping[str, Fraction], name: str) -> Fraction:
    """A place at which the surface's equation changes its sign, nearly. Raises Open."""
    (e,) = s.surface

    def value(x: Fraction) -> Any:
        found = own.values(s.f, [e], {n: own.number(y) for n, y in {**exact, name: x}.items()})[e]
        return own.mp.mpf(found.mid)

    low, first = exact[name], value(exact[name])
    high = next((x for x in (low + d for d in FAR) if value(x) * first < 0), None)
    if high is None:
        raise Open
    ends, at = [(low, first), (high, value(high))], Fraction(0)
    for _ in range(STEPS):  # false position; what stays twice counts for half (Illinois)
        (a, u), (b, v) = ends
        share = Fraction(int(own.mp.nint(u / (u - v) * 10**NEAR)), 10**NEAR)
        at = (a + share * (b - a)).limit_denominator(10**NEAR)
        w = value(at)
        if not w:
            break
        ends = [(b, v), (at, w)] if w * v < 0 else [(a, u / 2), (at, w)]
    return at
