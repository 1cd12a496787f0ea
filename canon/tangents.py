"""The tangent of a sum with whole turns, which sympy 1.14 gets wrong: tan(x + nπ + π/2) becomes tan x for a whole n.

It looks whether tan(nπ + π/2) is infinite, doesn't see it, and concludes that it is 0. Such a tangent is the sine over
the cosine, of which sympy makes what is right. That has to be said to sympy's own class: any substitution, in whatever
library, makes its calls anew.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

_EVALUATED: Any = sp.tan.eval.__func__  # type: ignore[attr-defined]


def _eval(cls: Any, arg: Any) -> Any:
    if arg.is_Add and any(_is_whole_turns(term) for term in arg.args):
        return -cls(-arg) if arg.could_extract_minus_sign() else sp.sin(arg) / sp.cos(arg)
    return _EVALUATED(cls, arg)


def _is_whole_turns(term: Any) -> bool:
    """A multiple of π by a name, or names, of which sympy knows that it is rational."""
    turns = term.coeff(sp.pi)
    return bool(turns.free_symbols) and turns.is_rational is True


def kept_as_written() -> None:
    """Tell sympy; once for the program, when formulas are to be read."""
    sp.tan.eval = classmethod(_eval)  # type: ignore[method-assign]
