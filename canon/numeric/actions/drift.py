"""How a cyclic coordinate runs on while the one that moves to and fro does: its mean rate, and its angle variable.

With Ω = ∂H/∂p_c, the frequency of the cyclic coordinate c of period 2π is ν_c = ⟨Ω⟩/2π, the mean being over a period,
and w_c = c/2π + ν_c t − (1/2π) ∫₀ᵗ Ω dt, where t is the time since the lower end: it grows evenly, and J_c = 2π p_c.
Goldstein, Poole and Safko (2002), Classical Mechanics, 10.7 and 10.8.
"""

from __future__ import annotations

from typing import Any

from flint import arb

from canon.numeric.actions.angle import angle_of, whole_time
from canon.numeric.actions.balls import Ball, BallFunction, ball_of
from canon.numeric.actions.course import Course, along, panels
from canon.numeric.actions.landscape import Interval
from canon.numeric.actions.wells import reduced


def drift_of(
    course: Course, domain: Interval, rate: BallFunction, q: Any, p: Any, start: Any, bits: int
) -> tuple[Ball, Ball]:
    """(ν_c, w_c) of the cyclic coordinate whose value is `start` where the other one is at (q, p)."""
    sides = [course.side] if course.rotates else [1, -1]
    gained = {side: along(course, _weighted(course, rate, side), bits) for side in sides}
    if not all(found.resolved for found in gained.values()):
        return arb("nan"), arb("nan")
    turn = 2 * arb.pi()
    up = whole_time(course, course.side if course.rotates else 1, bits)
    period = up if course.rotates else up + whole_time(course, -1, bits)
    around = sum((found.values[0] for found in gained.values()), start=arb(0))
    frequency = around / period / turn
    place = reduced(ball_of(q), course.low, domain)
    side = -1 if ball_of(p) < course.profile.middle_momentum(place) else 1
    w = angle_of(course, domain, q, p, bits)
    since = _since(course, rate, place, side, gained[side].values[0], bits)
    if side < 0:
        since = around - since
    return frequency, (ball_of(start) - since) / turn + frequency * w * period


def _weighted(course: Course, rate: BallFunction, side: int) -> Any:
    """Ω dt/dq on a branch."""

    def integrand(q: Ball) -> tuple[Ball]:
        p, slowness = course.profile.outward(q, course.E, side)
        return (rate(q, p) * slowness,)

    return integrand


def _since(course: Course, rate: BallFunction, q: Ball, side: int, whole: Ball, bits: int) -> Ball:
    """∫ Ω dt from the lower end to q on a branch, taken from the nearer end."""
    integrand = _weighted(course, rate, side)
    if q - course.low < course.high - q:
        return panels(course, integrand, course.low, q, bits) if q > course.low else arb(0)
    return whole - panels(course, integrand, q, course.high, bits) if q < course.high else whole
