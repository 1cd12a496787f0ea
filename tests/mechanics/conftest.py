"""Zero by sampling: independent of the deciders, and good enough for formulas that are known to be right."""

from collections.abc import Callable, Iterable
from random import Random

import pytest
import sympy as sp


def _value(symbol: sp.Symbol, random: Random) -> sp.Expr:
    size = sp.Rational(random.randint(200, 900), 1000)
    return -size if symbol.is_negative else size


@pytest.fixture
def vanishes() -> Callable[..., bool]:
    """`vanishes(expressions)`: all of them are zero at three points of (0, 1)^n, to 30 digits."""

    def check(expressions: sp.Expr | Iterable[sp.Expr]) -> bool:
        single = isinstance(expressions, sp.Expr) and not getattr(expressions, "is_Matrix", False)
        listed = [expressions] if single else [*expressions]
        symbols = sorted({s for e in listed for s in sp.S(e).free_symbols}, key=str)
        for seed in range(3):
            random = Random(seed)
            point = {symbol: _value(symbol, random) for symbol in symbols}
            if any(abs(sp.S(e).xreplace(point).evalf(40)) > sp.Float("1e-30") for e in listed):
                return False
        return True

    return check
