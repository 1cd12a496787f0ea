"""A case is run: its routes at all its points, each beside the reference."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Final

import numpy as np

from canon.hard import plain
from canon.hard.case import Answer, HardCase, Quantities, Route, each
from canon.hard.digits import allowed, condition, exactly, holds, kept
from canon.numeric.precision import double

WITHIN: Final = 1.0
"""Digits that a route may lose beyond what conditioning takes."""


@dataclass(frozen=True)
class Kept:
    """Digits that a route kept of the quantity of which it falls shortest, and by how many it does."""

    digits: float
    shortfall: float

    @property
    def fails(self) -> bool:
        """Whether it loses more than a digit beyond what conditioning takes."""
        return self.shortfall > WITHIN


@dataclass(frozen=True)
class Digits:
    """One point: the condition of the quantity of which the naive route falls shortest, the digits that this allows,
    and what each route kept; None for one that is not installed.
    """

    point: tuple[float, ...]
    condition: float
    allowed: float
    ours: Kept
    naive: Kept
    peers: Mapping[str, Kept | None]


@dataclass(frozen=True)
class Row:
    """A case that was run.

    `digits`, point by point; `bound_holds`, of the bounds that ours states; `seconds` that ours took, compilation
    included.
    """

    case: HardCase
    digits: tuple[Digits, ...]
    bound_holds: bool | None
    seconds: float

    @property
    def shown(self) -> Digits:
        """The point at which the naive route falls shortest of what is allowed."""
        return max(self.digits, key=lambda each: each.naive.shortfall)

    @property
    def worst(self) -> Digits:
        """The point at which ours does."""
        return max(self.digits, key=lambda each: each.ours.shortfall)

    @property
    def verdict(self) -> str:
        """ "kept" where ours is within a digit of what conditioning allows at every point, and its bounds hold; "open"
        where that is not so and the case says why; else "lost".
        """
        if self.bound_holds is False:
            return "lost"
        if not self.worst.ours.fails:
            return "kept"
        return "open" if self.case.open else "lost"

    @property
    def naive_fails(self) -> bool:
        """Whether the naive route loses more than is allowed, at some point."""
        return self.shown.naive.fails

    @property
    def failing(self) -> tuple[str, ...]:
        """The peers that do."""
        return tuple(
            peer for peer in self.case.peers if any((kept := each.peers[peer]) and kept.fails for each in self.digits)
        )


def run(case: HardCase) -> Row:
    """The row of a case. Errors of a naive route or a peer's count as no digits; ours may raise none."""
    with warnings.catch_warnings(), np.errstate(all="ignore"), double():
        warnings.simplefilter("ignore")
        start = time.perf_counter()
        ours = case.ours(case.points)
        seconds = time.perf_counter() - start
        naive = _tried(case.naive or each(lambda *x: case.reference(plain, *x)), case)
        peers = {name: _tried(route, case) if installed(name) else None for name, route in case.peers.items()}
    found: list[Digits] = []
    bounds: list[bool] = []
    for k, point in enumerate(case.points):
        exact, conditions = exactly(case, point), condition(case, point)
        left = [allowed(value) for value in conditions]
        short = [a - b for a, b in zip(left, _each_kept(naive[k], exact), strict=True)]
        worst = short.index(max(short))
        found.append(
            Digits(
                point,
                conditions[worst],
                left[worst],
                _kept(ours[k], exact, left),
                _kept(naive[k], exact, left),
                {name: None if answers is None else _kept(answers[k], exact, left) for name, answers in peers.items()},
            )
        )
        held = holds(ours[k], exact)
        bounds += [] if held is None else [held]
    return Row(case, tuple(found), all(bounds) if bounds else None, seconds)


def installed(peer: str) -> bool:
    """Whether a peer's package is there: "scipy.special" is scipy's."""
    return find_spec(peer.split(".")[0].split(" ")[0]) is not None


def _each_kept(answer: Answer | None, exact: Quantities) -> list[float]:
    if answer is None or len(answer.values) != len(exact):
        return [0.0] * len(exact)
    return [kept(value, true) for value, true in zip(answer.values, exact, strict=True)]


def _kept(answer: Answer | None, exact: Quantities, left: Sequence[float]) -> Kept:
    """Of the quantity of which the answer falls shortest."""
    digits = _each_kept(answer, exact)
    return max((Kept(d, most - d) for d, most in zip(digits, left, strict=True)), key=lambda each: each.shortfall)


def _tried(route: Route, case: HardCase) -> list[Answer | None]:
    """The answers of a route that may raise at some points: None there."""
    found: list[Answer | None] = []
    for point in case.points:
        try:
            found.append(route([point])[0])
        except (ArithmeticError, ValueError, TypeError, np.linalg.LinAlgError, RuntimeError):
            found.append(None)
    return found
