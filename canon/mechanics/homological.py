"""The homological equation R = N + {χ, H₂} with {N, H₂} = 0, without eigenvectors, and linear algebra on polynomials.

On the polynomials of one degree ad = {·, H₂} is a linear map. The powers R, ad R, ad² R, … are dependent sooner or
later; where the first relation has 0 as a simple root at most, it splits R into a part in the kernel of ad and one in
its image. Nothing is diagonalised: frequencies may be real, imaginary, or expressions of parameters.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from canon.mechanics.graded_algebra import Exponents, GradedAlgebra, Polynomial, coefficient, terms


@dataclass
class Echelon:
    """Polynomials brought to echelon form, lowest degrees first, each with the combination that it is."""

    algebra: GradedAlgebra
    rows: list[tuple[Exponents, Polynomial, Any]] = field(default_factory=list)

    def reduced(self, vector: Polynomial, combination: Any) -> tuple[Polynomial, Any]:
        """The vector less multiples of rows, and its combination less the same ones."""
        for pivot, row, combined in self.rows:
            c = coefficient(vector, pivot)
            if c:
                vector, combination = vector - row * c, combination - combined * c
        return vector, combination

    def add(self, vector: Polynomial, combination: Any) -> Any | None:
        """Takes a vector in; one that depends on the rows is left out, and its combination, which is 0, returned."""
        vector, combination = self.reduced(vector, combination)
        if not vector:
            return combination
        pivot, c = min(terms(vector), key=lambda term: (sum(term[0]), term[0]))
        inverse = self.algebra.constant(1) / c
        self.rows.append((pivot, vector * inverse, combination * inverse))
        return None


def split(algebra: GradedAlgebra, H2: Polynomial, R: Polynomial) -> tuple[Polynomial, Polynomial] | None:
    """(N, χ) with R = N + {χ, H₂}, {N, H₂} = 0 and χ in the image of {·, H₂}; None where R doesn't split.

    Where H₂ has a semisimple linear flow, every R does.
    """
    if not R:
        return R, R
    c, powers = _relation(algebra, H2, R)
    if c[0]:
        return algebra.zero, algebra.sum(x * (-y / c[0]) for x, y in zip(powers, c[1:], strict=False))
    if not c[1]:
        return None
    N = algebra.sum(x * (y / c[1]) for x, y in zip(powers, c[1:], strict=False))
    chi = algebra.sum(x * (-y / c[1]) for x, y in zip(powers, c[2:], strict=False))
    return N, chi + N * (c[2] / c[1]) if len(c) > 2 else chi


def semisimple(algebra: GradedAlgebra, H2: Polynomial) -> bool:
    """Whether the linear flow of H₂ is diagonalisable over the complex numbers: no root of a relation is a double one.

    Then so is {·, H₂} on the polynomials of every degree.
    """
    t = sp.Dummy("t")
    for x in algebra.generators:
        relation = _relation(algebra, H2, x)[0]
        polynomial: Any = sp.Poly([algebra.value(c) for c in reversed(relation)], t)
        if polynomial.gcd(polynomial.diff(t)).degree() > 0:
            return False
    return True


def _relation(algebra: GradedAlgebra, H2: Polynomial, R: Polynomial) -> tuple[list[Any], list[Polynomial]]:
    """(c, powers) of the first relation Σ cₖ powers[k] = 0 between powers[k] = adᵏ R."""
    powers, echelon = [R], Echelon(algebra)
    t = algebra.generators[0]  # marks the powers of ad in a combination
    relation = echelon.add(R, algebra.one)
    while relation is None:
        powers.append(algebra.bracket(powers[-1], H2))
        relation = echelon.add(powers[-1], t ** (len(powers) - 1))
    rest = (0,) * (len(algebra.variables) - 1)
    return [coefficient(relation, (k, *rest)) for k in range(len(powers))], powers


def kernel(algebra: GradedAlgebra, H2: Polynomial, monomials: Iterable[Polynomial]) -> list[Polynomial]:
    """A basis of the polynomials in these monomials that commute with H₂."""
    echelon, found = Echelon(algebra), []
    for monomial in monomials:
        null = echelon.add(algebra.bracket(monomial, H2), monomial)
        if null is not None:
            found.append(null)
    return found


def monomials(algebra: GradedAlgebra, degree: int) -> list[Polynomial]:
    """All monomials of a degree."""

    def exponents(left: int, places: int) -> Iterable[Exponents]:
        if places == 1:
            yield (left,)
            return
        for first in range(left, -1, -1):
            yield from ((first, *rest) for rest in exponents(left - first, places - 1))

    return [algebra.monomial(e) for e in exponents(degree, len(algebra.variables))]
