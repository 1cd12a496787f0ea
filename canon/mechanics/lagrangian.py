"""A Lagrangian and its Legendre transform, in both directions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.claim import Claim
from canon.display import latex
from canon.errors import InputError
from canon.expected import instance_of, listed, whole_number
from canon.expression import Formula
from canon.mechanics import statements
from canon.mechanics.formulas import Expression, as_expression, as_formula, check_symbols, replaced
from canon.mechanics.hamiltonian import Hamiltonian
from canon.mechanics.map_points import agree
from canon.mechanics.one_form import tidy
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.solution_points import real_value, sample_points
from canon.mechanics.solving import branches


@dataclass(frozen=True, init=False)
class Lagrangian:
    """L(q, v, t) with velocities v, in the order of the coordinates.

    **Raises:** `InputError` when there are not as many velocities as coordinates, or for an L of momenta.
    """

    space: PhaseSpace
    L: Formula
    velocities: tuple[sp.Symbol, ...]

    def __init__(self, space: PhaseSpace, L: Expression, velocities: sp.Symbol | Sequence[sp.Symbol]) -> None:
        check_space(space)
        names = _velocities(space, velocities)
        L = as_formula(L, "L")
        check_symbols([L], space.vocabulary, "L")
        for symbol in sorted(L.symbols & set(space.p), key=str):
            raise InputError(f"L is a function of coordinates and velocities, not of {symbol}", "L")
        object.__setattr__(self, "space", space)
        object.__setattr__(self, "L", L)
        object.__setattr__(self, "velocities", names)

    def momenta(self) -> tuple[sp.Expr, ...]:
        """p = dL/dv, in (q, v, t)."""
        return tuple(self.L.expr.diff(v) for v in self.velocities)

    def hessian(self) -> sp.ImmutableMatrix:
        """d2L/dv dv: L is regular where this is not singular."""
        momenta = self.momenta()
        return sp.ImmutableMatrix([[momentum.diff(v) for v in self.velocities] for momentum in momenta])

    def energy(self) -> sp.Expr:
        """v dL/dv - L in (q, v, t): the value of H before the velocities are eliminated."""
        terms = (v * momentum for v, momentum in zip(self.velocities, self.momenta(), strict=True))
        return sp.Add(*terms) - self.L.expr

    def legendre_residual(self, H: Expression) -> sp.Expr:
        """H(q, dL/dv, t) - (v dL/dv - L), which vanishes when H is the Legendre transform."""
        at = dict(zip(self.space.p, self.momenta(), strict=True))
        return replaced(as_expression(H), at) - self.energy()

    def hamiltonian(self, branch: int | None = None) -> Hamiltonian:
        """The Legendre transform, with p = dL/dv solved for the velocities.

        Of several solutions that is taken with which H is right at all sample points of the space's domain at which it
        has a value; or the one with the number `branch`.

        **Raises:** `InputError` when no solution is found, as for a singular Lagrangian, or none that is right
        throughout.
        """
        equations = dict(zip(self.space.p, self.momenta(), strict=True))
        H = _transformed(equations, self.velocities, self.energy(), self.space, branch, "p = dL/dv", "L")
        return Hamiltonian(self.space, H)

    def legendre(self, H: Expression) -> Claim:
        """Claims that H is the Legendre transform of this Lagrangian, and that it is regular."""
        return statements.legendre(self.space, H, self.L, self.velocities)

    def _repr_latex_(self) -> str:
        return f"$L = {latex(self.L.expr)}$"


def _velocities(space: PhaseSpace, given: Any) -> tuple[sp.Symbol, ...]:
    """The velocities, one for each coordinate. **Raises** `InputError` for what are none."""
    names = (given,) if isinstance(given, sp.Symbol) else listed(given, "symbols", "velocities")
    for name in names:
        instance_of(name, sp.Symbol, "velocities")
        if name in (*space.old, *space.new, space.t):
            raise InputError(f"{name} is a variable of the phase space: a velocity has a name of its own", "velocities")
    if len(names) != space.n or len({*names}) < len(names):
        raise InputError(f"{len({*names})} velocities for {space.n} coordinates", "velocities")
    return names


def lagrangian_of(
    hamiltonian: Hamiltonian, velocities: sp.Symbol | Sequence[sp.Symbol], branch: int | None = None
) -> Lagrangian:
    """The inverse transform: L = p v - H with v = dH/dp solved for the momenta; of several solutions as `hamiltonian`.

    **Raises:** `InputError` when no solution is found, or none that is right throughout the domain.
    """
    space = hamiltonian.space
    names = _velocities(space, velocities)
    qdot, _ = hamiltonian.equations()
    energy = sp.Add(*(v * p for v, p in zip(names, space.p, strict=True))) - hamiltonian.H.expr
    equations = dict(zip(names, qdot, strict=True))
    return Lagrangian(space, _transformed(equations, space.p, energy, space, branch, "v = dH/dp", "H"), names)


def _transformed(
    equations: Mapping[sp.Symbol, sp.Expr],
    unknowns: Sequence[sp.Symbol],
    value: sp.Expr,
    space: PhaseSpace,
    branch: int | None,
    called: str,
    where: str,
) -> sp.Expr:
    """A value with the unknowns eliminated: by the solution that is right wherever it has one, or by that number."""
    if branch is not None:
        whole_number(branch, "branch", 0)
    within = space.domain.conditions
    found = branches(equations, unknowns, within=within)
    if len(found) <= (branch or 0):
        raise InputError(f"{called} was not solved for {', '.join(map(str, unknowns))}", where)
    forms = [tidy(replaced(value, solution)) for solution in found]
    if branch is not None:
        return forms[branch]
    points = list(sample_points(equations, unknowns, {}, within))
    for form in forms:
        if all(agree(real_value(form, point), real_value(value, point)) for point in points):
            return form
    raise InputError(
        f"{called} has several solutions, and none is right throughout the domain: "
        f"{' or '.join(str(solution) for solution in found)}; restrict the domain, as by space.where('p > 0'), say of "
        "which sign the names are, or choose a branch by its number",
        where,
    )
