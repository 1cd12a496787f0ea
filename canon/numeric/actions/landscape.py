"""The minima and maxima of a potential V(q) along its whole domain, and what it does at the ends.

The domain is cut into cells, evenly over one period or geometrically towards infinite ends. Where a ball of V' over a
cell is certain of its sign, V is monotone there; other cells are halved, a number of times, and beyond that V' is
compared at the cell's ends. So a dent that is narrower than the smallest cells may be missed, and no other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any, Final

import flint
from flint import arb

from canon.errors import InputError
from canon.numeric.actions.balls import Ball, precision, sign_of
from canon.numeric.actions.profile import Profile
from canon.numeric.actions.roots import zero_between

REACH: Final = 90
"""Infinite ends are followed to 2^±90 of the unit of q."""

_CELLS: Final = 96
_HALVINGS: Final = 7
_NARROW_HALVINGS: Final = 4
_BITS: Final = 128
_SETTLED: Final = 2**10
_SHIFT: Final = 0.98765
"""No cell begins at a round number, where critical points like to lie."""


@dataclass(frozen=True)
class Interval:
    """The domain of q: from `low` to `high`, either of them infinite; `period` where V and H repeat themselves.

    With `walls`, the motion is reflected at finite ends; without, it is lost there.
    """

    low: float
    high: float
    period: Callable[[], Ball] | None = None
    walls: bool = False


@dataclass(frozen=True)
class Critical:
    """A minimum (`kind` 1) or maximum (−1) of V between two places, or an end of the domain (`kind` 0) at `low`."""

    profile: Profile
    kind: int
    low: Any
    high: Any

    def place(self) -> Ball:
        """Where it is, to the working precision."""
        return self.low if self.kind == 0 else _place(self.profile, self.low, self.high, flint.ctx.prec)

    def value(self) -> Ball:
        """V there, to the working precision; the limit at an end, which may be infinite."""
        if self.kind:
            there = self.profile.potential(self.place())
            return there if there.is_finite() else _at_a_cusp(self.profile, self.place(), self.low)
        return _limit(self.profile, self.low, self.high)

    def rough_value(self) -> Ball:
        """V there, by what V is between `low` and `high`: a ball that may be wide, and asks for no zero of V'."""
        return self.profile.potential(self.low.union(self.high)) if self.kind else arb("nan")

    def __float__(self) -> float:
        return float(self.place())


def landscape(profile: Profile, domain: Interval) -> tuple[Critical, ...]:
    """The critical points in order, between the ends of the domain; of one period, if there is one, from a maximum on.

    **Raises:** `InputError` where V has no value anywhere that was looked at, or H isn't least at rest.
    """
    with precision(_BITS):
        cells = list(_cells(domain))
        signed = [piece for low, high in cells for piece in _signed(profile, low, high, _HALVINGS)]
        if not signed:
            raise InputError(f"the potential {profile.V} has no real value anywhere")
        inner = tuple(_changes(profile, signed))
        for node in inner:
            profile.check_rest(node.place())
        if domain.period is not None:
            return inner
        first, last = signed[0][0], signed[-1][1]
        low = Critical(profile, 0, first, further(domain.low, first))
        high = Critical(profile, 0, last, further(domain.high, last))
        return (low, *inner, high)


def further(end: float, reached: Ball, doublings: int = REACH) -> Ball:
    """A place further towards the end, to see where V tends: so many doublings of the distance, or halvings."""
    if end in (float("inf"), float("-inf")):
        return reached * arb(2) ** doublings
    return end + (reached - end) * arb(2) ** -doublings


def _cells(domain: Interval) -> Iterator[tuple[Ball, Ball]]:
    if domain.period is not None:
        period = domain.period()
        start = -period * arb(_SHIFT) / 2
        edges = [start.mid() + (period * k / _CELLS).mid() for k in range(_CELLS + 1)]
        edges = [edge.mid() for edge in edges]
    else:
        edges = _edges(domain.low, domain.high)
    yield from pairwise(edges)


def _edges(low: float, high: float) -> list[Ball]:
    """Places that crowd towards finite ends, and spread towards infinite ones."""
    infinite = float("inf")
    if low == -infinite and high == infinite:
        right = [arb(_SHIFT) * arb(2) ** k for k in range(-REACH, REACH + 1)]
        return [*(-x for x in reversed(right)), *right]
    if high == infinite:
        return [arb(low) + arb(_SHIFT) * arb(2) ** k for k in range(-REACH, REACH + 1)]
    if low == -infinite:
        return [arb(high) - arb(_SHIFT) * arb(2) ** k for k in range(REACH, -REACH - 1, -1)]
    length = arb(high) - arb(low)
    steps = [arb(2) ** -k for k in range(REACH, 5, -1)]
    even = [(k + arb(_SHIFT)) / _CELLS for k in range(_CELLS)]
    parts = [*steps, *(x for x in even if x > steps[-1] and x < 1 - steps[-1]), *(1 - x for x in reversed(steps))]
    return [(arb(low) + length * x).mid() for x in parts]


def _signed(profile: Profile, low: Ball, high: Ball, halvings: int) -> Iterator[tuple[Ball, Ball, int]]:
    """Pieces of a cell with the sign of V' at both of their ends or, where it has one sign, throughout."""
    over = profile.slope(low.union(high))
    certain = sign_of(over)
    if certain:
        yield low, high, certain
        return
    narrow = not high - low > arb(2) ** -24  # near an end: halved as far as balls of powers need it
    left = min(halvings, _NARROW_HALVINGS) if narrow and not over.is_finite() else halvings
    if left and high - low < arb(2) ** 24 and not (narrow and over.is_finite()):
        half = ((low + high) / 2).mid()
        yield from _signed(profile, low, half, left - 1)
        yield from _signed(profile, half, high, left - 1)
        return
    ends = [sign_of(profile.slope(x)) for x in (low, high)]
    if None in ends or (high - low < 1 and not over.is_finite()):
        return
    if ends[0] == ends[1]:
        yield low, high, ends[0] or 0
    else:
        yield low, low, ends[0] or 0
        yield high, high, ends[1] or 0


def _changes(profile: Profile, signed: list[tuple[Ball, Ball, int]]) -> Iterator[Critical]:
    """Where the sign of V' changes from one piece to the next."""
    known = [piece for piece in signed if piece[2]]
    for (a, b, before), (c, d, after) in pairwise(known):
        if before == after and b < c and (profile.potential(c) - profile.potential(b)) * before < 0:
            raise InputError(
                f"the potential jumps from one infinity to the other near {profile.q} = {float((b + c) / 2):.6g}: say "
                f"on which side the motion is, as domain = (0, inf)",
                "H",
            )
        if before != after:
            # the sign is known only at the piece's ends where it was not certain throughout
            low, high = (b if sign_of(profile.slope(b)) == before else a), c
            if sign_of(profile.slope(c)) != after:
                high = d
            yield Critical(profile, after, low, high)


@lru_cache(maxsize=512)
def _place(profile: Profile, low: Ball, high: Ball, prec: int) -> Ball:
    """The critical point between two places, to `prec` bits, the working precision."""
    del prec
    return zero_between(profile.slope, profile.curvature, low, high)


def _at_a_cusp(profile: Profile, place: Ball, near: Ball) -> Ball:
    """V where a ball of it isn't finite though V is, as of |q|^(2/3) about 0: by its values next to the place.

    It is finite if from four times as far V changes by much less than it does `near`; the rest of the way it changes by
    no more than 8 times as much, as any power from 1/8 on. Not finite where V has a pole, or a logarithm's.
    """
    middle, r = place.mid(), 4 * place.rad()
    inner = [profile.potential(middle + side * r) for side in (-1, 1)]
    outer = [profile.potential(middle + 4 * side * r) for side in (-1, 1)]
    wide = abs(profile.potential(near) - profile.potential(middle + (near - middle) / 4))
    steps = [abs(b - a) for a, b in zip(inner, outer, strict=True)]
    if not (wide.is_finite() and all(step.is_finite() and step * _SETTLED < wide for step in steps)):
        return arb("nan")
    centre = profile.potential(middle)
    found = centre if centre.is_finite() else inner[0].union(inner[1])
    return found + arb(0, 16 * max(steps, key=float).abs_upper())


def _limit(profile: Profile, near: Ball, far: Ball) -> Ball:
    """V at an end: its value far out if it settles there, else infinite with the sign of its growth."""
    here, there = profile.potential(near), profile.potential(far)
    if not here.is_finite():
        return arb("nan")
    change = there - here
    if there.is_finite() and abs(change) < arb(2) ** -60 * (1 + abs(there)):
        return arb(0) if abs(there) <= arb(2) ** -60 * abs(here) else there.mid()
    if not there.is_finite():
        growing = profile.slope(near) * (far - near)
        return arb.pos_inf() if growing > 0 else arb.neg_inf()
    return arb.pos_inf() if change > 0 else arb.neg_inf()
