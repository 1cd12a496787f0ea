"""A rigorous bound on the symplectic defect of a map over a box, by ball arithmetic and subdivision."""

from __future__ import annotations

import heapq
import math
import time
from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import count
from numbers import Real
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.claims.audit_subject import checked_parameters, exactly, formulas_as_map
from canon.claims.defect_bound import DefectBound
from canon.claims.exact_program import program_of_formulas, program_of_function
from canon.claims.invariance import checked_valence
from canon.decide.series_program import Unenclosed
from canon.decide.symplectic_defect import BITS, Box, BoxBound, defect_over, degree_for
from canon.decide.tape import Unsupported
from canon.errors import InputError
from canon.expected import whole_number
from canon.numeric.points import DEFAULT, points_of
from canon.program import Program

if TYPE_CHECKING:
    from canon.mechanics.phase_space import PhaseSpace
    from canon.mechanics.transformation import Transformation

__all__ = ["DefectBound", "certify"]

CLOSE: Final = 1.05
"""A bound that is no larger than so many times the defect at some point can't be bettered by much."""

LONGEST: Final = 1e9
"""Seconds, beyond which a budget is as good as any."""
HIGHEST: Final = 64
"""The highest degree of an expansion: the number of its terms grows as a power of it."""
FINEST: Final = Fraction(1, 2**12)
"""A part of the box this much narrower, where the map still can't be enclosed, is given up."""


def certify(
    map: Transformation | Callable[..., Any],  # noqa: A002 - the field's own word
    box: Any,
    *,
    dimension: int | None = None,
    space: PhaseSpace | None = None,
    scale: float = 1.0,
    parameters: Mapping[str, float] | None = None,
    tolerance: float = 1e-9,
    boxes: int = 1000,
    budget: float = 10.0,
    degree: int | None = None,
) -> DefectBound:
    """A bound on every entry of M J Mᵀ − scale J that holds at every point of a box of phase space.

    The box is cut where the bound is worst, until it is at most `tolerance`, or close to the defect at some point, or
    the `boxes` or the `budget` (seconds) are used up: then the bound is as good as it got. Each part's bound is its
    Taylor expansion at the centre with the remainder enclosed over the part, all in balls.

    **Arguments:**

    - `map`: a `Transformation` given by formulas, or a function that jax can trace (one point z of shape (2n,), or a
      pair). Its numbers are exact, floats too.
    - `box`: (low, high) for all variables, one pair for each, or a table by name.
    - `dimension` or `space`, as for `audit`, for a function (a list of pairs tells its dimension); `scale`,
      `parameters`, as for `audit`.
    - `degree`: that of the Taylor expansion of M; by default it depends on the number of variables.

    **Returns:** a `DefectBound`.

    **Raises:** `InputError` for a map that balls can't follow (a numpy function, a loop whose length depends on the
    point, special functions), and for a box that is none.
    """
    from canon.claims.audit import variables
    from canon.mechanics.transformation import Transformation

    start = time.monotonic()
    checked_valence(scale)
    parameters = checked_parameters(parameters)
    for name, value in (("tolerance", tolerance), ("budget", budget)):
        if not isinstance(value, Real) or isinstance(value, bool) or not value >= 0:
            raise InputError(f"a number of at least 0 is needed, not {value!r}", name)
    tolerance, budget = float(min(tolerance, LONGEST)), float(min(budget, LONGEST))
    boxes, degree = (
        whole_number(boxes, "boxes", 1),
        None if degree is None else whole_number(degree, "degree", 1, HIGHEST),
    )
    if isinstance(box, np.ndarray) and box.ndim == 2 and box.shape[1] != 2:
        raise InputError("a box is a pair (low, high) for each variable, not an array of points", "box")
    if isinstance(map, Transformation):
        subject = formulas_as_map(map, parameters, scale)
        names, exact = tuple(subject.names), subject.exact_scale
        low, high = _box(box, names)
        program = program_of_formulas(map, subject.parameters)
    else:
        if parameters:
            raise InputError("a function has its parameters already; `parameters` are for formulas", "parameters")
        if dimension is None and space is None:
            dimension = _pairs(box)
        names, exact = variables(dimension, space), exactly(scale)
        low, high = _box(box, names)
        program = program_of_function(map, len(names))
    whole = Box(
        tuple((Fraction(a) + Fraction(b)) / 2 for a, b in zip(low, high, strict=True)),
        tuple((Fraction(b) - Fraction(a)) / 2 for a, b in zip(low, high, strict=True)),
    )
    order = degree_for(len(names)) if degree is None else degree
    search = _Search(program, exact, order, whole)
    try:
        search.run(tolerance, boxes, start + budget)
    except Unsupported as reason:
        raise InputError(f"the map has no enclosure by power series: {reason}") from reason
    return search.result(names, float(exact), _words(low, high), start)


def _pairs(box: Any) -> int | None:
    """The number of pairs (low, high), where a box is a list of such."""
    if isinstance(box, (list, tuple, np.ndarray)) and all(np.ndim(side) == 1 for side in box):
        return len(box)
    return None


def _box(box: Any, names: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    if isinstance(box, Mapping):
        missing = [name for name in names if name not in {str(key) for key in box}]
        if missing:
            raise InputError(f"the box has no pair (low, high) for {', '.join(missing)}", "box")
    elif isinstance(box, np.ndarray):
        box = [tuple(side) for side in np.atleast_2d(box)]
    elif box is None:
        raise InputError("a box is a pair (low, high), or one for each variable", "box")
    where = points_of(box, names, [DEFAULT] * len(names))
    return where.low, where.high


def _words(low: np.ndarray, high: np.ndarray) -> str:
    sides = [f"[{a:g}, {b:g}]" for a, b in zip(low, high, strict=True)]
    return f"{sides[0]} for each variable" if len(set(sides)) == 1 and len(sides) > 1 else " × ".join(sides)


class _Search:
    """Boxes that have been bounded, the worst first."""

    def __init__(self, program: Program, scale: Fraction, degree: int, whole: Box) -> None:
        self.program, self.scale, self.degree, self.whole = program, scale, degree, whole
        self.tie = count()
        self.queue: list[tuple[float, int, Box, BoxBound | None]] = []
        self.given_up: list[Box] = []
        self.reason = ""
        self.lower, self.at = 0.0, None
        self.boxes = 0

    def run(self, tolerance: float, most: int, end: float) -> None:
        """Bound the box, then cut the worst parts."""
        self._bound(self.whole)
        while self.queue and self.boxes + 1 < most and time.monotonic() < end:
            worst, _, box, bound = self.queue[0]
            if -worst <= max(tolerance, CLOSE * self.lower):
                return
            heapq.heappop(self.queue)
            if bound is None and self._finest(box):
                self.given_up.append(box)
                continue
            for half in box.halves(self._direction(box, bound)):
                self._bound(half)

    def _bound(self, box: Box) -> None:
        self.boxes += 1
        try:
            bound = defect_over(self.program, box, self.scale, self.degree)
        except Unenclosed as reason:
            self.reason = self.reason or str(reason)
            # parts that can't be enclosed come first, the largest of them before the others
            heapq.heappush(self.queue, (-math.inf, next(self.tie), box, None))
            return
        if bound.lower > self.lower:
            self.lower, self.at = bound.lower, box.centre
        heapq.heappush(self.queue, (-bound.upper, next(self.tie), box, bound))

    def _widths(self, box: Box) -> list[Fraction]:
        return [r / all_ if all_ else Fraction(0) for r, all_ in zip(box.radii, self.whole.radii, strict=True)]

    def _finest(self, box: Box) -> bool:
        return max(self._widths(box)) <= FINEST

    def _direction(self, box: Box, bound: BoxBound | None) -> int:
        widths = self._widths(box)
        if bound is not None and widths[bound.direction] * 16 >= max(widths):
            return bound.direction
        return widths.index(max(widths))

    def _volume(self, box: Box) -> Fraction:
        return math.prod((width for width in self._widths(box) if width), start=Fraction(1))

    def result(self, names: tuple[str, ...], scale: float, words: str, start: float) -> DefectBound:
        """What was found."""
        left = [*self.given_up, *(box for _, _, box, bound in self.queue if bound is None)]
        bounds = [bound for _, _, _, bound in self.queue if bound is not None]
        if not bounds:
            raise InputError(f"the map is not certified to be smooth on any part of the box: {self.reason}", "box")
        worst = max(bounds, key=lambda bound: bound.upper)
        return DefectBound(
            upper=math.inf if left else worst.upper,
            lower=self.lower,
            entry=_label(worst.entry, len(names) // 2),
            at=None if self.at is None else tuple(float(x) for x in self.at),
            enclosed=float(1 - sum((self._volume(box) for box in left), Fraction(0))),
            upper_enclosed=worst.upper,
            reason=self.reason if left else "",
            dimension=len(names),
            scale=scale,
            box=words,
            variables=names,
            boxes=self.boxes,
            degree=self.degree,
            bits=BITS,
            seconds=time.monotonic() - start,
        )


def _label(entry: tuple[int, int], n: int) -> str:
    """{Q1,P2} for row 0 and column n + 1."""
    return "{" + ",".join(f"Q{k + 1}" if k < n else f"P{k - n + 1}" for k in entry) + "}"
