"""Stäckel's theorem, constructively: the functions wᵢ(uᵢ) with V = Σ wᵢ(uᵢ)/hᵢ², without an integral.

H = Σ pᵢ²/2hᵢ² + V separates in orthogonal coordinates with a Stäckel matrix S if and only if V has that form (Stäckel
1893; Goldstein, Poole and Safko 2002, section 10.4). The wᵢ are fixed up to columns of S, so that all but the first may
be taken to vanish at a base point: then V along each coordinate line through it gives one of them after the other, and
whether V is their sum everywhere is the question of separability, an identity. With it
pᵢ² = 2 (Σⱼ Sᵢⱼ(uᵢ) αⱼ − wᵢ(uᵢ)) with α₁ = E.
"""

from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import instance_of
from canon.mechanics.formulas import Expression, as_expression, replaced
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.poisson import check_functions
from canon.mechanics.separation.coordinates import OrthogonalCoordinates

_SHORT = 60


@dataclass(frozen=True)
class Separation:
    """An attempt at separating H = (Σ p²)/2m + V in coordinates.

    **Arguments:** `mass`; `potential`, m V in the coordinates; `parts`, the wᵢ.
    """

    coordinates: OrthogonalCoordinates
    mass: Any
    potential: Any
    parts: tuple[Any, ...]

    def residual(self) -> sp.Expr:
        """m V − Σ wᵢ/hᵢ²: identically 0 if and only if the Hamilton–Jacobi equation separates."""
        total = sp.Add(*(w / h for w, h in zip(self.parts, self.coordinates.squares, strict=True)))
        return self.potential - total

    def constants(self) -> tuple[sp.Symbol, ...]:
        """The separation constants: the energy E, and α₂, …"""
        names = ["E", *(f"alpha_{j}" for j in range(2, len(self.parts) + 1))]
        return tuple(sp.Symbol(name, real=True) for name in names)

    def momentum_squares(self) -> tuple[Any, ...]:
        """pᵢ² as functions of uᵢ and the constants, one for each coordinate."""
        E, *rest = self.constants()
        alphas = sp.Matrix([self.mass * E, *rest])
        rows = self.coordinates.staeckel * alphas
        return tuple(2 * (rows[i] - w) for i, w in enumerate(self.parts))

    def equation(self) -> sp.Expr:
        """H(u, ∂W/∂u) − E with these pᵢ²: 0 where the residual is."""
        E = self.constants()[0]
        kinetic = (s / h for s, h in zip(self.momentum_squares(), self.coordinates.squares, strict=True))
        return (sp.Add(*kinetic) / 2 + self.potential) / self.mass - E


def separation(space: PhaseSpace, H: Expression, coordinates: OrthogonalCoordinates) -> Separation:
    """The parts of the potential along the coordinate lines of a base point.

    **Arguments:** a phase space of Cartesian coordinates; H = (Σ p²)/2m + V(q).

    **Raises:** `InputError` for another kinetic energy, a number of degrees of freedom that isn't that of the
    coordinates, or a potential that isn't defined on the lines through the base points.
    """
    check_space(space)
    instance_of(coordinates, OrthogonalCoordinates, "coordinates")
    expression: Any = as_expression(H, "H")
    check_functions([expression], space, "H")
    n = space.n
    if len(coordinates.u) != n:
        raise InputError(f"{coordinates.name} coordinates here are {len(coordinates.u)}, the degrees of freedom {n}")
    inverse_mass = expression.diff(space.p[0], 2)
    potential = replaced(expression, dict.fromkeys(space.p, sp.S.Zero))
    kinetic = inverse_mass * sum(y**2 for y in space.p) / 2
    moving = {*space.old, space.t}
    if inverse_mass.free_symbols & moving or inverse_mass == 0 or sp.expand(expression - potential - kinetic) != 0:
        raise InputError("an H of the form (sum of p**2)/(2*m) + V(q) in Cartesian coordinates is expected")
    if space.t in potential.free_symbols:
        raise InputError(f"the potential depends on {space.t}")
    taken = {s.name for s in expression.free_symbols - moving} & {u.name for u in coordinates.u}
    if taken:
        raise InputError(f"{', '.join(sorted(taken))} is a coordinate of the new system and a parameter of H")
    mass = 1 / inverse_mass
    there = mass * replaced(potential, dict(zip(space.q, coordinates.cartesian, strict=True)))
    for base in coordinates.bases:
        parts = _parts(there, coordinates, base)
        if parts is not None:
            return Separation(coordinates, mass, there, parts)
    raise InputError(f"the potential isn't defined on the lines of {coordinates.name} coordinates that were tried")


def _shorter(w: Any) -> Any:
    """Squares found under roots, and waves summed up: whether it was right to, the residual says."""
    if sp.count_ops(w) > _SHORT:
        return w
    rooted = w.replace(_is_root, lambda e: sp.factor(e.base) ** e.exp)
    return sp.trigsimp(rooted) if rooted.atoms(sp.sin, sp.cos, sp.sinh, sp.cosh) else sp.expand(sp.cancel(rooted))


def _is_root(e: Any) -> bool:
    rational = isinstance(e, sp.Pow) and isinstance(e.exp, sp.Rational) and e.exp.q == 2
    return rational and bool(e.base.is_polynomial(*e.free_symbols))


def _parts(potential: Any, coordinates: OrthogonalCoordinates, base: tuple[Any, ...]) -> tuple[Any, ...] | None:
    """w₁, then w₂, … from V along the lines through the base, with wᵢ = 0 at the base but for the first."""
    u, squares = coordinates.u, coordinates.squares
    found: list[Any] = []
    for i in range(len(u)):
        line = {x: c for k, (x, c) in enumerate(zip(u, base, strict=True)) if k != i}
        rest = potential.xreplace(line)
        for j, w in enumerate(found):
            rest = rest - w.xreplace({u[j]: base[j]}) / squares[j].xreplace(line)
        w = sp.expand(rest * squares[i].xreplace(line), trig=False)
        if w.has(sp.zoo, sp.nan, sp.oo):
            return None
        found.append(_shorter(w))
    return tuple(found)
