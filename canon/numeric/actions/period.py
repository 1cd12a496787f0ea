"""The least period of a formula that holds a coordinate in sines and cosines alone; is a given one a period?"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import sympy as sp
from flint import arb

from canon.numeric.actions.balls import Ball, BallFunction, ball_function, precision

_TWICE = (sp.tan, sp.cot)
_CIRCULAR = (sp.sin, sp.cos, sp.tan, sp.cot, sp.sec, sp.csc)

_BITS: Final = 128
_PLACES: Final = 17
_MISSED: Final = 1e-9
"""So much of what H ranges over, the rounding of a period may change."""


def least_period(H: Any, q: sp.Symbol) -> Callable[[], Ball] | None:
    """The least common period of all circular functions of multiples of q, as a function of the precision.

    None where q stands anywhere else, or the multiples have no common measure.
    """
    rates = set[Any]()
    for part in H.atoms(*_CIRCULAR):
        rate = sp.diff(part.args[0], q)
        if q in rate.free_symbols:
            return None
        rates.add(sp.Abs(rate) * (2 if isinstance(part, _TWICE) else 1))
    rates.discard(sp.S.Zero)
    rest = H.replace(lambda part: isinstance(part, _CIRCULAR), lambda part: sp.Dummy())
    if not rates or q in rest.free_symbols:
        return None
    first = next(iter(rates))
    ratios = [sp.nsimplify(rate / first) if rate.is_Rational else sp.cancel(rate / first) for rate in rates]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    measure: Any = sp.gcd_list([sp.Rational(ratio) for ratio in ratios])
    return ball_function(_least(H, q, 2 * sp.pi / (first * measure)), ())


def _least(H: Any, q: sp.Symbol, period: Any) -> Any:
    """A period of H divided as often as it shows that it may be, as that of sin² by 2."""
    waves = sp.expand(H.rewrite(sp.exp)) if not H.has(*_TWICE, sp.sec, sp.csc) else H
    for n in (2, 3):
        while sp.expand(sp.expand(waves.xreplace({q: q + period / n}), complex=False) - waves) == 0:
            period = period / n
    return period


def seems_periodic(energy: BallFunction, period: Callable[[], Ball]) -> bool:
    """Whether H(q + T, p) is H(q, p) wherever it was looked at, up to what a T in double precision misses."""
    with precision(_BITS):
        T = period()
        places = [T * (k + arb(0.3)) / _PLACES for k in range(_PLACES)]
        for p in (arb(0), arb(1)):
            values = [(energy(q, p), energy(q + T, p)) for q in places]
            known = [(here, there) for here, there in values if here.is_finite() and there.is_finite()]
            spread = max((abs(here - known[0][0]) for here, _ in known), key=float, default=arb(0))
            if any(abs(there - here) > spread * _MISSED for here, there in known):
                return False
    return True
