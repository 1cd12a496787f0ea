"""The angle w of a phase point: the part of the period since the motion was last at its lower end, on its way up.

The time is taken from the nearer end, so that neither end costs digits: w = t/T on the upper branch, and w = 1 − t/T
on the lower one of a mirrored libration. A rotation with p < p_0 starts from the upper end.
"""

from __future__ import annotations

from typing import Any

from flint import arb

from canon.numeric.actions.balls import Ball, ball_of
from canon.numeric.actions.course import Course, time_from_low, time_to_high, whole
from canon.numeric.actions.landscape import Interval
from canon.numeric.actions.wells import reduced


def angle_of(course: Course, domain: Interval, q: Any, p: Any, bits: int) -> Ball:
    """w in [0, 1) of the point (q, p) on its orbit; not finite where the working precision does not give it."""
    place = reduced(ball_of(q), course.low, domain)
    rest = course.profile.middle_momentum(place)
    side = 1 if not ball_of(p) < rest else -1
    if place < course.low or place > course.high:
        return arb("nan")
    up = whole_time(course, 1, bits)
    down = up if course.rotates or course.profile.mirrored else whole_time(course, -1, bits)
    period = up if course.rotates else up + down
    since = _from_nearer(course, place, side, up if side > 0 else down, bits)
    return since / period if side > 0 else _folded(1 - since / period)


def whole_time(course: Course, side: int, bits: int) -> Ball:
    """The time from the lower end to the upper one on a branch, or back on the other."""
    if course.rotates:
        return whole(course, bits=bits, times=True).values[1]
    if course.profile.mirrored:
        return whole(course, bits=bits, times=True).values[1] / 2
    half = (course.low + course.high) / 2
    return time_from_low(course, half, side, bits) + time_to_high(course, half, side, bits)


def _from_nearer(course: Course, q: Ball, side: int, all_of_it: Ball, bits: int) -> Ball:
    if q - course.low < course.high - q:
        if not q > course.low:
            return arb(0)
        return time_from_low(course, q, side, bits)
    if not q < course.high:
        return all_of_it
    return all_of_it - time_to_high(course, q, side, bits)


def _folded(w: Ball) -> Ball:
    """1 is 0 again."""
    return arb(0) if w == 1 else w
