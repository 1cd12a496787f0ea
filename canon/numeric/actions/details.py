"""What of a potential is small beside a course: nodes that are spread over all of it would pass between.

Rules of quadrature double their nodes until nothing changes. Twice as many that have not seen a narrow well, a core at
the end of a long orbit, or a hump at its middle agree with each other all the same, and to all digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Final

from canon.errors import InputError
from canon.numeric.actions.balls import Ball, BallFunction, ball_function
from canon.numeric.actions.profile import Profile

DETAIL: Final = 1 / 64
"""The part of a course below which a detail of V is not left to nodes that are spread over all of it."""


def has_details(profile: Profile, places: Sequence[Ball]) -> bool:
    """Whether critical points lie near to each other or to an end, beside the whole course; or V changes its curvature
    about one of them within a small part of it. `places` are the ends, and between them the critical points, in order.

    A polynomial V has the same curve at any scale: its critical points are all that can be small.
    """
    small = (places[-1] - places[0]) * DETAIL
    if any(b - a < small for a, b in pairwise(places)):
        return True
    if profile.V.is_polynomial(profile.q):
        return False
    return any(_bends_within(profile, q, small) for q in places[1:-1])


def _bends_within(profile: Profile, q: Ball, distance: Ball) -> bool:
    """Whether V'' changes by as much as itself within this distance of a place, by its slope and curvature there."""
    changes = _changes(profile)
    if changes is None:
        return False
    first, second = (abs(change(q)) for change in changes)
    bend = abs(profile.curvature(q))
    return bool(first * distance > bend) or bool(second * distance**2 > bend)


@lru_cache(maxsize=256)
def _changes(profile: Profile) -> tuple[BallFunction, BallFunction] | None:
    """V''' and V''''; None where they have no values in balls."""
    try:
        third, fourth = (ball_function(profile.V.diff(profile.q, k), (profile.q,)) for k in (3, 4))
    except InputError:
        return None
    return third, fourth
