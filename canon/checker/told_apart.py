"""Whether functions are linearly independent over the reals, as their values at points say."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import Any

from canon.checker.case import Case
from canon.checker.points import CLOSE, Numbers, Outside, inside, on_surface
from canon.checker.statement import Statement


def independence(s: Statement, case: Case, functions: Sequence[int], numbers: Numbers, of: Mapping[str, Any]) -> Any:
    """0 where functions of the coordinates seem to be linearly dependent over the reals, at fixed parameters.

    It is the determinant of their values at as many points near one, each row and column divided by its largest entry;
    then near its mirror images, too, since functions may be told apart by two components alone, as q and |q|.
    """
    rng, found = random.Random(2), numbers.mp.mpf(0)
    for mirrored in (False, *[True] * 4):
        if found == 0:
            found = _determinant(s, case, functions, numbers, of, rng, mirrored)
    return found


def _determinant(
    s: Statement,
    case: Case,
    functions: Sequence[int],
    numbers: Numbers,
    of: Mapping[str, Any],
    rng: random.Random,
    mirrored: bool,
) -> Any:
    """The determinant at points near one, or near its mirror images; 0 where there are too few of these."""
    rows, mp = list[list[Any]](), numbers.mp
    moving = {*s.coordinates, *s.bracketed} & of.keys()
    for _ in range(6 * len(functions)):
        near = {**of, **{n: of[n] * (1 + (rng.random() - 0.5) / 3) + rng.random() / 9 for n in sorted(moving)}}
        if mirrored:
            near |= {n: near[n] * rng.choice((1, -1)) for n in sorted(moving)}
        if not on_surface(s, numbers, near, of.keys() - moving) or not inside(s, case, numbers, near):
            continue
        try:
            found = numbers.values(s.f, functions, near)
        except Outside:
            continue
        rows.append([found[a] for a in functions])
        if len(rows) == len(functions):
            break
    if len(rows) < len(functions):
        if mirrored:
            return mp.mpf(0)
        raise Outside
    largest = [max(abs(row[k]) for row in rows) for k in range(len(functions))]
    if min(largest) < mp.mpf(10) ** -CLOSE:  # nothing but rounding
        return mp.mpf(0)
    size = mp.det(mp.matrix([[x / m for x, m in zip(row, largest, strict=True)] for row in rows]))
    return size if abs(size) > mp.mpf(10) ** -CLOSE else mp.mpf(0)
