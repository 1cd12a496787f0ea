"""Sine and cosine as a few multiplications, which a compiler turns into vector instructions.

XLA calls a library for each sine of a double on a processor, one number after another, which takes longer than all the
rest of most maps. Here the argument is reduced by multiples of π/2 in three parts (Cody and Waite, Software Manual for
the Elementary Functions, 1980, chapter 8), and Taylor's series is summed for |r| ≤ π/4. The error stays below 3 units
of roundoff of the value; the argument must be smaller than `FAR`.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial
from typing import Any, Final

import numpy as np

FAR: Final = 1e6
"""Larger arguments are not reduced to all digits."""

_FIRST: Final = float.fromhex("0x1.921fb54400000p+0")
_SECOND: Final = float.fromhex("0x1.0b4611a600000p-34")
_THIRD: Final = float.fromhex("0x1.3198a2e037073p-69")
"""π/2 = first + second + third to 119 bits; products of the first two with integers below 2²⁰ are exact."""

_SINE: Final = [(-1) ** k / factorial(2 * k + 1) for k in range(1, 9)]
_COSINE: Final = [(-1) ** k / factorial(2 * k) for k in range(2, 10)]


class VectorSines:
    """A module of numerical functions, numpy or jax.numpy, whose `sin` and `cos` are these.

    `far` collects, for each argument that was given, at which points it was too large.
    """

    def __init__(self, numbers: Any) -> None:
        self._numbers = numbers
        self.far: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._numbers, name)

    def sin(self, x: Any) -> Any:
        """The sine of x."""
        quarter, sine, cosine = self._reduced(x)
        value = self._numbers.where(quarter & 1 == 1, cosine, sine)
        return self._numbers.where(quarter & 2 == 2, -value, value)

    def cos(self, x: Any) -> Any:
        """The cosine of x."""
        quarter, sine, cosine = self._reduced(x)
        value = self._numbers.where(quarter & 1 == 1, sine, cosine)
        return self._numbers.where((quarter + 1) & 2 == 2, -value, value)

    def _reduced(self, x: Any) -> tuple[Any, Any, Any]:
        """(k, sin r, cos r) where x = k π/2 + r with |r| ≤ π/4."""
        self.far.append(abs(x) > FAR)
        turns = self._numbers.rint(x * (2 / np.pi))
        r = ((x - turns * _FIRST) - turns * _SECOND) - turns * _THIRD
        square = r * r
        sine = r + r * square * _series(_SINE, square)
        cosine = 1 - (0.5 * square - square * square * _series(_COSINE, square))
        return turns.astype(np.int32), sine, cosine


def _series(coefficients: Sequence[float], x: Any) -> Any:
    value: Any = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        value = value * x + coefficient
    return value
