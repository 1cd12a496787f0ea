"""From an action and an angle to the phase point: E by J(E) = J, whose derivative is the period, then q by its time.

Both are increasing functions with known derivatives, solved by Newton's method within brackets that only shrink.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from flint import arb

from canon.errors import InputError
from canon.numeric.actions.angle import whole_time
from canon.numeric.actions.balls import Ball, precision
from canon.numeric.actions.bounded import Bounded, bounded
from canon.numeric.actions.branches import LIBRATION, ROTATION, Branch, branches_at
from canon.numeric.actions.course import Course, course_of, time_from_low, time_to_high, whole
from canon.numeric.actions.landscape import Critical
from canon.numeric.actions.levels import well_of
from canon.numeric.actions.reach import libration_reach, rotation_reach
from canon.numeric.actions.wells import holds

if TYPE_CHECKING:
    from canon.numeric.actions.motion import Motion

DIGITS: Final = 768
BITS: Final = 58
FINE: Final = 72
"""Bits to which an action is met: so many more than those of the answer that it is off by nothing that counts there."""
_ROUNDS: Final = 200
_AGREED: Final = 40


def point_of(motion: Motion, J: Ball, w: Ball, well: float | None, kind: str | None) -> tuple[Bounded, Bounded]:
    """(q, p) at J and w. **Raises:** `InputError` where the branch has no such action."""
    _check_action(J)
    with precision(_bits_for(J)):
        kind = kind or _kind(motion)
        w = w - w.mid().floor()
        if kind == LIBRATION:
            lowest = well_of(motion.nodes, well)
            if J.is_zero():
                return bounded(lowest.place()), bounded(motion.profile.middle_momentum(lowest.place()))
        course = _course(motion, J, kind, well)
        return _place(course, w)


def energy_of(motion: Motion, J: Ball, well: float | None, kind: str | None) -> Bounded:
    """H(J). **Raises:** `InputError` where the branch has no such action."""
    _check_action(J)
    with precision(_bits_for(J)):
        kind = kind or _kind(motion)
        if J.is_zero() and kind == LIBRATION:
            return bounded(well_of(motion.nodes, well).value())
        course = _course(motion, J, kind, well)
        action, period = whole(course, bits=FINE, times=True).values
        return bounded(course.E + arb(0, (2 * abs(action - J) / period).abs_upper()))


def _check_action(J: Ball) -> None:
    if J < 0:
        raise InputError(f"an action is 0 or more, unlike {float(J):.6g}", "action")


def _bits_for(J: Ball) -> int:
    """Digits in which the energy of a small action is told from that of the minimum."""
    if J.is_zero() or not J < 1:
        return DIGITS
    return DIGITS + 2 * math.ceil(-float(J.log()) / math.log(2))


def _kind(motion: Motion) -> str:
    minima = any(node.kind > 0 for node in motion.nodes)
    return LIBRATION if minima or motion.domain.period is None else ROTATION


def _course(motion: Motion, J: Ball, kind: str, well: float | None) -> Course:
    """The course of the branch whose action is J."""
    lowest = well_of(motion.nodes, well) if kind == LIBRATION else None
    low, high = rotation_reach(motion, J) if lowest is None else libration_reach(motion, J, lowest)

    def at(E: Ball) -> tuple[Course, Ball, Ball]:
        branch = _branch(motion, E, kind, lowest)
        course = course_of(motion.profile, branch, motion.domain, E)
        found = whole(course, bits=FINE, times=True)
        if not found.resolved:
            raise InputError(f"the action near E = {float(E):.17g} does not settle", "action")
        return course, found.values[0], found.values[1]

    if high is None:
        step = arb(1)
        while at(low + step)[1] < J:
            step = 2 * step
        high = low + step
    last: list[tuple[Course, Ball]] = []

    def defect(E: Ball) -> tuple[Ball, Ball]:
        course, action, period = at(E)
        last[:] = [(course, action)]
        return action - J, period

    _increasing(defect, low, high, J, FINE)
    course, action = last[0]
    if abs(action - J) > abs(J) / 2**_AGREED:
        raise InputError(
            f"no {kind} has the action {float(J):.10g}: they end at {float(action):.10g}, where E = "
            f"{float(course.E):.10g} is that of escape",
            "action",
        )
    return course


def _branch(motion: Motion, E: Ball, kind: str, lowest: Critical | None) -> Branch:
    for branch in branches_at(motion.nodes, motion.domain, E, last=True):
        if branch.kind == kind and (lowest is None or holds(branch, lowest.place(), motion.domain)):
            return branch
    raise InputError(f"there is no {kind} at E = {float(E):.17g}: {motion.ranges()}", "action")


def _increasing(
    function: Callable[[Ball], tuple[Ball, Ball]], low: Ball, high: Ball, scale: Ball, bits: int = BITS
) -> tuple[Ball, Ball]:
    """The zero of an increasing function given with its derivative, to so many bits of the `scale`, or to as many as
    its values have; and the function's value there.
    """
    x = ((low + high) / 2).mid()
    close = abs(scale) / 2**bits
    value, slope = function(x)
    for _ in range(_ROUNDS):
        if abs(value.mid()) <= close or value.contains(0):
            break
        low, high = (x, high) if value < 0 else (low, x)
        target = x - value / slope
        new = target.mid() if target > low and target < high else ((low + high) / 2).mid()
        if new == x:
            break
        x = new
        value, slope = function(x)
    return x, value


def _place(course: Course, w: Ball) -> tuple[Bounded, Bounded]:
    """(q, p) at the angle w: q = mid − half cos θ makes the time a smooth function of θ at both ends."""
    profile = course.profile
    up = whole_time(course, 1, BITS) if not course.rotates else whole(course, bits=BITS, times=True).values[1]
    down = arb(0) if course.rotates else up if profile.mirrored else whole_time(course, -1, BITS)
    t = w * (up + down)
    side = 1 if course.rotates or t < up else -1
    since = t if side > 0 else up + down - t
    span = up if side > 0 else down
    centre, half = (course.low + course.high) / 2, (course.high - course.low) / 2
    if not since > 0:
        return bounded(course.low), bounded(profile.middle_momentum(course.low))

    def defect(theta: Ball) -> tuple[Ball, Ball]:
        sine, cosine = theta.sin_cos()
        q = centre - half * cosine
        if cosine > 0:
            passed = time_from_low(course, q, side, BITS)
        else:
            passed = span - time_to_high(course, q, side, BITS)
        return passed - since, half * sine * profile.outward(q, course.E, side)[1]

    theta, missed = _increasing(defect, arb(0), arb.pi(), span)
    q = (centre - half * theta.cos()).mid()
    off = (span / 2 ** (BITS - 2) + 2 * abs(missed)) / profile.outward(q, course.E, side)[1]
    q = q + arb(0, off.abs_upper())
    return bounded(q), bounded(profile.outward(q, course.E, side)[0])
