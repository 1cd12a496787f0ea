"""Generating functions of types 1 to 4, and of types mixed by degree of freedom.

F depends, in each degree of freedom, on one old and one new variable, the mixed coordinates u. In these both (q, p) and
(Q, P) are explicit, so the map that F defines is studied without solving anything.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from canon.claim import Claim
from canon.display import latex
from canon.errors import InputError
from canon.expected import instance_of
from canon.expression import Formula
from canon.mechanics.formulas import Expression, as_formula, check_symbols
from canon.mechanics.given_maps import listed_types
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.subject import Subject
from canon.mechanics.transformation import Transformation
from canon.sign import is_complex

# Per type: does F depend on the old momentum (else the coordinate), and on the new momentum?
MOMENTA = {1: (False, False), 2: (False, True), 3: (True, False), 4: (True, True)}


@dataclass(frozen=True, init=False)
class GeneratingFunction:
    """F of a type, on a phase space with as many new pairs as old ones.

    Type 1, F(q, Q): p = dF/dq, P = -dF/dQ. Type 2, F(q, P): p = dF/dq, Q = dF/dP. Type 3, F(p, Q): q = -dF/dp,
    P = -dF/dQ. Type 4, F(p, P): q = -dF/dp, Q = dF/dP. In all of them K = H + dF/dt.
    Goldstein, Poole and Safko (2002), table 9.1.

    **Arguments:** the space; `type`, one for all degrees of freedom or one for each; `F`.

    **Raises:** `InputError` for a type that does not exist, or a variable of which F of this type does not depend.
    """

    space: PhaseSpace
    type: int | tuple[int, ...]
    F: Formula

    def __init__(self, space: PhaseSpace, type: int | Sequence[int], F: Expression) -> None:  # noqa: A002
        check_space(space)
        put = object.__setattr__
        put(self, "space", space)
        put(self, "type", listed_types(type))
        put(self, "F", as_formula(F, "generating_function, F"))
        if len(space.Q) != space.n:
            raise InputError("a generating function needs as many new pairs as old ones", "generating_function")
        if len(self.types) != space.n:
            raise InputError(f"{len(self.types)} types for {space.n} degrees of freedom", "generating_function, type")
        for kind in self.types:
            if kind not in MOMENTA:
                raise InputError(f"there is no type {kind!r}; types are 1, 2, 3 and 4", "generating_function, type")
        check_symbols([self.F], space.vocabulary, "generating_function, F")
        names = [x.name for x in (*space.old, *space.new)]
        if space.plain.issuperset(names) and is_complex(self.F.expr):
            raise InputError(
                f"F is complex, and nothing is said of its variables: say which are complex in the space, as in "
                f"complex={' '.join(names)!r}",
                "generating_function, F",
            )
        for symbol in sorted(self.F.symbols & {*self.old_conjugates, *self.new_conjugates}, key=str):
            raise InputError(
                f"F of type {self.type} is a function of {', '.join(map(str, self.mixed))}, not of {symbol}",
                "generating_function, F",
            )

    @property
    def types(self) -> tuple[int, ...]:
        """The type in each degree of freedom."""
        return (self.type,) * self.space.n if isinstance(self.type, int) else self.type

    def _choose(self, side: int, conjugate: bool) -> tuple[sp.Symbol, ...]:
        coordinates, momenta = (self.space.q, self.space.p) if side == 0 else (self.space.Q, self.space.P)
        return tuple(
            momenta[i] if MOMENTA[kind][side] != conjugate else coordinates[i] for i, kind in enumerate(self.types)
        )

    @property
    def old_arguments(self) -> tuple[sp.Symbol, ...]:
        """The old variable on which F depends, per degree of freedom: q or p."""
        return self._choose(0, False)

    @property
    def new_arguments(self) -> tuple[sp.Symbol, ...]:
        """The new variable on which F depends, per degree of freedom: Q or P."""
        return self._choose(1, False)

    @property
    def old_conjugates(self) -> tuple[sp.Symbol, ...]:
        """The old variable that F gives, per degree of freedom: p or q."""
        return self._choose(0, True)

    @property
    def new_conjugates(self) -> tuple[sp.Symbol, ...]:
        """The new variable that F gives, per degree of freedom: P or Q."""
        return self._choose(1, True)

    @property
    def mixed(self) -> tuple[sp.Symbol, ...]:
        """The mixed coordinates u: the old arguments, then the new ones."""
        return self.old_arguments + self.new_arguments

    def signs(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """The signs of dF/du in the equations: those for the old conjugates, and those for the new ones."""
        old = tuple(-1 if MOMENTA[kind][0] else 1 for kind in self.types)
        return old, tuple(1 if MOMENTA[kind][1] else -1 for kind in self.types)

    def conjugates(self) -> dict[sp.Symbol, sp.Expr]:
        """The equations that F states: each conjugate variable with its formula in u."""
        old, new = self.signs()
        F = self.F.expr
        names = self.old_conjugates + self.new_conjugates
        return {y: sign * F.diff(x) for y, sign, x in zip(names, (*old, *new), self.mixed, strict=True)}

    def old(self) -> tuple[sp.Expr, ...]:
        """(q, p) as functions of u."""
        given = self.conjugates()
        return tuple(given.get(variable, variable) for variable in self.space.old)

    def new(self) -> tuple[sp.Expr, ...]:
        """(Q, P) as functions of u."""
        given = self.conjugates()
        return tuple(given.get(variable, variable) for variable in self.space.new)

    def old_jacobian(self) -> sp.ImmutableMatrix:
        """D_old = d(q, p)/du; its determinant is, up to sign, that of the mixed Hessian."""
        return sp.ImmutableMatrix([[value.diff(u) for u in self.mixed] for value in self.old()])

    def new_jacobian(self) -> sp.ImmutableMatrix:
        """D_new = d(Q, P)/du. The map is symplectic exactly when D_new^T J D_new = D_old^T J D_old."""
        return sp.ImmutableMatrix([[value.diff(u) for u in self.mixed] for value in self.new()])

    def symplectic_residual(self) -> sp.ImmutableMatrix:
        """D_new^T J D_new - D_old^T J D_old, which vanishes for every F: nothing is solved."""
        J, old, new = self.space.J, self.old_jacobian(), self.new_jacobian()
        return sp.ImmutableMatrix(new.T * J * new - old.T * J * old)

    def mixed_hessian(self) -> sp.ImmutableMatrix:
        """The second derivatives of F by an old and a new argument. F defines a map where it is not singular."""
        F = self.F.expr
        return sp.ImmutableMatrix([[F.diff(x, y) for y in self.new_arguments] for x in self.old_arguments])

    def time_derivative(self) -> sp.Expr:
        """dF/dt at fixed u: what is added to H."""
        return self.F.expr.diff(self.space.t)

    def transformation(self) -> Transformation:
        """The transformation that F defines, left implicit: nothing is solved.

        Its `.forward()` and `.backward()` give formulas where sympy can solve for them.
        """
        return Transformation(self.space, generating_function=self)

    def converted(self, type: int | Sequence[int], branch: int = 0) -> "GeneratingFunction":  # noqa: A002
        """The generating function of another type of the same map, by Legendre transforms where the types differ.

        **Raises:** `InputError` when the equations cannot be solved for the arguments that change.
        """
        from canon.mechanics.legendre_conversion import converted

        return converted(self, type, branch)

    def inverse(self) -> "GeneratingFunction":
        """The generating function of the inverse map: -F, old and new exchanged (types 2 and 3 change places)."""
        turned = {1: 1, 2: 3, 3: 2, 4: 4}
        kinds = tuple(turned[kind] for kind in self.types)
        form = Formula(-self.F.expr, self.F.conditions, f"-({self.F})")
        return GeneratingFunction(self.space.swapped(), kinds[0] if isinstance(self.type, int) else kinds, form)

    def generates(self, transformation: Transformation) -> Claim:
        """Claims that F generates this explicit transformation."""
        instance_of(transformation, Transformation, "transformation")
        return transformation.generated_by(self)

    def subject(self) -> Subject:
        """What claims about F and its map are about."""
        return self.transformation().subject()

    def __repr__(self) -> str:
        return f"GeneratingFunction({self})"

    def __str__(self) -> str:
        """The type, the arguments and the formula."""
        name = self.types[0] if len(set(self.types)) == 1 else list(self.types)
        return f"type {name}: F({', '.join(map(str, self.mixed))}) = {self.F.expr}"

    def _repr_latex_(self) -> str:
        kinds = "".join(map(str, self.types)) if not isinstance(self.type, int) else str(self.type)
        arguments = ", ".join(latex(u) for u in self.mixed)
        rows = [f"F_{{{kinds}}}({arguments}) &= {latex(self.F.expr)}"]
        rows += [f"{latex(y)} &= {latex(value)}" for y, value in self.conjugates().items()]
        return "$\\begin{aligned} " + " \\\\ ".join(rows) + " \\end{aligned}$"
