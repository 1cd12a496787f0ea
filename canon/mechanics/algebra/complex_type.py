"""The type A_n … G_2 of a complex simple Lie algebra, from its dimension, its rank and the spectrum of one ad x."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import comb
from typing import Final

from flint import fmpq_mat

_DIMENSIONS: Final[dict[str, Callable[[int], int]]] = {
    "A": lambda n: n * (n + 2),
    "B": lambda n: n * (2 * n + 1),
    "C": lambda n: n * (2 * n + 1),
    "D": lambda n: n * (2 * n - 1),
}
_LOWEST: Final = {"A": 1, "B": 2, "C": 3, "D": 4}
_EXCEPTIONAL: Final = {("G", 2): 14, ("F", 4): 52, ("E", 6): 78, ("E", 7): 133, ("E", 8): 248}


@dataclass(frozen=True, slots=True, order=True)
class ComplexType:
    """Cartan's type: a letter and the rank. B_1 = C_1 = A_1, C_2 = B_2 and D_3 = A_3 are written A and B."""

    letter: str
    rank: int

    @property
    def dimension(self) -> int:
        """The complex dimension."""
        found = _EXCEPTIONAL.get((self.letter, self.rank))
        return found if found is not None else _DIMENSIONS[self.letter](self.rank)

    def __str__(self) -> str:
        return f"{self.letter}{self.rank}"


def complex_type(dimension: int, rank: int, ad: fmpq_mat | None) -> ComplexType:
    """The type of a complex simple algebra of this dimension and rank; `ad`, of a regular element, tells B from C.

    **Raises:** `ArithmeticError` where the dimension and rank leave several types and `ad` is missing or doesn't tell.
    """
    fitting = [
        ComplexType(letter, rank)
        for letter, lowest in _LOWEST.items()
        if rank >= lowest and _DIMENSIONS[letter](rank) == dimension
    ]
    fitting += [ComplexType(*key) for key, size in _EXCEPTIONAL.items() if key[1] == rank and size == dimension]
    if not fitting:
        raise ArithmeticError(f"no simple algebra has dimension {dimension} and rank {rank}")
    if len(fitting) > 1 and ad is not None:
        sums = _power_sums(ad, 2 * rank + 6)
        fitting = [kind for kind in fitting if _is_possible(kind, sums)] or fitting
    if len(fitting) > 1:
        names = " or ".join(str(kind) for kind in fitting)
        raise ArithmeticError(f"the complex type may be {names}")
    return fitting[0]


def _power_sums(ad: fmpq_mat, highest: int) -> list[Fraction]:
    """tr(ad x)^k for k = 2, 4, …, 2 * `highest`."""
    square = ad * ad
    power, found = square, []
    for _ in range(highest):
        trace = sum((power[k, k] for k in range(ad.nrows())), start=power[0, 0] * 0)
        found.append(Fraction(int(trace.p), int(trace.q)))
        power = power * square
    return found


def _is_possible(kind: ComplexType, sums: list[Fraction]) -> bool:
    """Whether power sums of the roots at a point fit the type: so(2n + 1), sp(2n), or E_6 of the same dimension.

    The adjoint of the first two is Λ² or S² of the defining module V. From t_m = tr_V X^(2m), of which the first n
    determine the others, tr_ad X^(2m) = (Σ_j C(2m, 2j) t_j t_(m−j) ∓ 4^m t_m) / 2. E_6 has no invariant of degree 4
    but the square of its Killing form: tr (ad x)^4 = (tr (ad x)²)² / 32.
    """
    if kind.letter == "E":
        return 32 * sums[1] == sums[0] ** 2
    n = kind.rank
    N, sign = (2 * n + 1, -1) if kind.letter == "B" else (2 * n, 1)
    t = [Fraction(N)]

    def mixed(m: int) -> Fraction:
        return sum((comb(2 * m, 2 * j) * t[j] * t[m - j] for j in range(1, m)), start=Fraction(0))

    for m in range(1, n + 1):
        t.append((2 * sums[m - 1] - mixed(m)) / (2 * N + sign * 4**m))
    elementary = [Fraction(1)]  # symmetric functions of the squares of the n weights, by Newton's identities
    for m in range(1, n + 1):
        total = sum(((-1) ** (j - 1) * elementary[m - j] * t[j] / 2 for j in range(1, m + 1)), start=Fraction(0))
        elementary.append(total / m)
    for m in range(n + 1, len(sums) + 1):
        t.append(sum(((-1) ** (j - 1) * elementary[j] * t[m - j] for j in range(1, n + 1)), start=Fraction(0)))
        if 2 * sums[m - 1] != mixed(m) + (2 * N + sign * 4**m) * t[m]:
            return False
    return True
