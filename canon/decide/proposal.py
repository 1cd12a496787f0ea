"""Random coordinates: values of a name that satisfy what is assumed of it, and its own bounds."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from fractions import Fraction
from typing import Final

Coordinate = Fraction | tuple[Fraction, Fraction]
"""An exact real coordinate, or the real and the imaginary part of a complex one."""

NICE: Final = [Fraction(n, d) for d in (1, 2, 3, 4, 5) for n in range(1, 12) if math.gcd(n, d) == 1]
"""Fractions that people like to read in a witness."""


def proposed(
    facts: Mapping[str, bool],
    bounds: tuple[float, float],
    rng: random.Random,
    *,
    nice: bool,
    effort: int,
    seen_positive: bool | None,
) -> Coordinate:
    """A random value of one name.

    **Arguments:** `facts`, what is assumed of it; `bounds`, open; `nice`, a fraction that is easy to read; `effort`,
    the number of the attempt: every third takes a wider range of sizes; `seen_positive`, the sign of the name at a
    point found before, whose opposite is then preferred.

    **Returns:** a fraction within the bounds, a whole one where facts ask for it; a pair of them for a complex name.
    """
    if facts.get("integer"):
        return _integer(facts, bounds, rng, effort)
    low, high = bounds
    if facts.get("nonnegative"):
        low = max(low, 0.0)
    if facts.get("nonpositive"):
        high = min(high, 0.0)
    size = rng.choice(NICE) if nice else Fraction(rng.randrange(1, 400), rng.randrange(97, 211))
    if effort % 3 == 2:
        size *= Fraction(rng.choice((1, 2, 3, 5, 8, 40)), rng.choice((1, 2, 4, 7, 16, 300)))
    if not facts.get("real"):
        other = rng.choice(NICE) if nice else Fraction(rng.randrange(-400, 400), rng.randrange(97, 211))
        return (size if rng.getrandbits(1) else -size, other)
    if low > -math.inf and high < math.inf:
        return _between(low, high, rng)
    if low > -math.inf:
        return Fraction(low).limit_denominator(64) + size
    if high < math.inf:
        return Fraction(high).limit_denominator(64) - size
    opposite = seen_positive is not None and rng.random() < 0.8
    positive = not seen_positive if opposite else bool(rng.getrandbits(1))
    return size if positive else -size


def _integer(facts: Mapping[str, bool], bounds: tuple[float, float], rng: random.Random, effort: int) -> Fraction:
    """A random whole number within the assumptions and the bounds; now and then 0, where nothing bounds it."""
    low, high = bounds
    if facts.get("nonnegative"):
        low = max(low, 0.0 if facts.get("positive") else -1.0)
    if facts.get("nonpositive"):
        high = min(high, 0.0 if facts.get("negative") else 1.0)
    step = rng.randrange(1, 9)
    if low > -math.inf:
        value = math.floor(low) + step
        value = min(value, math.ceil(high) - 1) if high < math.inf else value
    elif high < math.inf:
        value = math.ceil(high) - step
    else:
        value = step if rng.getrandbits(1) else -step
        if effort % 3 == 2 and step > 6 and facts.get("zero") is not False:
            value = 0
    if facts.get("even") or facts.get("odd"):
        value += (value + bool(facts.get("odd"))) % 2
    return Fraction(value)


def _between(low: float, high: float, rng: random.Random) -> Fraction:
    """A value between the bounds, now and then near one of them."""
    if not low < high:
        return Fraction(low).limit_denominator(1000)
    width = high - low
    near = rng.random() < 0.25
    t = 10.0 ** -rng.uniform(0.5, 4) if near else rng.uniform(0.08, 0.92)
    value = low + t * width if rng.getrandbits(1) else high - t * width
    return Fraction(value).limit_denominator(math.ceil((1e6 if near else 8) / width) + 10)
