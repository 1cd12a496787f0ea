"""A transformation of phase space: new variables as functions of old ones, old of new, or implicit."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import sympy as sp

from canon.claim import Claim
from canon.display import latex
from canon.domain import Smoothness
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.formulas import Expression, as_formula, as_formulas, check_symbols, substituted
from canon.mechanics.given_maps import check_sides, listed_types
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.poisson import BracketMatrix, bracket_matrix, lagrange_matrix, standard_j
from canon.mechanics.subject import Subject

if TYPE_CHECKING:
    from canon.mechanics.generating_function import GeneratingFunction

Direction = Literal["forward", "backward", "implicit"]


@dataclass(frozen=True, init=False)
class Transformation:
    """(q, p) -> (Q, P), possibly with parameters and time.

    **Arguments:** the phase space, and one of

    - `Q`, `P`: the new variables as functions of the old ones (direction `forward`);
    - `q`, `p`: the old variables as functions of the new ones (`backward`);
    - `generating_function`: the map is defined by its equations alone (`implicit`).

    A variable of which nothing was said when the space was made is complex if its formula is: the transformation's own
    `space` has that symbol. A forward map may have fewer new pairs than old ones, as in the regularisation of
    Kustaanheimo and Stiefel.

    **Raises:** `InputError` when the counts do not fit, or a formula uses variables of the wrong side.
    """

    space: PhaseSpace
    Q: tuple[Formula, ...]
    P: tuple[Formula, ...]
    q: tuple[Formula, ...]
    p: tuple[Formula, ...]
    generating_function: "GeneratingFunction | None"

    def __init__(
        self,
        space: PhaseSpace,
        *,
        Q: Expression | Iterable[Expression] = (),
        P: Expression | Iterable[Expression] = (),
        q: Expression | Iterable[Expression] = (),
        p: Expression | Iterable[Expression] = (),
        generating_function: "GeneratingFunction | None" = None,
    ) -> None:
        check_space(space)
        smoothness = Smoothness()
        formulas = {
            name: as_formulas(value, f"transformation, {name}", smoothness)
            for name, value in zip("QPqp", (Q, P, q, p), strict=True)
        }
        given = [name for name in "QPqp" if formulas[name]]
        if given not in (["Q", "P"], ["q", "p"], []) or (not given and generating_function is None):
            raise InputError("a transformation is given by Q and P, or by q and p", "transformation")
        for name in given:
            check_sides(formulas[name], getattr(space, name), space, "Q" in given, f"transformation, {name}")
        pairs = [pair for name in given for pair in zip(getattr(space, name), formulas[name], strict=True)]
        imaginary = [x.name for x, formula in pairs if x.name in space.plain and smoothness.is_complex(formula.expr)]
        space = space.with_complex(imaginary) if imaginary else space
        if given != ["Q", "P"] and len(space.Q) != space.n:
            raise InputError("as many new pairs as old ones are needed here", "transformation")
        for name, value in {"space": space, **formulas, "generating_function": generating_function}.items():
            object.__setattr__(self, name, value)

    @property
    def direction(self) -> Direction:
        """`forward`, `backward` or `implicit`."""
        return "forward" if self.Q else "backward" if self.q else "implicit"

    @property
    def formulas(self) -> tuple[Formula, ...]:
        """(Q, P) of a forward map, (q, p) of a backward one; **raises** `InputError` for an implicit one."""
        if self.direction == "implicit":
            raise InputError("an implicit transformation has no formulas; ask for .explicit(), .forward(), .backward()")
        return self.Q + self.P if self.Q else self.q + self.p

    @property
    def expressions(self) -> tuple[sp.Expr, ...]:
        """The formulas' bare expressions."""
        return tuple(formula.expr for formula in self.formulas)

    @property
    def arguments(self) -> tuple[sp.Symbol, ...]:
        """The variables in which the formulas are written."""
        return self.space.old if self.direction == "forward" else self.space.new

    @property
    def targets(self) -> tuple[sp.Symbol, ...]:
        """The variables for which the formulas stand."""
        return self.space.new if self.direction == "forward" else self.space.old

    @property
    def mapping(self) -> dict[sp.Symbol, Formula]:
        """Each target with its formula."""
        return dict(zip(self.targets, self.formulas, strict=True))

    def jacobian(self) -> sp.ImmutableMatrix:
        """The derivatives of the formulas by their arguments: M = d(Q,P)/d(q,p) of a forward map, else its inverse."""
        return sp.ImmutableMatrix([[value.diff(x) for x in self.arguments] for value in self.expressions])

    def velocity(self) -> tuple[sp.Expr, ...]:
        """The partial derivatives of the formulas by time."""
        return tuple(value.diff(self.space.t) for value in self.expressions)

    def symplectic_residual(self, scale: Expression = 1) -> sp.ImmutableMatrix:
        """M J M^T - scale J of a forward map; A J A^T - J / scale of a backward one, with its Jacobian A = M^-1.

        It vanishes where the transformation is canonical with that scale (valence). Arnold (1989), section 44.
        """
        jacobian = self.jacobian()
        factor = as_formula(scale).expr
        expected = factor if self.direction == "forward" else 1 / factor
        product = jacobian * standard_j(jacobian.cols // 2) * jacobian.T
        return sp.ImmutableMatrix(product - expected * standard_j(jacobian.rows // 2))

    def poisson_brackets(self) -> BracketMatrix:
        """The brackets of the new variables in the old ones (of the old in the new ones, for a backward map)."""
        space = self.space if self.direction == "forward" else self.space.swapped()
        return bracket_matrix(self.formulas, space, [latex(target) for target in self.targets])

    def lagrange_brackets(self) -> BracketMatrix:
        """The Lagrange brackets of the arguments with respect to the targets."""
        pairs = len(self.targets) // 2
        return lagrange_matrix(self.arguments, self.expressions[:pairs], self.expressions[pairs:])

    def pull_back(self, f: Expression) -> Formula:
        """`f`, a function of the targets, as a function of the arguments."""
        formula = as_formula(f)
        check_symbols([formula], self.space.vocabulary)
        return substituted(formula, self.mapping)

    def inverse(self) -> "Transformation":
        """The inverse map (Q, P) -> (q, p). Nothing is solved: the roles of old and new change places."""
        space = self.space.swapped()
        if self.direction == "implicit":
            assert self.generating_function is not None
            return self.generating_function.inverse().transformation()
        return Transformation(space, Q=self.q, P=self.p, q=self.Q, p=self.P)

    def forward(self, branch: int = 0) -> "Transformation":
        """The same map with the new variables as explicit functions of the old ones, solved for where need be.

        **Raises:** `InputError` when no solution is found, or there is no branch of that number.
        """
        from canon.mechanics.explicit import explicit

        return explicit(self, "forward", branch)

    def backward(self, branch: int = 0) -> "Transformation":
        """The same map with the old variables as explicit functions of the new ones; as `forward` otherwise."""
        from canon.mechanics.explicit import explicit

        return explicit(self, "backward", branch)

    def after(self, first: "Transformation") -> "Transformation":
        """The composition: `first`, whose new variables are this one's old ones, and then this one."""
        from canon.mechanics.composition import compose

        return compose(first, self)

    def transformed(self, H: Expression, scale: Expression = 1) -> sp.Expr:
        """K in the new variables, up to a function of time: H with the old ones eliminated, and what time adds.

        **Raises:** `InputError` when explicit formulas or an integral are not found, or not right on all the domain.
        """
        from canon.mechanics.time_dependence import transformed_hamiltonian

        return transformed_hamiltonian(self, H, scale)

    def generating_function_of(self, type: int | Sequence[int]) -> "GeneratingFunction":  # noqa: A002
        """A generating function of this type of a canonical map, by integration, up to a function of time.

        **Raises:** `InputError` when none is found that is right throughout the domain, as for a map that isn't
        canonical: of such a one, `recovered` has what is left of dF. That it is one is a claim:
        `has_generating_function`.
        """
        from canon.mechanics.legendre_conversion import recovered, vanish
        from canon.mechanics.map_points import points_of

        found = recovered(self, type)
        if not vanish(found.residuals, points_of(self)):
            raise InputError("the map isn't canonical, so no function generates it: `recovered` tells by how much")
        return found.generating_function

    def subject(self, hamiltonian: Expression | None = None) -> Subject:
        """What claims about this transformation are about."""
        return Subject(
            space=self.space,
            hamiltonian=None if hamiltonian is None else as_formula(hamiltonian, "hamiltonian"),
            generating_function=self.generating_function,
            transformation=None if self.direction == "implicit" else self,
            domain=self.space.domain,
            functions=self.space.functions,
        )

    def canonical(self, scale: Expression = 1, *, order: tuple[sp.Symbol, int] | None = None) -> Claim:
        """Claims M J M^T = scale J; for a truncated map with `order = (eps, n)` up to terms of eps^(n+1)."""
        keys: dict[str, object] = {} if as_formula(scale).expr == 1 else {"scale": as_formula(scale)}
        return self.subject().claim("canonical", keys if order is None else keys | {"order": order})

    def canonical_when(self, *solutions: Mapping[sp.Symbol, Expression]) -> Claim:
        """Claims that the map is canonical at each of the solutions, and not at generic values of these parameters."""
        for table in solutions:
            if not isinstance(table, Mapping):
                raise InputError(f"a table parameter: value is expected, not {table!r}", "key 'solutions'")
        tables = tuple({name: as_formula(value) for name, value in table.items()} for table in solutions)
        return self.subject().claim("canonical_when", {"solutions": tables})

    def fundamental_brackets(self) -> Claim:
        """Claims {Q_i, Q_j} = {P_i, P_j} = 0 and {Q_i, P_j} = delta_ij."""
        return self.subject().claim("fundamental_brackets", {})

    def bracket_invariance(self, f: Expression, g: Expression) -> Claim:
        """Claims that {f, g}, with f and g in the new variables, is the same in either set of variables."""
        return self.subject().claim("bracket_invariance", {"f": as_formula(f), "g": as_formula(g)})

    def volume(self) -> Claim:
        """Claims |det M| = 1 (Liouville)."""
        return self.subject().claim("volume", {})

    def integral_invariant(self, order: int = 1) -> Claim:
        """Claims that Poincaré's integral invariant of this order is preserved."""
        return self.subject().claim("integral_invariant", {"order": order})

    def cartan_invariant(self, H: Expression, K: Expression) -> Claim:
        """Claims that p dq - H dt and P dQ - K dt differ by an exact form in extended phase space."""
        return self.subject(H).claim("cartan_invariant", {"K": as_formula(K)})

    def generated_by(self, F: "GeneratingFunction") -> Claim:
        """Claims that `F` generates this explicit transformation; **raises** `InputError` for an F of other names."""
        from canon.mechanics.generating_function import GeneratingFunction

        mine = self.subject()
        if not isinstance(F, GeneratingFunction):
            raise InputError(f"a GeneratingFunction is expected, not {F!r}")
        its, own = ([str(x) for x in (*space.old, *space.new)] for space in (F.space, mine.space))
        if its != own:
            raise InputError(f"F is one of {', '.join(its)}, and the transformation one of {', '.join(own)}")
        return Subject(
            space=mine.space,
            generating_function=F,
            transformation=mine.transformation,
            domain=mine.domain,
            functions=mine.functions,
        ).claim("generates", {})

    def has_generating_function(self, type: int | Sequence[int], F: Expression) -> Claim:  # noqa: A002
        """Claims that F is a generating function of this type of the map, up to a function of time."""
        return self.subject().claim("generating_function", {"type": listed_types(type), "F": as_formula(F)})

    def new_hamiltonian(self, H: Expression, K: Expression) -> Claim:
        """Claims that the map takes Hamilton's equations of H into those of K."""
        return self.subject(H).claim("new_hamiltonian", {"K": as_formula(K)})

    def action_angle(self, H: Expression, angle_period: Expression = 1) -> Claim:
        """Claims that the new variables are angles and actions of H: canonical, K of the momenta alone, angles that
        advance by the period once round their cycles."""
        return self.subject(H).claim("action_angle", {"angle_period": as_formula(angle_period, "angle_period")})

    def symmetry(self, H: Expression) -> Claim:
        """Claims that the map leaves H form-invariant."""
        return self.subject(H).claim("symmetry", {})

    def __repr__(self) -> str:
        return f"Transformation({self})"

    def __str__(self) -> str:
        """`Q = …, P = …`, or the generating function of an implicit map."""
        if self.direction == "implicit":
            return str(self.generating_function)
        return ", ".join(f"{x} = {f}" for x, f in zip(self.targets, self.expressions, strict=True))

    def _repr_latex_(self) -> str:
        if self.direction == "implicit":
            assert self.generating_function is not None
            return self.generating_function._repr_latex_()
        rows = [f"{latex(target)} &= {latex(value.expr)}" for target, value in self.mapping.items()]
        return "$\\begin{aligned} " + " \\\\ ".join(rows) + " \\end{aligned}$"
