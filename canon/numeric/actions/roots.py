"""The zero of a function between two places where its signs differ: Newton's method, kept in by halving.

A zero of any odd multiplicity is found; at a multiple one it is the halving that does it, and the ball is as wide as
the function is too flat to tell.
"""

from __future__ import annotations

from collections.abc import Callable

import flint
from flint import arb

from canon.numeric.actions.balls import Ball, sign_of


def zero_between(
    function: Callable[[Ball], Ball],
    derivative: Callable[[Ball], Ball],
    low: Ball,
    high: Ball,
    *,
    at_low: int = 0,
    outside: int = 0,
) -> Ball:
    """A ball that holds the zero between `low` and `high`, to the working precision.

    `at_low` is the function's sign at `low`, where that isn't to be asked; `outside` the one that is meant where
    the function is not finite, as in the core of a potential.
    """

    def sign(x: Ball) -> int | None:
        value = function(x)
        return sign_of(value) if value.is_finite() else outside or None

    bits, first = flint.ctx.prec, at_low or sign(low)
    low, high = low.mid(), high.mid()
    root, close, step = ((low + high) / 2).mid(), high - low, high - low
    for _ in range(4 * bits):
        found = sign(root)
        if found == 0:
            return root
        close = arb(2) ** -bits * abs(root)
        if found is None or high - low <= 4 * close:
            break
        low, high = (root, high) if found == first else (low, root)
        target = root - function(root) / derivative(root)
        there = target.is_finite() and abs(target - root) < 4 * close
        if there and first and sign(root - 8 * close) == first and sign(root + 8 * close) == -first:
            break  # it came from one side, and the other end is far away still
        inside = target.is_finite() and bool(target > low) and bool(target < high)
        # steps of Newton's that don't shrink crawl along something steep or flat: halving is faster
        before, step = step, abs(target - root).mid() if inside else (high - low) / 2
        if inside and 2 * step < before:
            root = target.mid()
        else:
            root, step = ((low + high) / 2).mid(), (high - low) / 2
    close = close + arb(2) ** (-4 * bits)
    while close < high - low:
        below, above = sign(root - close), sign(root + close)
        if below == first and above is not None and above not in (0, first):
            break
        close = 4 * close
    return root + arb(0, close.upper())
