"""The least period of a formula that holds a coordinate in sines and cosines alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from canon.numeric.actions.balls import Ball, ball_function

_TWICE = (sp.tan, sp.cot)
_CIRCULAR = (sp.sin, sp.cos, sp.tan, sp.cot, sp.sec, sp.csc)


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
