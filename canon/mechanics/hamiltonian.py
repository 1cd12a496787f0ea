"""A Hamiltonian and its equations of motion."""

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from canon.claim import Claim
from canon.display import latex
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics import statements
from canon.mechanics.formulas import Expression, as_expression, as_formula, check_symbols
from canon.mechanics.one_form import Potential, exterior_derivative, potential
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.poisson import poisson_bracket


@dataclass(frozen=True, init=False)
class Hamiltonian:
    """H(q, p, t) on a phase space."""

    space: PhaseSpace
    H: Formula

    def __init__(self, space: PhaseSpace, H: Expression) -> None:
        check_space(space)
        object.__setattr__(self, "space", space)
        object.__setattr__(self, "H", as_formula(H, "hamiltonian, H"))
        check_symbols([self.H], space.vocabulary, "hamiltonian, H")
        for symbol in sorted(self.H.symbols & {*space.new}, key=str):
            raise InputError(f"H is a function of the old variables, not of {symbol}", "hamiltonian, H")

    def equations(self) -> tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]]:
        """Hamilton's equations: (qdot, pdot) = (dH/dp, -dH/dq). Goldstein, Poole and Safko (2002), eq. 8.18."""
        H = self.H.expr
        return tuple(H.diff(y) for y in self.space.p), tuple(-H.diff(x) for x in self.space.q)

    def rate(self, f: Expression) -> sp.Expr:
        """The rate of change of f along the motion: df/dt + {f, H}."""
        value = as_expression(f)
        check_symbols([value], self.space.vocabulary)
        return value.diff(self.space.t) + poisson_bracket(value, self.H, self.space)

    def conserved(self, f: Expression) -> Claim:
        """Claims that f is a constant of the motion."""
        return statements.conserved(self.space, self.H, f)

    def has_equations(self, qdot: Expression | Sequence[Expression], pdot: Expression | Sequence[Expression]) -> Claim:
        """Claims that these are Hamilton's equations of H."""
        return statements.equations_of_motion(self.space, self.H, qdot, pdot)

    def _repr_latex_(self) -> str:
        return f"$H = {latex(self.H.expr)}$"


def field_residuals(space: PhaseSpace, qdot: Sequence[Expression], pdot: Sequence[Expression]) -> tuple[sp.Expr, ...]:
    """The curl of (-pdot, qdot), which would be the gradient of H: zero where the field is locally Hamiltonian."""
    return exterior_derivative(_gradient(qdot, pdot), space.old)


def hamiltonian_of_field(space: PhaseSpace, qdot: Sequence[Expression], pdot: Sequence[Expression]) -> Potential | None:
    """H with qdot = dH/dp and pdot = -dH/dq, up to a function of time; `None` when an integral is not found."""
    return potential(_gradient(qdot, pdot), space.old)


def _gradient(qdot: Sequence[Expression], pdot: Sequence[Expression]) -> tuple[sp.Expr, ...]:
    return (*(-as_expression(y) for y in pdot), *(as_expression(x) for x in qdot))
