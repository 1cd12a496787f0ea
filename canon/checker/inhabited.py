"""Is there a point in the domain? One that was found in fifty digits is looked at in intervals.

Nothing at all holds in an empty domain, and everything does: a condition such as (10⁶⁰ − 2 − q²) − 10⁶⁰ + 1 > 0 is
true in fifty digits and nowhere else.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

from canon.checker.case import Case
from canon.checker.intervals import Intervals, Open
from canon.checker.points import domain_of
from canon.checker.statement import Statement
from canon.checker.witness import lies_inside, point_of

PRECISIONS = (60, 200)


def is_inhabited(s: Statement, case: Case, places: Iterable[Mapping[str, Any]], *, real: bool) -> bool:
    """Whether one of the places is seen, in intervals, to lie in the domain, or to be next to a point that does."""
    for of in places:
        exact = {n: (_exact(x.real), _exact(x.imag)) for n, x in of.items() if not isinstance(x, str)}
        exact = {n: x for n, x in exact.items() if n not in case.images}
        functions = {n: x for n, x in of.items() if isinstance(x, str)}
        for digits in PRECISIONS:
            own = Intervals(digits, real=real)
            own.signs = {n: words for n, words in s.words.items() if n in s.f.functions}
            try:
                point: dict[str, Any] = {**functions, **point_of(s, own, exact, functions)}
                for name, image in case.images.items():
                    point[name] = own.values(s.f, [image], point)[image]
                images = [s.pull(image) for image in s.images.values()]
                found = own.values(s.f, [*domain_of(s), *images, *(a for a, _ in s.conditions), *case.somewhere], point)
                there = all(own.real(found[a]).a > 0 for a in case.somewhere)
                if there and lies_inside(s, own, point, found):
                    return True
            except Open:
                continue
    return False


def _exact(x: Any) -> Fraction:
    """The rational number that a binary one is."""
    sign, mantissa, exponent, _ = x._mpf_
    return Fraction(-1 if sign else 1) * int(mantissa) * Fraction(2) ** exponent
