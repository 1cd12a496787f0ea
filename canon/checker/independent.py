"""Are functions linearly independent over the reals, whatever the parameters are?

- Without parameters, in a domain whose points are the same for all of them: their values at points near one of it have
  a determinant that isn't 0, in intervals.
- The combinations that vanish are an ideal of the algebra which the brackets make. A simple one has none but itself: so
  one function that isn't 0 is enough. Of three, eight or ten dimensions, or six with the signature of so(3,1), it is
  simple where Killing's form is regular (Cartan).
- At points with many zeros the values are formulas of the parameters, and elimination finds pivots that are 0 nowhere.
  Where these don't suffice, what may vanish is 0 along those that are numbers: a space in which there must be no ideal.
- In units in which all parameters are 1, −1 or 0 there are none (`homogeneous`).
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain, combinations, product
from typing import Any

from canon.checker.at_zero import evaluated
from canon.checker.everywhere import is_somewhere
from canon.checker.followed import FAILURES, at_random, is_identity
from canon.checker.functions import Unreadable
from canon.checker.homogeneous import are_independent_by_scaling
from canon.checker.intervals import Intervals, Open
from canon.checker.lie import Algebra
from canon.checker.linear import Rows, kernel, unit
from canon.checker.points import domain_of
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.ratios import multiple
from canon.checker.same_points import speak_of_all_parameters
from canon.checker.statement import Statement
from canon.checker.values import Values
from canon.checker.witness import lies_inside

SEVERAL = 12


def are_independent(
    s: Statement, functions: Sequence[int], places: Iterable[Mapping[str, Any]], algebra: Algebra | None, simple: bool
) -> bool:
    """Whether it is seen. `places` are points of the domain, `algebra` the structure constants, if they are numbers."""
    f, moving = s.f, {*s.coordinates, *s.bracketed}
    if not functions:
        return True
    if simple and any(is_somewhere(s, a) for a in functions):
        return True
    if s.surface or s.f.is_complex:
        return are_independent_by_scaling(s, functions, sorted(moving))
    names = {f.ops[b][1] for b in f.reach(*functions) if f.ops[b][0] == "s"} - moving - {"pi"}
    called = any(f.ops[b][0] == "f" and f.ops[b][1] in f.functions for b in f.reach(*functions))
    if not names and not called and speak_of_all_parameters(s, functions, moving):
        return any(_regular_near(s, functions, of, moving) for of in places)
    if called:
        return False
    if simple and any(_is_somewhere(s, a, sorted(moving)) for a in functions):
        return True
    if _by_pivots(s, functions, sorted(moving), algebra):
        return True
    return are_independent_by_scaling(s, functions, sorted(moving))


def _regular_near(s: Statement, functions: Sequence[int], of: Mapping[str, Any], moving: set[str]) -> bool:
    own, rng, rows = Intervals(100), random.Random(3), list[Any]()
    written = [*domain_of(s), *(s.pull(image) for image in s.images.values()), *(a for a, _ in s.conditions)]
    for _ in range(6 * len(functions)):
        near: dict[str, Any] = {}
        for n, x in of.items():
            near[n] = x if isinstance(x, str) else Fraction(str(own.mp.nstr(x, 20)))
        for name in sorted(moving & near.keys()):
            near[name] = near[name] * (1 + Fraction(rng.randint(-99, 99), 600)) + Fraction(rng.randint(-99, 99), 900)
        point = {n: x if isinstance(x, str) else own.number(x) for n, x in near.items()}
        try:
            found = own.values(s.f, [*functions, *written], point)
            if lies_inside(s, own, point, found):
                rows.append([found[a] for a in functions])
        except Open:
            continue
        if len(rows) == len(functions):
            return own.is_regular(rows)
    return False


def _by_pivots(s: Statement, functions: Sequence[int], moving: Sequence[str], algebra: Algebra | None) -> bool:
    """Whether no combination vanishes at all points that are tried, or those that may are no ideal."""
    values, n = at_random(s), len(functions)
    kept: dict[int, list[int]] = {}  # by the columns of their pivots, each with 0 in the columns of the others
    for row in _rows(s, functions, moving):
        try:
            for column, other in kept.items():
                row = _without(s, row, other, column)
            row = [s.f.number(0) if is_identity(values, x) else x for x in row]
            pivot = next((k for k, x in enumerate(row) if x and k not in kept and is_nowhere_zero(s, x)), None)
            if pivot is None:
                continue
            kept = {k: _without(s, other, row, pivot) for k, other in kept.items()} | {pivot: row}
        except (Unreadable, *FAILURES):
            continue
        if len(kept) == n:
            return True
    found = [x for pivot, row in kept.items() if (x := _numbers(values, row, pivot)) is not None]
    return algebra is not None and bool(found) and not largest_ideal(algebra, kernel(found))


def _numbers(values: Values, row: Sequence[int], pivot: int) -> list[Fraction] | None:
    """A row over its pivot, where that is one of rational numbers."""
    below = values.value(row[pivot])
    found = [Fraction(0) if not x else multiple(values.value(x), below, values.t.prime) for x in row]
    return None if any(x is None for x in found) else [x or Fraction(0) for x in found]


def _without(s: Statement, row: list[int], other: Sequence[int], column: int) -> list[int]:
    """A row less a multiple of another one: 0 in this column."""
    f = s.f
    if not row[column]:
        return row
    factor = f.over(row[column], other[column])
    less = [f.sub(x, f.mul(factor, y)) if y else x for x, y in zip(row, other, strict=True)]
    return [f.number(0) if k == column else x for k, x in enumerate(less)]


def largest_ideal(algebra: Algebra, space: Rows) -> Rows:
    """A basis of the largest ideal within a space: of its vectors those with brackets in it, and so on."""
    while space:
        within = _with_brackets_in(algebra, space)
        if len(within) == len(space):
            return space
        space = within
    return space


def _with_brackets_in(algebra: Algebra, space: Rows) -> Rows:
    normals = kernel(space)  # what is 0 on the space
    if not normals:
        return space
    conditions = [
        [sum((u * v for u, v in zip(normal, algebra.bracket(w, e), strict=True)), Fraction(0)) for w in space]
        for e in unit(algebra.size)
        for normal in normals
    ]
    return [
        [sum((c * w[k] for c, w in zip(chosen, space, strict=True)), Fraction(0)) for k in range(algebra.size)]
        for chosen in kernel(conditions)
    ]


def _is_somewhere(s: Statement, a: int, moving: Sequence[str]) -> bool:
    """Whether a function isn't 0 everywhere, for any values of the parameters: its values at two points can't be 0."""
    found = [row[0] for row in _rows(s, [a], moving)]
    differences = (s.f.sub(x, y) for x, y in combinations(found[:SEVERAL], 2))
    return any(is_nowhere_zero(s, x) for x in chain(found, differences))


def _rows(s: Statement, functions: Sequence[int], moving: Sequence[str]) -> Iterator[list[int]]:
    """The functions' values, as formulas of the parameters, at points of the domain."""
    for point in _sparse(s, moving):
        try:
            if _is_inside(s, point):
                yield [evaluated(s, s.f.substitute(a, point)) for a in functions]
        except (Unreadable, *FAILURES):
            continue


def _sparse(s: Statement, moving: Sequence[str]) -> Iterator[dict[str, int]]:
    """Points with one coordinate, or two, that aren't 0; and at last some others."""
    f, one = s.f, s.f.number(1)
    zero = dict.fromkeys(moving, f.number(0))
    yield zero
    for n in (1, 2):
        for a in moving:
            yield {**zero, a: f.number(n)}
    for (i, a), (j, b), n in product(enumerate(moving), enumerate(moving), (1, -1, 2)):
        if i < j:
            yield {**zero, a: one, b: f.number(n)}


def _is_inside(s: Statement, point: Mapping[str, int]) -> bool:
    """Whether a point is one of the domain for all values of the parameters. Raises Unreadable at a pole."""
    f = s.f
    for a in domain_of(s):
        for b in f.reach(f.substitute(a, point)):
            op: tuple[Any, ...] = f.ops[b]
            if op[0] == "f" and op[1] in ("power", "log") and not is_positive(s, op[3][0], strict=True, real=True):
                return False
            if op[0] == "f" and op[1] not in ("power", "log", "sin", "cos", "exp"):
                return False
            if op[0] == "^" and op[2] < 0 and not is_nowhere_zero(s, f.parts(b)[0]):
                return False
    for name, a in point.items():
        for word in {*s.words.get(name, ())} - {"real"}:
            if word not in ("positive", "nonnegative", "nonzero") or f.value(a) == 0:
                return False
    for a, kind in s.conditions:
        b = f.substitute(a, point)
        if not (is_positive(s, b, strict=True, real=True) if kind == "positive" else is_nowhere_zero(s, b)):
            return False
    return True
