"""Is a polynomial N one of the normal forms of H? Linear algebra, degree by degree, decides it either way.

Up to an order the near-identity canonical maps are a unipotent group G with the Lie algebra of polynomials of degree
3 and more, acting linearly on polynomials. Let N agree with the H that has been transformed so far below degree m. The
maps of G that keep that agreement are the stabiliser of a vector, hence exp of its own Lie algebra, {·, κ} with {N, κ}
zero below degree m; and exp{·, κ} adds {N, κ} in degree m, since further brackets are of higher degree. So N is reached
if and only if what is missing in degree m is one of these, and the κ that fits brings the next degree. Where the linear
flow of H₂ is semisimple, κ may be taken from the kernel of {·, H₂}, once H is in a normal form itself: the lowest part
of a map between two normal forms commutes with H₂, and so on by induction.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import sympy as sp

from canon.mechanics.birkhoff import Parts, equilibrium, exponential, normalised
from canon.mechanics.graded_algebra import GradedAlgebra, Polynomial
from canon.mechanics.homological import Echelon, kernel, monomials, semisimple
from canon.mechanics.taylor_polynomial import homogeneous_parts

MOST_UNKNOWNS = 700
THEOREM = "near-identity canonical maps to an order are a unipotent group: what they reach is linear degree by degree"


@dataclass(frozen=True)
class Comparison:
    """Whether N is reached: the first degree at which it isn't, with the reason.

    **Arguments:** `parts`, of H transformed as far as it goes; `used`, every polynomial on whose coefficients the
    argument rests; `maps`, the generators of the maps that lead from H to N; `reachable`, where N isn't reached, a part
    of that degree that is.
    """

    algebra: GradedAlgebra
    parts: Parts
    fails_at: int | None = None
    reason: str = ""
    used: tuple[Polynomial, ...] = ()
    maps: tuple[str, ...] = ()
    reachable: Polynomial | None = None

    @property
    def holds(self) -> bool:
        """N is a normal form of H."""
        return self.fails_at is None


def compared(
    variables: Sequence[sp.Symbol], H: sp.Expr, N: Mapping[int, sp.Expr], order: int, check: Callable[[], None]
) -> Comparison:
    """Compares N, by degree (H₂ where degree 2 is left out), with H up to the order.

    **Raises:** `InputError` where the origin is no equilibrium; `ValueError` where the question is
    outside of exact arithmetic or too large; what `check`, called now and then, raises.
    """
    algebra, (parts, *given) = homogeneous_parts(H, variables, order, *N.values())
    parts = equilibrium(algebra, parts)
    claimed = {degree: f.get(degree, algebra.zero) for degree, f in zip(N, given, strict=True)}
    claimed.setdefault(2, parts[2])
    if claimed[2] - parts[2]:
        return Comparison(algebra, parts, 2, "the quadratic part of N is not that of H")
    for degree in sorted(claimed):
        if algebra.bracket(parts[2], claimed[degree]):
            return Comparison(algebra, parts, degree, f"{{H2, N{degree}}} is not 0")
    return _followed(_Search(algebra, parts, claimed, order, check))


@dataclass
class _Search:
    """H on its way to N."""

    algebra: GradedAlgebra
    parts: Parts
    claimed: Parts
    order: int
    check: Callable[[], None]
    normal: bool = False
    spaces: dict[int, list[Polynomial]] = field(default_factory=dict)

    def space(self, degree: int) -> list[Polynomial]:
        """The polynomials of a degree that κ may have: those that commute with H₂, once H is in normal form."""
        if degree not in self.spaces:
            self.check()
            every = monomials(self.algebra, degree)
            self.spaces[degree] = kernel(self.algebra, self.parts[2], every) if self.normal else every
        return self.spaces[degree]

    def missing(self, degree: int) -> Polynomial:
        return self.claimed.get(degree, self.algebra.zero) - self.parts.get(degree, self.algebra.zero)

    def correction(self, degree: int) -> Polynomial | None:
        """κ with {H, κ} zero below the degree and equal to what is missing in it; None where there is none."""
        algebra = self.algebra
        highest = degree - 1 if self.normal else degree
        candidates = [kappa for d in range(3, highest + 1) for kappa in self.space(d)]
        if len(candidates) > MOST_UNKNOWNS:
            raise ValueError(f"{len(candidates)} unknown coefficients, more than {MOST_UNKNOWNS}")
        echelon = Echelon(algebra)
        for kappa in candidates:
            self.check()
            images = exponential_slope(algebra, self.parts, kappa, degree)
            echelon.add(images, kappa)
        rest, kappa = echelon.reduced(self.missing(degree), algebra.zero)
        return -kappa if not rest else None


def _followed(search: _Search) -> Comparison:
    algebra, used, maps = search.algebra, list(search.claimed.values()), []
    if semisimple(algebra, search.parts[2]):
        found = normalised(algebra, search.parts, search.order)
        search.parts, search.normal = dict(found.parts), True
        used += [*found.parts.values(), *found.generators.values()]
        maps = [str(algebra.expression(chi)) for chi in found.generators.values()]
    for degree in range(3, search.order + 1):
        search.check()
        if not search.missing(degree):
            continue
        kappa = search.correction(degree)
        if kappa is None:
            reason = f"no near-identity canonical map leads from H to N in degree {degree}"
            return Comparison(algebra, search.parts, degree, reason, reachable=search.parts.get(degree, algebra.zero))
        search.parts = exponential(algebra, search.parts, kappa, search.order)
        if any(search.missing(d) for d in range(3, degree + 1)):
            raise ArithmeticError("the map that was found doesn't lead to N")
        used.append(kappa)
        maps.append(str(algebra.expression(kappa)))
    return Comparison(algebra, search.parts, used=tuple(used), maps=tuple(maps))


def exponential_slope(algebra: GradedAlgebra, parts: Parts, kappa: Polynomial, order: int) -> Polynomial:
    """{H, κ} up to an order, κ being homogeneous."""
    (degree,) = algebra.parts(kappa)
    return algebra.sum(algebra.bracket(f, kappa) for d, f in parts.items() if d + degree - 2 <= order)
