"""Whether there is an orbit for some values in a claim's domain, for `alone_actions.py`: in intervals of fractions.

Values are tried. Where Δ is seen to be negative, positive and negative again at places of the range, H having a value
there, there is an orbit between; on a folded line, or on the circle, one of these signs is enough.
"""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone, alone_orbits, counterexample
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_orbits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import counterexample  # type: ignore

RANDOM, U = alone.RANDOM, alone_orbits.U
SEARCHED, REAL = 500, counterexample.Arithmetic(128)
SIZES = [Fraction(n, 8) for n in (1, 2, 4, 6, 7, 8, 9, 12, 16, 24, 40, 64, 160)]


class Values(counterexample.Point):
    """What a claim's formulas are at a point, where elliptic integrals and gamma functions have values."""

    def value(self, f: Any) -> Any:
        if f.kind == "gamma":  # whose argument `alone_power_wells.py` sees to be positive
            counterexample.check(self.at(f.of[0]), ["positive"])
            return counterexample.ONE
        if f.kind not in alone_orbits.ELLIPTIC:
            return super().value(f)
        if any(self.at(x)[1] >= 1 for x in f.of):
            raise counterexample.Open("an elliptic integral's value")
        return counterexample.ONE


def is_somewhere(level: Any) -> bool:
    """Whether there is an orbit for some values in the domain, that are tried."""
    motion = level.motion
    names = sorted({*motion.words, *motion.names} | {motion.energy} - {*motion.texts})
    free = [n for n in names if n not in motion.texts and "function" not in motion.words.get(n, ())]
    for _ in range(SEARCHED):
        at = dict[str, Any]()
        for name in free:
            words, size = {*motion.words.get(name, ())}, RANDOM.choice(SIZES)
            sign = 1 if words & {"positive", "nonnegative"} else -1 if "negative" in words else RANDOM.choice((1, -1))
            at[name] = (sign * size,) * 2
        with suppress(counterexample.Open, ZeroDivisionError):
            if orbit(level, at):
                return True
    return False


def orbit(level: Any, at: dict[str, Any]) -> bool:
    """Whether Δ is negative, positive, and negative again at places of the range."""
    motion, real = level.motion, REAL
    point = counterexample.Point(motion, at, real)
    for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in motion.domain.get("where", [])):
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            a, b = (a, b) if "<" in sign else (b, a)
            counterexample.check(point.text(f"({b}) - ({a})"), ["nonzero" if sign == "!=" else "positive"])
    for name in motion.words:
        if name != motion.q and "function" not in motion.words[name]:
            counterexample.check(point.at(alone.Formula(".", (name,))), motion.words[name])
    Values(motion, at, real).text("_equals")
    asked = [of.times(level.delta, level.below)] + ([of.times(*level.allowed)] if level.allowed else [])
    series = [
        {k: point.at(level.flat.written(c)) for k, c in sorted(of.by_powers(p, U).items(), reverse=True)} for p in asked
    ]
    low, high = (None if end is None else point.at(end)[0] for end in (level.chart.low, level.chart.high))
    signs, first = list[int](), None
    for u in places(low, high):
        values = [value(c, u, real) for c in series]
        sign = 1 if all(low > 0 for low, _ in values) else -1 if any(high < 0 for _, high in values) else 0
        first = u if sign > 0 and first is None else first
        signs += [sign] if sign and signs[-1:] != [sign] else []
    if first is None or not re.search(level.pattern, "".join("+" if s > 0 else "-" for s in signs)):
        return False
    inside = {**at, U: (first, first), motion.p: (Fraction(0),) * 2}
    counterexample.Point(motion, inside, real).at(level.chart.put(motion.known("_H")))
    return True


def value(series: Any, u: Any, real: Any) -> Any:
    """The value of a polynomial."""
    total, last = counterexample.NONE, max(series)
    for k in range(last, -1, -1):
        total = real.add(real.times(total, (u, u)), series.get(k, counterexample.NONE))
    return total


def places(low: Any, high: Any) -> list[Any]:
    """Places in a range, from below."""
    out = [Fraction(2) ** (k // 4) * (4 + k % 4) / 4 for k in range(-24, 28)]
    if low is not None and high is not None:
        return [low + (high - low) * Fraction(k, 48) for k in range(1, 48)]
    if low is not None:
        return [low + x for x in out]
    if high is not None:
        return [high - x for x in reversed(out)]
    return [*(-x for x in reversed(out)), Fraction(0), *out]
