"""Integrals round orbits in intervals: of the orbits that may be meant at a point, or over a turn of the coordinate."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from canon.checker.enclosures import Enclosure, refined
from canon.checker.intervals import Intervals, Open
from canon.checker.momentum import Square
from canon.checker.orbits import Ends, Form, Momenta, Orbit
from canon.checker.points import Numbers, Outside
from canon.checker.statement import Statement

DIGITS, SOLVED = 12, 20
"""To so many digits an integral has to agree; in so many an orbit's ends are looked for."""


def enclosed_orbits(
    s: Statement, form: Form, own: Intervals, of: Mapping[str, Any], level: int, energy: Any, well: Any, turn: Any,
    *, rate: bool, bounded: bool = True, square: Square | None = None,
) -> Iterator[Sequence[Any]]:  # fmt: skip
    """Ever narrower intervals of the actions, or periods, of orbits: about the well, or over a turn. Raises Open."""
    numbers, rotates = Numbers(SOLVED), turn is not None
    point = {n: numbers.mp.mpf(v.mid) for n, v in of.items() if not isinstance(v, str)}
    momenta = Momenta(form, numbers, point, numbers.mp.mpf(energy.mid))
    ends = Ends(s, momenta, 1, Orbit(momenta, rate, DIGITS))
    ends.conditions = ends.conditions if bounded else []
    if square is not None:
        integrand, signs = square.integrand(s.f, form.x, rate=rate)
    else:
        integrand, signs = form.integrand(level, rate=rate, rotates=rotates)
    words = s.words.get(form.x, ()) if bounded else ()
    enclosure = Enclosure(own, of, integrand, [*ends.conditions, *signs], words)
    if rotates:
        yield from ([enclosure.over(turn, n)] for n in (24, 96, 384))
        return
    try:
        loops = ends.loops(numbers.mp.mpf(well.mid) if well is not None else None)
    except Outside:
        raise Open from None
    yield from zip(*(refined(enclosure, *map(Fraction, map(float, loop))) for loop in loops), strict=True)
