"""What is true, found out by mpmath: values at random points of the domain, derivatives by central differences."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import mpmath as mp

from properties.soundness.formula import DIGITS, Formula, Outside, value

STEP = mp.mpf(10) ** -14
NOISE = mp.mpf(10) ** -20
FINER = 6
Box = Mapping[str, tuple[Fraction | str | None, Fraction | str | None]]


def edge(bound: Any) -> Any:
    """An end of an interval: a number, or a multiple of pi as text."""
    number = Fraction(bound.removesuffix("pi")) if isinstance(bound, str) else bound
    return mp.mpf(number.numerator) / number.denominator * (mp.pi if isinstance(bound, str) else 1)


def points(
    rng: random.Random, names: Sequence[str], box: Box, count: int, integers: Sequence[str] = ()
) -> Iterator[dict[str, Any]]:
    """Random points of a box; a name without bounds is drawn from both sides of 0 in several sizes."""
    for k in range(count):
        point: dict[str, Any] = {}
        for name in names:
            low, high = box.get(name, (None, None))
            if name in integers:
                point[name] = mp.mpf(rng.choice([n for n in range(-6, 7) if n]) if low is None else rng.randrange(1, 7))
            elif low is None or high is None:
                size = mp.mpf(rng.randrange(1, 10**6)) / 10 ** rng.choice((4, 5, 5, 6))
                if low is not None:
                    point[name] = edge(low) + size
                elif high is not None:
                    point[name] = edge(high) - size
                else:
                    point[name] = size if rng.getrandbits(1) else -size
            else:
                t = mp.mpf(rng.randrange(1, 10**6)) / 10**6
                t = t / 1000 if k % 7 == 5 else 1 - t / 1000 if k % 7 == 6 else t
                point[name] = edge(low) + t * (edge(high) - edge(low))
        yield point


def differs(
    rng: random.Random,
    lhs: Formula,
    rhs: Formula,
    names: Sequence[str],
    box: Box,
    *,
    count: int,
    integers: Sequence[str] = (),
    inside: Callable[[Mapping[str, Any]], bool] = lambda point: True,
) -> tuple[dict[str, Any] | None, int]:
    """(a point of the domain at which two formulas differ or None, the number of points of the domain seen)."""
    seen = 0
    with mp.workdps(DIGITS):
        for point in points(rng, names, box, count, integers):
            try:
                if not inside(point):
                    continue
                gap = apart(lhs, rhs, point)
            except (Outside, ZeroDivisionError, OverflowError, ValueError):
                continue
            seen += 1
            if gap:
                return point, seen
    return None, seen


def apart(lhs: Formula, rhs: Formula, point: Mapping[str, Any], *, noise: Any = NOISE) -> bool:
    """Whether two formulas differ at a point by more than rounding: by as much in six times the digits."""
    left, right = value(lhs, point), value(rhs, point)
    if not abs(left - right) > noise * (abs(left) + abs(right)):
        return False
    with mp.workdps(FINER * mp.mp.dps):
        finer = value(lhs, point) - value(rhs, point)
    return bool(abs(finer - (left - right)) < abs(finer) / 100)


def fails_at(
    functions: Sequence[Formula], variables: Sequence[str], point: Mapping[str, Any], scale: Any, *, close: bool = False
) -> bool:
    """Whether the map isn't canonical at a point: the defect is the same in six times the digits; **raises** `Outside`.

    `close` looks with more digits from the start, for a point at which the defect may be tiny.
    """
    finest = (FINER, 4 * FINER) if close else (1, FINER)
    defect, place = bracket_defect(functions, variables, point, scale, finest[0])
    if defect <= (NOISE**5 if close else NOISE):
        return False
    finer, same = bracket_defect(functions, variables, point, scale, finest[1])
    return same == place and bool(abs(finer - defect) < finer / 100)


def bracket_defect(
    functions: Sequence[Formula], variables: Sequence[str], point: Mapping[str, Any], scale: Any, finer: int = 1
) -> tuple[Any, tuple[int, int]]:
    """The largest |M J Mᵀ − scale·J| at a point, relative to the size of M, and its place; **raises** `Outside`."""
    with mp.workdps(finer * DIGITS):
        step = STEP ** (finer // 2 + 1)
        size, half, pairs = len(variables), len(variables) // 2, len(functions) // 2
        rows: list[list[Any]] = [[mp.mpf(0)] * size for _ in functions]
        for k, name in enumerate(variables):
            up, down = {**point, name: point[name] + step}, {**point, name: point[name] - step}
            upper, lower = {**point, name: point[name] + 2 * step}, {**point, name: point[name] - 2 * step}
            for i, f in enumerate(functions):
                near, far = value(f, up) - value(f, down), value(f, upper) - value(f, lower)
                rows[i][k] = (8 * near - far) / (12 * step)
        worst, place = mp.mpf(0), (0, 0)
        for i in range(2 * pairs):
            for j in range(i + 1, 2 * pairs):
                terms = [rows[i][k] * rows[j][k + half] - rows[i][k + half] * rows[j][k] for k in range(half)]
                size_of_terms = 1 + sum(
                    abs(rows[i][k] * rows[j][k + half]) + abs(rows[i][k + half] * rows[j][k]) for k in range(half)
                )
                defect = abs(sum(terms) - (scale if j == i + pairs else 0)) / size_of_terms
                if defect > worst:
                    worst, place = defect, (i, j)
        return worst, place


def not_canonical(
    rng: random.Random,
    functions: Sequence[Formula],
    variables: Sequence[str],
    names: Sequence[str],
    box: Box,
    *,
    scale: Any = 1,
    count: int = 12,
) -> tuple[dict[str, Any] | None, int]:
    """(a point at which the map isn't canonical or None, the number of points of the domain seen)."""
    seen = 0
    for point in points(rng, names, box, count):
        try:
            fails = fails_at(functions, variables, point, scale)
        except (Outside, ZeroDivisionError, OverflowError, ValueError):
            continue
        seen += 1
        if fails:
            return point, seen
    return None, seen
