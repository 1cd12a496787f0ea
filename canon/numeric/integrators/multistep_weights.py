"""The weights of Störmer's methods: exact as fractions, and rounded so that they do no damping.

They alternate and grow as 2^k: their rounding would act as a force along the past, a damping, and rounded sums of them
drift. So they are rounded as differences, δ_m of Σ δ_m ∇^m, on a grid on which their sums are exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from math import comb
from typing import Final, NamedTuple

import numpy as np

GRID: Final = 2**44
"""The differences' coefficients are multiples of 1/GRID: so all β of up to thirteen terms are exact numbers."""


def differences(terms: int) -> tuple[list[Fraction], list[Fraction]]:
    """δ_m of Σ δ_m ∇^m a = (q_{n+1} − 2q_n + q_{n−1})/h², and φ_m of Σ φ_m ∇^m a = (q_n − q_{n−1})/h² − v_n/h.

    ∇ = 1 − e^{−hD} in e^{hD} − 2 + e^{−hD} over (hD)², and in 1 − e^{−hD} − hD over (hD)²: with L = −ln(1 − ∇) = hD,
    ∇²/(1 − ∇)/L² and (∇ − L)/L². Henrici (1962), Discrete Variable Methods, 6.1.
    """
    log = [Fraction(1, m + 1) for m in range(terms + 2)]  # L/∇
    square = [sum((log[i] * log[m - i] for i in range(m + 1)), Fraction(0)) for m in range(terms + 1)]
    inverse = [Fraction(1)]
    for m in range(1, terms + 1):
        inverse.append(-sum((square[i] * inverse[m - i] for i in range(1, m + 1)), Fraction(0)))
    delta = [sum(inverse[: m + 1], Fraction(0)) for m in range(terms)]
    phi = [-sum((log[i + 1] * inverse[m - i] for i in range(m + 1)), Fraction(0)) for m in range(terms)]
    return delta, phi


def weights(deltas: Sequence[Fraction]) -> np.ndarray:
    """The coefficients of a_{n−j} in Σ δ_m ∇^m a_n, of the δ_m."""
    count = len(deltas)
    rows = [sum(deltas[m] * comb(m, j) for m in range(j, count)) for j in range(count)]
    return np.array([float((-1) ** j * row) for j, row in enumerate(rows)])


class Sums(NamedTuple):
    """w_j and e_j: the kick is Σ w_j H_{n−j}, and π_n − p_n = h Σ e_j H_{n−j} of the forces H = F; with compensated
    sums, of their second differences, beside F_n and −F_n/2 + `slope` ∇F_n. `turned` has the w for each place of H_n.
    """

    kick: np.ndarray
    shown: np.ndarray
    slope: float
    turned: np.ndarray


@lru_cache(maxsize=16)
def sums_of(terms: int, compensated: bool) -> Sums:
    """The weights of so many forces, rounded as differences."""
    delta, phi = ([Fraction(round(x * GRID), GRID) for x in each] for each in differences(terms))
    skipped = 2 if compensated else 0
    kick, shown = weights(delta[skipped:]), weights(phi[skipped:])
    count = len(kick)
    turned = np.array([[kick[(place - j) % count] for j in range(count)] for place in range(count)])
    return Sums(kick, shown, float(phi[1]), turned)
