"""The branches of the motion at an energy: librations in wells, rotations over the barriers, and what lies between.

Between neighbouring critical points V is monotone, so that V = E has one solution there where the signs of E − V at
them differ, and none where they don't. An energy that no precision tells from a barrier's is on the separatrix.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from flint import arb

from canon.errors import InputError
from canon.numeric.actions.balls import Ball
from canon.numeric.actions.landscape import REACH, Critical, Interval, further
from canon.numeric.actions.profile import Profile
from canon.numeric.actions.roots import zero_between

FARTHEST = 2**16
"""Turning points are looked for up to 2^±`FARTHEST` of the unit of q."""

LIBRATION = "libration"
ROTATION = "rotation"


class TooCoarse(Exception):
    """The working precision does not tell on which side of a barrier the energy is."""


@dataclass(frozen=True)
class End:
    """Where a branch ends: a "simple" turning point between `inner` and `outer`; "unstable", "wall", or "open".

    `shift` is the number of periods that `outer`, and `inner`, are moved by.
    """

    kind: str
    inner: Critical
    outer: Critical
    shift: tuple[int, int] = (0, 0)


@dataclass(frozen=True)
class Branch:
    """A branch at an energy: its `kind`, its `ends`, and the critical points between them, each with its periods."""

    kind: str
    ends: tuple[End, End] | None
    inside: tuple[tuple[Critical, int], ...]

    @property
    def on_separatrix(self) -> bool:
        """Whether one of its ends is an unstable point, which the motion takes for ever to reach."""
        return self.ends is not None and any(end.kind == "unstable" for end in self.ends)

    @property
    def is_simple(self) -> bool:
        """Whether both ends are simple turning points."""
        return self.ends is not None and all(end.kind == "simple" for end in self.ends)

    @property
    def is_open(self) -> bool:
        """Whether it leads out of the domain."""
        return self.ends is not None and any(end.kind == "open" for end in self.ends)


def signs_of(nodes: Sequence[Critical], E: Ball, *, last: bool) -> list[int]:
    """The signs of E − V at the critical points; 0 where it can't be told and the precision is the `last` one."""
    found = []
    for node in nodes:
        rough = node.rough_value()
        value = rough if rough.is_finite() and (rough < E or rough > E) else node.value()
        if not value.is_finite():
            # an end says by its sign whether it is a wall; a pole inside, by which way V goes there
            found.append((-1 if value > 0 else 1) if node.kind == 0 else node.kind)
        elif value < E or value > E:
            found.append(1 if value < E else -1)
        elif last or (E.is_exact() and value.is_exact()):
            found.append(0)
        else:
            raise TooCoarse
    return found


def branches_at(nodes: Sequence[Critical], domain: Interval, E: Ball, *, last: bool) -> tuple[Branch, ...]:
    """The branches at the energy E, from left to right. **Raises:** `TooCoarse`."""
    signs = signs_of(nodes, E, last=last)
    if domain.period is None:
        return tuple(_runs([(node, 0) for node in nodes], signs, domain))
    if all(sign > 0 for sign in signs):
        return (Branch(ROTATION, None, tuple((node, 0) for node in nodes)),)
    barriers = [k for k, (node, sign) in enumerate(zip(nodes, signs, strict=True)) if node.kind < 0 and sign <= 0]
    if not barriers:
        return ()
    first = barriers[-1]
    order = [*range(first, len(nodes)), *range(first + 1)]
    turn = [0] * (len(nodes) - first) + [1] * (first + 1)
    placed = [(nodes[k], shift - 1) for k, shift in zip(order, turn, strict=True)]
    return tuple(_runs(placed, [signs[k] for k in order], domain))


def _runs(nodes: Sequence[tuple[Critical, int]], signs: Sequence[int], domain: Interval) -> list[Branch]:
    """The stretches of neighbouring critical points with V < E, each with what bounds it."""
    found = []
    start = None
    for k in range(len(nodes) + 1):
        inside = k < len(nodes) and signs[k] > 0
        if inside and start is None:
            start = k
        if not inside and start is not None:
            left = _end(nodes, signs, start, start - 1, domain.walls and domain.low > -inf)
            right = _end(nodes, signs, k - 1, k, domain.walls and domain.high < inf)
            found.append(Branch(LIBRATION, (left, right), tuple(nodes[start:k])))
            start = None
    return found


def _end(nodes: Sequence[tuple[Critical, int]], signs: Sequence[int], inner: int, outer: int, wall: bool) -> End:
    if not 0 <= outer < len(nodes):
        return End("wall" if wall else "open", nodes[inner][0], nodes[inner][0])
    kind = "simple" if signs[outer] < 0 else "unstable" if nodes[outer][0].kind else "open"
    return End(kind, nodes[inner][0], nodes[outer][0], (nodes[inner][1], nodes[outer][1]))


def end_place(end: End, profile: Profile, domain: Interval, E: Ball) -> Ball:
    """Where a branch ends at the energy E, to the working precision."""
    if end.kind == "open":
        raise InputError("the motion is not bounded: it leads out of the domain")
    if end.kind == "wall":
        place = end.outer.place()
        return arb(min((domain.low, domain.high), key=lambda x: abs(float(place) - x)))
    inner, outer = (place_of(node, k, domain) for node, k in zip((end.inner, end.outer), end.shift, strict=True))
    if end.kind == "unstable":
        return outer
    if not end.outer.kind and not profile.potential(outer) > E:
        outer = _beyond_the_turn(end.outer, profile, domain, E)
    low, high, sign = (inner, outer, 1) if inner < outer else (outer, inner, -1)
    return zero_between(
        lambda q: E - profile.potential(q), lambda q: -profile.slope(q), low, high, at_low=sign, outside=-1
    )


def _beyond_the_turn(end: Critical, profile: Profile, domain: Interval, E: Ball) -> Ball:
    """A place towards an end of the domain at which V isn't below E any more, as it is known to become.

    **Raises:** `InputError` where V is still below E at 2^±`FARTHEST` of the unit of q.
    """
    goal = domain.high if end.high > end.low else domain.low
    place = end.high
    reach = REACH
    while profile.potential(place) < E:
        reach *= 2
        if reach > FARTHEST:
            said = f"V still is below the energy at {profile.q} = {place.str(3, radius=False)}, and goes on to rise"
            raise InputError(f"the turning point is too far out to be found: {said}", "energy")
        place = further(goal, place, reach)
    return place


def place_of(node: Critical, periods: int, domain: Interval) -> Ball:
    """Where a critical point is, moved by a number of periods."""
    place = node.place()
    return place if domain.period is None or not periods else place + domain.period() * periods
