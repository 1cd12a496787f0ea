"""Refutations of actions whose value is a formula, beside `counterexample_orbits.py`: at a separatrix, and in |q|ⁿ.

What the action is has been seen for all values of the parameters (`alone_separatrices.py`, `alone_power_wells.py`). At
the witness, a point of the domain at which there is such an orbit, this formula and the claim's are enclosed, and
differ. Γ(x) = Γ(x + N)/x (x + 1) ⋯, and for x > 0, by Stirling's series,

    log Γ(x) = (x − 1/2) log x − x + log(2π)/2 + r,  1/12x − 1/360x³ < r < 1/12x.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone_power_wells, alone_separatrices
    from canon.checker.alone import Formula, Stop
    from canon.checker.counterexample import Arithmetic, Interval, Open, Point, check, somewhere
else:  # as a program's part, beside the other files
    import alone_power_wells  # type: ignore
    import alone_separatrices  # type: ignore
    from alone import Formula, Stop  # type: ignore
    from counterexample import Arithmetic, Interval, Open, Point, check, somewhere  # type: ignore

BITS, FAR, HALF = 192, 40, Fraction(1, 2)


class Valued(Point):
    """What formulas are at the witness, gamma functions as well."""

    def value(self, f: Formula) -> Interval:
        return gamma(self.at(f.of[0]), self.real) if f.kind == "gamma" else super().value(f)


def gamma(x: Interval, real: Arithmetic) -> Interval:
    """Γ where all of the interval is positive."""
    if x[0] <= 0:
        raise Open("gamma of what isn't positive")
    below = (Fraction(1), Fraction(1))
    while x[0] < FAR:
        below, x = real.times(below, x), real.add(x, (Fraction(1), Fraction(1)))
    log, inverse = real.monotone(real.log, x), real.power(x, -1)
    two_pi = real.monotone(real.log, (2 * real.pi[0], 2 * real.pi[1]))
    last = inverse[0] / 12 - inverse[1] ** 3 / 360, inverse[1] / 12
    total = real.times((x[0] - HALF, x[1] - HALF), log)
    total = total[0] - x[1] + two_pi[0] / 2 + last[0], total[1] - x[0] + two_pi[1] / 2 + last[1]
    return real.times(real.monotone(real.exp, real.held(*total)), real.power(below, -1))


def values(tables: Any) -> Iterator[tuple[Any, Formula, list[Formula]]]:
    """(the claim, its action, what is positive where there is an orbit)."""
    with suppress(Stop):
        well = alone_power_wells.Well(alone_power_wells.Beta(tables))
        yield well.motion, well.value, [well.room]
    for one in alone_separatrices.levels(alone_power_wells.Beta(tables)):
        yield one.motion, one.value, []


def at_witness(motion: Any, witness: Any) -> Valued:
    """The point, which lies in the domain. Raises Open."""
    point = Valued(motion, somewhere(motion, witness, 0), Arithmetic(BITS))
    for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in motion.domain.get("where", [])):
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            a, b = (a, b) if "<" in sign else (b, a)
            check(point.text(f"({b}) - ({a})"), ["nonzero" if sign == "!=" else "positive"])
    for name, words in motion.words.items():
        if "function" not in words and name not in (motion.q, motion.p):
            check(point.named(name), words)
    return point


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the claim fails at the witness."""
    if tables["claim"]["kind"] != "action" or not isinstance(witness, dict):
        raise Stop("not shown", "a refutation of such a claim")
    for motion, value, positive in values(tables):
        point = at_witness(motion, witness)
        for f in positive:
            check(point.at(f), ["positive"])
        action, claimed = point.at(value), point.text("_equals")
        if action[1] < claimed[0] or claimed[1] < action[0]:
            return "shown", ""
    return "not shown", "an action that is a formula and differs"
