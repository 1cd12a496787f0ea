"""∮ p dq and ∮ ∂p/∂E dq along one branch at one energy, and the time from its lower end to a point on it.

Where they are elliptic, Gauss's mean gives them. Else the rule is chosen by the nature of the end points: a period of a
rotation, two simple turning points far from any barrier, or anything else. What the rule does not resolve is cut at the
minima, barriers and kinks that it passes over.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from flint import arb

from canon.numeric.actions.balls import Ball
from canon.numeric.actions.branches import ROTATION, Branch, end_place, place_of
from canon.numeric.actions.details import has_details
from canon.numeric.actions.elliptic import by_mean
from canon.numeric.actions.landscape import Interval
from canon.numeric.actions.profile import Profile
from canon.numeric.actions.rules import Integrand, Quadrature, chebyshev, periodic, tanh_sinh
from canon.numeric.actions.wells import reduced

NEAR: Final = 0.05
"""A barrier is near where it is less than this part of the depth of the well away from the energy."""


@dataclass(frozen=True)
class Course:
    """A branch at an energy `E`: the places `low` and `high` between which it runs (of a rotation, one period).

    `side` is the sign of the momentum of a rotation, `cuts` the critical points and kinks inside.
    """

    profile: Profile
    branch: Branch
    E: Ball
    low: Ball
    high: Ball
    cuts: tuple[Ball, ...]
    side: int = 1

    @property
    def rotates(self) -> bool:
        """Whether it is a rotation."""
        return self.branch.kind == ROTATION


def course_of(profile: Profile, branch: Branch, domain: Interval, E: Ball, side: int = 1) -> Course:
    """The branch with its ends at the working precision. A rotation runs from its highest barrier to the next."""
    inside = [place_of(node, k, domain) for node, k in branch.inside]
    inside += [kink() for kink in profile.kinks]
    if branch.ends is not None:
        low, high = (end_place(end, profile, domain, E) for end in branch.ends)
        return Course(profile, branch, E, low, high, _between(inside, low, high), side)
    assert domain.period is not None
    period = domain.period()
    tops = [node.place() for node, _ in branch.inside if node.kind < 0]
    highest = max(tops, key=lambda q: float(profile.potential(q))) if tops else arb(0)
    # half a period before the origin, where that is as high: the pendulum's −π
    low = highest.mid() - period if highest > 0 else highest
    turned = [reduced(q, low, domain) for q in inside]
    return Course(profile, branch, E, low, low + period, _between(turned, low, low + period), side)


def _between(places: list[Ball], low: Ball, high: Ball) -> tuple[Ball, ...]:
    """The places certainly inside, in order, each once."""
    found: list[Ball] = []
    for place in sorted(places, key=float):
        if place > low and place < high and not (found and place.overlaps(found[-1])):
            found.append(place)
    return tuple(found)


def whole(course: Course, *, bits: int, times: bool) -> Quadrature:
    """(J, T), or J alone where `times` is False: of a rotation over one period, of a libration there and back."""
    closed = by_mean(course.profile, course.branch, course.E, bits) if times else None
    if closed is not None:
        return closed
    sides = [course.side] if course.rotates else [1] if course.profile.mirrored else [1, -1]
    found: list[Ball] = []
    used: Quadrature | None = None
    for side in sides:
        used = along(course, _integrand(course, side, times), bits)
        parts = [value * (1 if k else side) for k, value in enumerate(used.values)]
        found = parts if not found else [a + b for a, b in zip(found, parts, strict=True)]
        if not used.resolved:
            break
    assert used is not None
    if not course.rotates and len(sides) == 1:
        found = [2 * value for value in found]
    return Quadrature(tuple(found), used.nodes, used.rule, used.resolved, used.hopeless)


def _integrand(course: Course, side: int, times: bool) -> Integrand:
    """p, and dt/dq where `times`. A mirrored libration counts p from p_0, whose part cancels between the branches."""
    profile, E = course.profile, course.E
    relative = profile.mirrored and not course.rotates

    def integrand(q: Ball) -> tuple[Ball, ...]:
        p, slowness = profile.outward(q, E, side)
        if relative and profile.centre != 0:
            p = p - profile.middle_momentum(q)
        return (p, slowness) if times else (p,)

    return integrand


def along(course: Course, integrand: Integrand, bits: int) -> Quadrature:
    """∫ dq from the lower end to the upper one, by the rule that suits the ends."""
    if course.rotates and not near_barrier(course):
        found = periodic(integrand, course.low, course.high - course.low, bits)
        if found.resolved:
            return found
    elif not course.rotates and course.branch.is_simple and not near_barrier(course):
        if has_details(course.profile, (course.low, *course.cuts, course.high)):
            return _in_panels(integrand, (course.low, *course.cuts, course.high), bits)
        found = chebyshev(integrand, course.low, course.high, bits)
        if found.resolved:
            return found
    return _in_panels(integrand, (course.low, *course.cuts, course.high), bits)


def _in_panels(integrand: Integrand, cuts: tuple[Ball, ...], bits: int) -> Quadrature:
    """By tanh-sinh between neighbouring cuts, which see what is near them."""
    pieces = [tanh_sinh(integrand, a, b, bits + 2) for a, b in pairwise(cuts)]
    if not all(piece.values for piece in pieces):
        return Quadrature((arb("nan"),), 0, "tanh-sinh", False)
    values = tuple(sum(column[1:], start=column[0]) for column in zip(*(piece.values for piece in pieces), strict=True))
    return Quadrature(
        values,
        sum(piece.nodes for piece in pieces),
        "tanh-sinh",
        all(piece.resolved for piece in pieces),
        any(piece.hopeless for piece in pieces),
    )


def near_barrier(course: Course) -> bool:
    """Whether a barrier is so near to the energy that the motion lingers there."""
    profile, E = course.profile, float(course.E)
    inside = [float(profile.potential(node.place())) for node, _ in course.branch.inside]
    depth = E - min(inside, default=E - 1)
    tops = [value for (node, _), value in zip(course.branch.inside, inside, strict=True) if node.kind < 0]
    for end in course.branch.ends or ():
        if end.outer.kind < 0:
            tops.append(float(end.outer.value()))
    return any(abs(E - top) < NEAR * depth for top in tops)


def time_from_low(course: Course, q: Ball, side: int, bits: int) -> Ball:
    """The time from the lower end to q on the upper branch (`side` 1), or the same stretch on the lower one (−1)."""
    return panels(course, _slowness(course, side), course.low, q, bits)


def time_to_high(course: Course, q: Ball, side: int, bits: int) -> Ball:
    """The time from q to the upper end on a branch."""
    return panels(course, _slowness(course, side), q, course.high, bits)


def _slowness(course: Course, side: int) -> Integrand:
    return lambda q: (course.profile.outward(q, course.E, side)[1],)


def panels(course: Course, integrand: Integrand, low: Ball, high: Ball, bits: int) -> Ball:
    """∫ dq between two places, cut where the whole course is; not finite where that isn't resolved."""
    cuts = (low, *(x for x in course.cuts if x > low and x < high), high)
    found = _in_panels(integrand, cuts, bits)
    return found.values[0] if found.resolved else arb("nan")
