"""Double precision under mpmath's names, so that a reference's formula can be tried in it: the naive route.

Elliptic functions are scipy's, which jax brings along.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

from math import (  # isort: skip
    acos, acosh, asin, asinh, atan, atan2, atanh, cbrt, cos, cosh, exp, expm1, hypot, log, log1p, pi, sin, sinh, sqrt,
    tan, tanh,
)  # fmt: skip

__all__ = [
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "cot", "ellipe", "ellipf",
    "ellipfun", "ellipk", "exp", "expm1", "floor", "fsum", "hypot", "log", "log1p", "mpf", "pi", "quad", "sin", "sinh",
    "sqrt", "tan", "tanh",
]  # fmt: skip

mpf = float
fsum = math.fsum
floor = math.floor


def cot(x: float) -> float:
    """1/tan x."""
    return 1 / tan(x)


def ellipk(m: float) -> float:
    """K(m)."""
    from scipy import special

    return float(special.ellipk(m))


def ellipe(m: float) -> float:
    """E(m)."""
    from scipy import special

    return float(special.ellipe(m))


def ellipf(phi: float, m: float) -> float:
    """F(φ|m)."""
    from scipy import special

    return float(special.ellipkinc(phi, m))


def ellipfun(kind: str, u: float, m: float) -> float:
    """sn, cn or dn."""
    from scipy import special

    return float(special.ellipj(u, m)[["sn", "cn", "dn"].index(kind)])


def quad(f: Callable[[Any], Any], ends: Any, method: str = "") -> float:
    """∫f over consecutive intervals, by adaptive quadrature whatever the method."""
    from scipy.integrate import quad as adaptive

    return sum(adaptive(f, a, b, epsabs=0.0, epsrel=1e-13, limit=200)[0] for a, b in pairwise(ends))
