"""Frequencies of chains of masses and springs, each to all its digits, whatever the ratio of the springs.

In sums of springs such as k₀ + k₁ a soft one beside a stiff one is lost, and with it the slow frequencies: eigenvalues
of the matrix know them to a rounding of the largest. Here no two springs are added. Seen from one end, the chain up to
a mass answers like a spring Z − mω²; another one in series with it, and so on to the end. By Sylvester's law of inertia
as many frequencies are below ω as there are places at which that changes its sign past a spring; halving finds each.

Conditioning: a rounding of Z or Z − mω² is one of springs and masses, and since ω is a mean of them, Σ |∂ln ω/∂ln k| =
Σ |∂ln ω/∂ln m| = ½, relative errors of springs and masses are not amplified. What thousands of roundings add up to is
kept out by the machine's longest format in the last halvings. Parlett (1998), The Symmetric Eigenvalue Problem, 3.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from canon.errors import InputError
from canon.expected import numbers
from canon.numeric.precision import UNIT

Array = Any  # numpy arrays
STEPS: Final = 44
"""Halvings in double precision of an interval whose ends are within a factor of 2."""

LONG: Final = np.longdouble
SPREAD: Final = 64
"""Roundings, for each of the masses at most, by which these may be wrong."""

TINY: Final = 1e-300
"""In the place of a pivot that is 0: one more frequency is then not below."""


def chain_frequencies(masses: Sequence[float], springs: Sequence[float]) -> Array:
    """The angular frequencies (n,) of n masses in a row, rising.

    **Arguments:** `masses` (n,), positive; `springs` (n + 1,), not negative: the first and the last lead to walls, with
    0 for a free end.

    **Raises:** `InputError` for other numbers.
    """
    m, k = np.asarray(numbers(masses, "masses")), np.asarray(numbers(springs, "springs"))
    if m.ndim != 1 or not len(m) or k.shape != (len(m) + 1,):
        raise InputError(f"n masses and n + 1 springs are expected, not {m.shape} and {k.shape}", "springs")
    if not (np.all(m > 0) and np.all(k >= 0) and np.isfinite([*m, *k]).all()):
        raise InputError("masses are positive, springs are not negative, and all of them finite", "masses")
    return _halved(m, k)


def _halved(m: Array, k: Array) -> Array:
    """All frequencies at once: first to a factor of 2, then to the last bit. What is below 2^−500 of the highest is 0:
    a chain that is free at both ends can move as a whole.
    """
    count = len(m)
    top = 2 * float(np.sqrt(((k[:-1] + k[1:]) / m).max()))
    if top == 0:
        return np.zeros(count)
    wanted, least = np.arange(count), top * 2.0**-500
    low, high = np.full(count, np.log2(least)), np.full(count, np.log2(top))
    while np.any(high - low > 1):
        middle = (low + high) / 2
        beyond = _below(m, k, np.exp2(middle)) <= wanted
        low, high = np.where(beyond, middle, low), np.where(beyond, high, middle)
    a, b = np.exp2(low), np.exp2(high)
    for _ in range(STEPS):
        middle = (a + b) / 2
        beyond = _below(m, k, middle) <= wanted
        a, b = np.where(beyond, middle, a), np.where(beyond, b, middle)
    middle = (a + b) / 2
    wide = 2.0**-STEPS + SPREAD * count * UNIT
    a, b = LONG(middle) * (1 - LONG(wide)), LONG(middle) * (1 + LONG(wide))
    for _ in range(int(np.ceil(np.log2(wide / UNIT))) + 4):
        middle = (a + b) / 2
        beyond = _below(LONG(m), LONG(k), middle) <= wanted
        a, b = np.where(beyond, middle, a), np.where(beyond, b, middle)
    return np.where(b <= 4 * least, 0.0, ((a + b) / 2).astype(float))


def _below(m: Array, k: Array, omega: Array) -> Array:
    """How many frequencies are below each ω: the pivots of K − ω²M that are negative."""
    square, Z = omega * omega, np.full(len(omega), k[0], dtype=omega.dtype)
    negative = np.zeros(len(omega), dtype=int)
    for mass, spring in zip(m, k[1:], strict=True):
        Y = Z - mass * square
        pivot = Y + spring
        pivot[pivot == 0] = TINY
        negative += pivot < 0
        Z = spring * (Y / pivot)
    return negative
