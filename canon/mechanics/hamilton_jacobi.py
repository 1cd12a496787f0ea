"""Complete integrals of the Hamilton–Jacobi equation, and what they are good for: the motion without integrating."""

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from canon.claim import Claim
from canon.display import latex
from canon.domain import Domain
from canon.errors import InputError
from canon.expected import instance_of, listed
from canon.expression import Formula
from canon.mechanics.formulas import Expression, as_formula, check_symbols, replaced
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.stated_names import as_declared, ordered_names
from canon.mechanics.subject import Subject
from canon.mechanics.transformation import Transformation


@dataclass(frozen=True, init=False)
class CompleteIntegral:
    """A claimed complete integral S(q, α, t) of H(q, ∂S/∂q, t) + ∂S/∂t = 0; with `energy`, W(q, α) of the reduced
    equation H(q, ∂W/∂q) = energy, of which S = W − energy · t is one.

    Goldstein, Poole and Safko (2002), sections 10.1 and 10.3.

    **Arguments:** the phase space; `H` of the old variables; `function`, S or W; `constants`, the n constants α, names
    of their own or new variables of the space; `energy`, an expression of the constants, for a W.

    **Raises:** `InputError` for another number of constants, and for functions of variables that are out of place.
    """

    space: PhaseSpace
    H: Formula
    function: Formula
    constants: tuple[sp.Symbol, ...]
    energy: Formula | None

    def __init__(
        self,
        space: PhaseSpace,
        H: Expression,
        function: Expression,
        constants: sp.Symbol | Sequence[sp.Symbol],
        energy: Expression | None = None,
    ) -> None:
        check_space(space)
        alphas = (constants,) if isinstance(constants, sp.Symbol) else listed(constants, "symbols", "constants")
        for alpha in alphas:
            instance_of(alpha, sp.Symbol, "constants")
        values = {
            "space": space,
            "H": as_formula(H, "hamiltonian, H"),
            "function": as_formula(function, "S"),
            "constants": alphas,
            "energy": None if energy is None else as_formula(energy, "energy"),
        }
        for name, value in values.items():
            object.__setattr__(self, name, value)
        check_symbols([self.H, self.function, *alphas, *([self.energy] if self.energy else [])], space.vocabulary, "S")
        if len(set(alphas)) != space.n:
            raise InputError(f"{space.n} constants are expected, each once, not {len(alphas)}", "constants")
        outside = {*space.old, *space.new, space.t} - {*space.q, *alphas, *([space.t] if energy is None else [])}
        for symbol in sorted(self.function.symbols & outside, key=str):
            raise InputError(f"S is a function of coordinates, constants and time, W without time, not of {symbol}")
        moving = {*space.old, *space.new, space.t} - {*alphas}
        for symbol in sorted(moving & (self.energy.symbols if self.energy else set()), key=str):
            raise InputError(f"the energy is a function of the constants, not of {symbol}", "energy")

    @property
    def S(self) -> sp.Expr:
        """S itself, for a W: W − energy · t."""
        if self.energy is None:
            return self.function.expr
        return self.function.expr - self.energy.expr * self.space.t

    def momenta(self) -> tuple[sp.Expr, ...]:
        """p = ∂S/∂q."""
        return tuple(self.function.expr.diff(x) for x in self.space.q)

    def residual(self) -> sp.Expr:
        """H(q, ∂S/∂q, t) + ∂S/∂t, which vanishes for a solution."""
        images = dict(zip(self.space.p, self.momenta(), strict=True))
        return replaced(self.H.expr, images) + self.S.diff(self.space.t)

    def hessian(self) -> sp.ImmutableMatrix:
        """∂²S/∂q∂α, whose determinant is not identically 0 where the integral is complete."""
        return sp.ImmutableMatrix([[p.diff(a) for a in self.constants] for p in self.momenta()])

    def constants_of_motion(self) -> tuple[sp.Expr, ...]:
        """β = ∂S/∂α: constant along the motion, by Jacobi's theorem."""
        return tuple(self.S.diff(a) for a in self.constants)

    def generating_function(self, names: str | Sequence[str]) -> GeneratingFunction:
        """S as a type-2 generating function to the constants (β, α), which leads to K = 0. `names` are those of β."""
        old = self.space
        betas = ordered_names(names)
        space = PhaseSpace(
            old.q,
            old.p,
            new=(betas, self.constants),
            time=old.t,
            **as_declared(s for s in old.parameters if s not in self.constants),
            functions=old.functions,
            domain=old.domain,
        )
        return GeneratingFunction(space, 2, Formula(self.S, self.function.conditions))

    def orbit(self, names: str | Sequence[str], branch: int = 0) -> Transformation:
        """q(α, β, t), p(α, β, t): β = ∂S/∂α solved for q, as a map whose `new_hamiltonian` is to be 0.

        Nothing is proved by it: state `orbit.new_hamiltonian(H, 0)` and have it verified.

        **Raises:** `InputError` where sympy doesn't solve the equations.
        """
        return self.generating_function(names).transformation().backward(branch)

    def complete(self) -> Claim:
        """Claims that this is a complete integral."""
        word = "S" if self.energy is None else "W"
        keys: dict[str, object] = {word: self.function, "constants": self.constants}
        if self.energy is not None:
            keys["energy"] = self.energy
        space = self.space
        domain = Domain(space.domain.conditions, space.domain.surface)
        return Subject(space, hamiltonian=self.H, domain=domain, functions=space.functions).claim(
            "hamilton_jacobi", keys
        )

    def _repr_latex_(self) -> str:
        name = "S" if self.energy is None else "W"
        return f"${name} = {latex(self.function.expr)}$"
