"""The least period of a formula that holds a coordinate in sines and cosines alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from canon.numeric.actions.balls import Ball, ball_function

_CIRCULAR = (sp.sin, sp.cos, sp.tan, sp.cot, sp.sec, sp.csc)


def least_period(H: Any, q: sp.Symbol) -> Callable[[], Ball] | None:
    """The least common period of all circular functions of multiples of q, as a function of the precision.

    None where q stands anywhere else, or the multiples have no common measure. (That of tan and cot is taken as that
    of the sine.)
    """
    rates = set[Any]()
    for part in H.atoms(*_CIRCULAR):
        rate = sp.diff(part.args[0], q)
        if q in rate.free_symbols:
            return None
        rates.add(sp.Abs(rate))
    rates.discard(sp.S.Zero)
    rest = H.replace(lambda part: isinstance(part, _CIRCULAR), lambda part: sp.Dummy())
    if not rates or q in rest.free_symbols:
        return None
    first = next(iter(rates))
    ratios = [sp.nsimplify(rate / first) if rate.is_Rational else sp.cancel(rate / first) for rate in rates]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    measure: Any = sp.gcd_list([sp.Rational(ratio) for ratio in ratios])
    return ball_function(2 * sp.pi / (first * measure), ())
