"""A study of work and precision: what was tried, how exact it was, and what it cost.

Hairer and Wanner (1996), Solving Ordinary Differential Equations II, IV.10: work-precision diagrams.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, Final

ABOVE: Final = 30.0
"""So many times the floor is an error that isn't rounding."""
SETTLED: Final = 0.3
"""The last error is more than this part of those two points before it, where rounding is met: twice as much work and
twice again takes even a method of order 1 below that."""
FALLEN: Final = 0.9
"""An error is less than this part of the one before, if it has fallen."""


@dataclass(frozen=True)
class Point:
    """One configuration: the `method` and the amount of `work` (steps, nodes, bits, degrees), the `error` that was
    measured against the reference (None: there is none; 0: exact), and `seconds`, the median of `runs`, with the
    `least` of them and what the `first` took. `measures` are further figures, and `note` says what is to be said.
    """

    method: str
    work: float | None
    error: float | None
    seconds: float
    least: float = 0.0
    first: float = 0.0
    runs: int = 1
    measures: Mapping[str, float | None] = field(default_factory=dict)
    note: str = ""


@dataclass(frozen=True)
class Study:
    """What accuracy costs in one case.

    **Arguments:** `kind`, the command's word for it; `title`; `unit` of work, in words; `error`, what an error is
    relative to; `reference`, what errors are measured against; `floor`, below which an error is rounding, of the
    reference or of the doubles that hold the result; `orders`, the order that each method claims; `points`;
    `messages`, what couldn't be tried and why.
    """

    kind: str
    title: str
    unit: str
    error: str
    reference: str
    floor: float
    points: tuple[Point, ...]
    orders: Mapping[str, int] = field(default_factory=dict)
    messages: tuple[str, ...] = ()

    @property
    def methods(self) -> tuple[str, ...]:
        """The methods, each once, in the order in which they were tried."""
        return tuple(dict.fromkeys(point.method for point in self.points))

    def of(self, method: str) -> tuple[Point, ...]:
        """The points of one method, by increasing work."""
        return tuple(sorted((p for p in self.points if p.method == method), key=lambda p: p.work or 0.0))


def pareto(points: Sequence[Point]) -> frozenset[int]:
    """The places of points that no other one beats in error and in seconds at once."""
    known = [k for k, point in enumerate(points) if point.error is not None]
    order = sorted(known, key=lambda k: (points[k].seconds, _error(points[k])))
    front, best = set[int](), math.inf
    for k in order:
        if _error(points[k]) < best:
            best = _error(points[k])
            front.add(k)
    return frozenset(front)


def measured_order(study: Study, method: str) -> float | None:
    """The slope of −log error over log work, where errors are above the floor and above the method's own rounding.

    The median of the last three pairs of points; None where there are fewer than two.
    """
    points = [p for p in study.of(method) if p.work and p.error and math.isfinite(p.error)]
    errors = [p.error or 0.0 for p in points]
    settled = len(errors) > 2 and errors[-1] > SETTLED * min(errors[:-2])
    floor = max(study.floor, min(errors) if settled else 0.0)
    above = [(math.log(p.work or 1), math.log(p.error or 1)) for p in points if ABOVE * floor < (p.error or 0.0) < 0.1]
    slopes = [(a - b) / (y - x) for (x, a), (y, b) in pairwise(above) if b < a + math.log(FALLEN)]
    return statistics.median(slopes[-3:]) if len(slopes) > 1 else None


def cheapest(study: Study, accuracy: float) -> Point | None:
    """The point that cost least among those that are as exact; None where none is."""
    good = [point for point in study.points if point.error is not None and point.error <= accuracy]
    return min(good, key=lambda point: point.seconds, default=None)


def next_digit(study: Study, method: str) -> float | None:
    """The factor in time that one digit more costs with a method, by its measured order: 10^(1/order)."""
    order = measured_order(study, method)
    return None if order is None or order <= 0 else 10 ** (1 / order)


def record(study: Study) -> dict[str, Any]:
    """The study as data that JSON can hold."""
    front = pareto(study.points)
    return {
        "kind": study.kind,
        "title": study.title,
        "unit": study.unit,
        "error": study.error,
        "reference": study.reference,
        "floor": study.floor,
        "points": [_point(point, k in front) for k, point in enumerate(study.points)],
        "methods": [
            {
                "method": method,
                "claimed_order": study.orders.get(method),
                "measured_order": measured_order(study, method),
                "digit_factor": next_digit(study, method),
            }
            for method in study.methods
        ],
        "messages": list(study.messages),
    }


def _point(point: Point, on_front: bool) -> dict[str, Any]:
    return {
        "method": point.method,
        "work": point.work,
        "error": _finite(point.error),
        "seconds": point.seconds,
        "least": point.least,
        "first": point.first,
        "runs": point.runs,
        "pareto": on_front,
        **{name: _finite(value) for name, value in point.measures.items()},
        **({"note": point.note} if point.note else {}),
    }


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None


def _error(point: Point) -> float:
    return math.inf if point.error is None or math.isnan(point.error) else point.error
