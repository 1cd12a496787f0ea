"""Birkhoff–Gustavson normal forms about an equilibrium, by Lie series with exact coefficients.

H = H₂ + H₃ + … is brought to H₂ + N₃ + … + N_k + O(k + 1) with {H₂, N_j} = 0 by the canonical maps exp{·, χ_j}, one
degree after the other (Birkhoff 1927; Gustavson, Astron. J. 71 (1966) 670; Lie series: Hori 1966, Dragt and Finn 1976).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from math import gcd
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import shown, whole_number
from canon.mechanics.formulas import Expression, as_expression
from canon.mechanics.graded_algebra import GradedAlgebra, Polynomial
from canon.mechanics.homological import split
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.poisson import check_functions
from canon.mechanics.taylor_polynomial import homogeneous_parts

Parts = dict[int, Polynomial]


class NoNormalForm(InputError, ValueError):
    """The linear flow of H₂ isn't semisimple, so that some terms are neither resonant nor removed."""


HIGHEST = 200
"""The highest order of a normal form: the number of its terms grows as a power of it."""


@dataclass(frozen=True)
class NormalForm:
    """H in normal form up to an order.

    **Arguments:** `order`; `parts`, H₂ and N₃ … by degree; `generators`, χ₃ … by degree (those that are 0 left out):
    H composed with exp{·, χ₃}, exp{·, χ₄}, … one after the other is the sum of the parts, up to that order.
    """

    algebra: GradedAlgebra
    order: int
    parts: Mapping[int, Polynomial]
    generators: Mapping[int, Polynomial]

    def term(self, degree: int) -> sp.Expr:
        """N of one degree, as a formula."""
        whole_number(degree, "degree")
        part = self.parts.get(degree)
        return sp.S.Zero if part is None else self.algebra.expression(part)

    def hamiltonian(self) -> sp.Expr:
        """H₂ + N₃ + … + N_order."""
        return sp.Add(*(self.term(degree) for degree in range(2, self.order + 1)))

    def generator(self, degree: int) -> sp.Expr:
        """χ of one degree, as a formula."""
        whole_number(degree, "degree")
        part = self.generators.get(degree)
        return sp.S.Zero if part is None else self.algebra.expression(part)

    def image(self, f: Polynomial, order: int | None = None) -> Parts:
        """f composed with the transformation: exp{·, χ_k} … exp{·, χ₃} f, up to an order.

        **Arguments:** `f`, a polynomial of `algebra`, such as one of its `generators`, or a formula that is one.
        """
        if order is not None:
            order = whole_number(order, "order", 0, HIGHEST)
        parts = self.algebra.parts(f if isinstance(f, type(self.algebra.one)) else self._polynomial(f))
        for degree in sorted(self.generators):
            parts = lie_transformed(self.algebra, parts, self.generators[degree], degree, order or self.order)
        return parts

    def _polynomial(self, f: Any) -> Polynomial:
        """A formula as a polynomial of the algebra. **Raises:** `InputError` where it is none."""
        expression, algebra = as_expression(f, "f"), self.algebra
        try:
            found = sp.Poly(expression, *algebra.variables).terms()
            return algebra.sum(algebra.monomial(e) * algebra.constant(c) for e, c in found)
        except (sp.PolynomialError, AttributeError, ValueError, TypeError):  # a coefficient outside of the field
            said = (
                f"a polynomial in {', '.join(map(str, algebra.variables))} with coefficients as those of H is expected"
            )
            raise InputError(f"{said}, not {shown(f)}", "f") from None

    def transformation(self) -> tuple[sp.Expr, ...]:
        """The old variables (q, p) as polynomials of degree order − 1 in the new ones, which bear the same names."""
        images = (self.image(x, self.order - 1) for x in self.algebra.generators)
        return tuple(sp.Add(*map(self.algebra.expression, parts.values())) for parts in images)

    def symplectic_defect(self) -> dict[int, list[Polynomial]]:
        """What {x_i, x_j} − J_ij of the truncated transformation has in each degree below order − 1: nothing, if it is
        symplectic order by order. Brackets of polynomials, computed anew."""
        algebra, n = self.algebra, self.algebra.n
        images = [algebra.sum(self.image(x, self.order - 1).values()) for x in algebra.generators]
        found: dict[int, list[Polynomial]] = {}
        for i in range(2 * n):
            for j in range(i + 1, 2 * n):
                defect = algebra.bracket(images[i], images[j]) - (algebra.one if j == i + n else algebra.zero)
                for degree, part in algebra.parts(defect).items():
                    if degree < self.order - 1 and part:
                        found.setdefault(degree, []).append(part)
        return found


def birkhoff_gustavson(space: PhaseSpace, H: Expression, order: int) -> NormalForm:
    """The normal form of H about the origin, up to an order, with generators in the image of {·, H₂}.

    **Arguments:** H, analytic at the origin, where it has an equilibrium; any H₂ with a semisimple linear flow.

    **Raises:** `InputError` where the origin is no equilibrium, H isn't analytic there, or has coefficients outside of
    exact arithmetic; `NoNormalForm`, which is one, where H₂ isn't semisimple.
    """
    check_space(space)
    order = whole_number(order, "order", 2, HIGHEST)
    energy = as_expression(H, "H")
    check_functions([energy], space)
    if energy.has(sp.Piecewise):
        raise InputError("a function given by cases has no series that is its own", "H")
    try:
        algebra, (parts,) = homogeneous_parts(energy, space.old, order)
    except ValueError as reason:
        raise InputError(f"this H can't be expanded exactly: {reason}", "H") from None
    return normalised(algebra, equilibrium(algebra, parts), order)


def equilibrium(algebra: GradedAlgebra, parts: Parts) -> Parts:
    """The parts of degree 2 and more; **raises** `InputError` for linear ones, and where H₂ is 0."""
    if parts.get(1, algebra.zero):
        raise InputError(f"the origin is no equilibrium of H: it has the linear part {algebra.expression(parts[1])}")
    if not parts.get(2, algebra.zero):
        raise InputError("H has no quadratic part at the origin")
    return {degree: part for degree, part in parts.items() if degree >= 2 and part}


def normalised(algebra: GradedAlgebra, parts: Parts, order: int) -> NormalForm:
    """The normal form of the sum of homogeneous parts."""
    H2, generators = parts[2], {}
    for degree in range(3, order + 1):
        found = split(algebra, H2, parts.get(degree, algebra.zero))
        if found is None:
            raise NoNormalForm(f"the terms of degree {degree} don't split: the linear flow isn't semisimple")
        chi = found[1]  # exp{., chi} adds {H2, chi} = -{chi, H2}
        if chi:
            generators[degree] = chi
            parts = lie_transformed(algebra, parts, chi, degree, order)
    return NormalForm(algebra, order, {d: f for d, f in parts.items() if f}, generators)


def resonances(space: PhaseSpace, H2: sp.Expr, order: int) -> list[tuple[int, ...]] | None:
    """The integer vectors k with k·ω = 0 and 3 ≤ Σ|k| ≤ order or Σ|k| = 2, one of each pair ±k, multiples left out.

    None where the degrees of freedom are coupled in H₂ or one of them doesn't oscillate: ω is read from each pair's
    (b p² + a q²)/2 as ±√(ab), with the sign of the energy.
    """
    frequencies = list[sp.Expr]()
    for x, y in zip(space.q, space.p, strict=True):
        a, b = H2.diff(x, 2), H2.diff(y, 2)
        if not (a * b).is_positive:
            return None
        frequencies.append(sp.sqrt(a * b) * (1 if b.is_positive else -1))
    diagonal = sum(H2.diff(z, 2) * z**2 / 2 for z in space.old)
    if sp.expand(H2 - diagonal) != 0:
        return None
    found = list[tuple[int, ...]]()
    for k in product(range(-order, order + 1), repeat=space.n):
        leading = next((c for c in k if c), 0)
        if leading > 0 and 2 <= sum(map(abs, k)) <= order and gcd(*k) == 1:
            if sp.expand(sum(c * w for c, w in zip(k, frequencies, strict=True))) == 0:
                found.append(k)
    return found


def exponential(algebra: GradedAlgebra, parts: Parts, chi: Polynomial, order: int) -> Parts:
    """exp{·, χ} of a sum of homogeneous parts up to an order; χ has terms of degree 3 and more."""
    pieces, out, term, k = algebra.parts(chi), dict(parts), dict(parts), 1
    while term:
        following: Parts = {}
        for i, f in term.items():
            for j, g in pieces.items():
                if i + j - 2 <= order:
                    change = algebra.bracket(f, g) * algebra.constant(sp.Rational(1, k))
                    following[i + j - 2] = following.get(i + j - 2, algebra.zero) + change
        term = {degree: f for degree, f in following.items() if f}
        for degree, f in term.items():
            out[degree] = out.get(degree, algebra.zero) + f
        k += 1
    return out


def lie_transformed(algebra: GradedAlgebra, parts: Parts, chi: Polynomial, degree: int, order: int) -> Parts:
    """exp{·, χ} of a sum of homogeneous parts up to an order, χ being homogeneous of this degree, at least 3."""
    out = dict(parts)
    for start, part in parts.items():
        term, k, at = part, 1, start + degree - 2
        while at <= order and term:
            term = algebra.bracket(term, chi) * (algebra.constant(sp.Rational(1, k)))
            out[at] = out.get(at, algebra.zero) + term
            k, at = k + 1, at + degree - 2
    return out
