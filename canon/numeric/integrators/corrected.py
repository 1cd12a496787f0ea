"""Processed methods: Störmer–Verlet between symplectic correctors, for H = A + εB with a small ε.

A step K is conjugated: P Kⁿ P⁻¹ costs what Kⁿ does, and P only where a state is shown. To first order in ε a step of
Verlet's is the flow of A + g(ad_A)B with g(x) = (x/2)/sinh(x/2), and a corrector of kicks between drifts by ±a_j h and
back takes −x Σ 2 b_j sinh(a_j x) from g: its b_j solve linear equations, which are solved here in rational numbers.
Wisdom, Holman and Touma (1996), Fields Inst. Commun. 10, 217; Wisdom (2006), Astron. J. 131, 2294.
"""

from __future__ import annotations

from fractions import Fraction
from math import comb, factorial
from typing import Final

from canon.numeric.integrators.splitting import SplittingMethod
from canon.numeric.integrators.traits import Traits


def corrected_verlet(points: int) -> SplittingMethod:
    """Verlet with a corrector of `points` pairs of kicks: an error ε h^(2·points + 2) + ε² h²."""
    places = [Fraction(j, 2) for j in range(1, points + 1)]
    kicks = _kicks(places)
    substeps: list[tuple[int, float]] = []
    for place, kick in zip(places, kicks, strict=True):
        for sign in (1, -1):
            substeps += [(0, sign * float(place)), (1, sign * float(kick)), (0, -sign * float(place))]
    return SplittingMethod(
        name=f"corrected_verlet{2 * points + 2}",
        traits=Traits(order=2, symplectic=True, symmetric=False, volume_preserving=True),
        a=(0.5, 0.5),
        b=(1.0,),
        source="Wisdom, Holman and Touma (1996), Fields Inst. Commun. 10, 217",
        processor=tuple(substeps),
        near_integrable=(2 * points + 2, 2),
    )


def _kicks(places: list[Fraction]) -> list[Fraction]:
    """b_j with Σ_j 2 b_j a_j^(2k+1)/(2k+1)! = minus the coefficient of x^(2k+2) in g, for as many k."""
    count = len(places)
    rows = [
        [2 * place ** (2 * k + 1) / factorial(2 * k + 1) for place in places] + [-_coefficient(2 * k + 2)]
        for k in range(count)
    ]
    for k in range(count):
        pivot = next(i for i in range(k, count) if rows[i][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [entry / rows[k][k] for entry in rows[k]]
        for i in range(count):
            if i != k:
                rows[i] = [entry - rows[i][k] * base for entry, base in zip(rows[i], rows[k], strict=True)]
    return [row[-1] for row in rows]


def _coefficient(n: int) -> Fraction:
    """The coefficient of x^n in (x/2)/sinh(x/2): B_n(1/2)/n!, Abramowitz and Stegun 23.1."""
    numbers: list[Fraction] = []
    for m in range(n + 1):
        rest = sum((comb(m + 1, k) * number for k, number in enumerate(numbers)), Fraction(0))
        numbers.append(-rest / (m + 1) if m else Fraction(1))
    return (Fraction(2, 2**n) - 1) * numbers[n] / factorial(n)


CORRECTED_VERLET_6: Final = corrected_verlet(2)
CORRECTED_VERLET_10: Final = corrected_verlet(4)
METHODS: Final = (CORRECTED_VERLET_6, CORRECTED_VERLET_10)
