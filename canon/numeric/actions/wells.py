"""In which branch a point of the coordinate lies."""

from __future__ import annotations

from flint import arb

from canon.numeric.actions.balls import Ball
from canon.numeric.actions.branches import Branch, place_of
from canon.numeric.actions.landscape import Interval


def reduced(q: Ball, low: Ball, domain: Interval) -> Ball:
    """q less the whole number of periods that brings it to low ≤ q < low + period."""
    if domain.period is None:
        return q
    period = domain.period()
    return q - period * ((q - low) / period).mid().floor()


def holds(branch: Branch, q: Ball, domain: Interval) -> bool:
    """Whether a point lies between the critical points that bound the branch."""
    if branch.ends is None:
        return True
    left, right = branch.ends
    low, high = (place_of(end.outer, end.shift[1], domain) for end in (left, right))
    # where a branch leads out of the domain, it holds all there is beyond its last critical point
    low = arb.neg_inf() if left.outer is left.inner else low
    high = arb.pos_inf() if right.outer is right.inner else high
    if domain.period is not None:
        q = reduced(q, low, domain)
    return not q < low and not q > high
