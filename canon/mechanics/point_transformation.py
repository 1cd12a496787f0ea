"""Point transformations, lifted to the momenta."""

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp

from canon.display import latex
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.formulas import Expression, as_formula, as_formulas, check_symbols
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.one_form import tidy
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.transformation import Transformation


@dataclass(frozen=True, init=False)
class PointTransformation:
    """New coordinates as functions of old coordinates and time, or the other way round.

    **Arguments:** the space; `Q` in terms of q and t, or `q` in terms of Q and t; `shift`, a function G of the same
    coordinates and t, whose gradient is added to the momenta.

    The lift: with Q(q), p = (dQ/dq)^T P + dG/dq; with q(Q), P = (dq/dQ)^T p + dG/dQ. It is canonical for every such
    map and every G. Arnold (1989), section 48.

    **Raises:** `InputError` when the count is wrong, or a formula contains momenta.
    """

    space: PhaseSpace
    Q: tuple[Formula, ...]
    q: tuple[Formula, ...]
    shift: Formula

    def __init__(
        self,
        space: PhaseSpace,
        *,
        Q: Expression | Iterable[Expression] = (),
        q: Expression | Iterable[Expression] = (),
        shift: Expression = 0,
    ) -> None:
        check_space(space)
        forward, backward = as_formulas(Q, "Q"), as_formulas(q, "q")
        if bool(forward) == bool(backward):
            raise InputError("a point transformation is given by Q or by q", "point transformation")
        given = forward or backward
        if len(given) != space.n or len(space.Q) != space.n:
            raise InputError(f"{len(given)} formulas for {space.n} coordinates", "point transformation")
        gauge = as_formula(shift, "shift")
        check_symbols((*given, gauge), space.vocabulary, "point transformation")
        allowed = {*(space.q if forward else space.Q)}
        for formula in (*given, gauge):
            for symbol in sorted(formula.symbols & ({*space.old, *space.new} - allowed), key=str):
                raise InputError(f"{symbol} cannot occur in this point transformation", "point transformation")
        for name, value in (("space", space), ("Q", forward), ("q", backward), ("shift", gauge)):
            object.__setattr__(self, name, value)

    @property
    def coordinates(self) -> tuple[sp.Symbol, ...]:
        """The coordinates in which the formulas are written."""
        return self.space.q if self.Q else self.space.Q

    def jacobian(self) -> sp.ImmutableMatrix:
        """The derivatives of the given coordinates by those in which they are written."""
        return sp.ImmutableMatrix([[f.expr.diff(x) for x in self.coordinates] for f in self.Q or self.q])

    def lift(self) -> Transformation:
        """The canonical transformation with these coordinates: momenta by the transposed inverse of the Jacobian.

        **Raises:** `InputError` when the Jacobian is singular on the face of it.
        """
        space, gauge, jacobian = self.space, self.shift, self.jacobian()
        momenta = space.p if self.Q else space.P
        covector = sp.Matrix([y - gauge.expr.diff(x) for y, x in zip(momenta, self.coordinates, strict=True)])
        determinant = tidy(jacobian.det(method="berkowitz"))
        if determinant == 0:
            raise InputError("the coordinates are not independent", "point transformation")
        components = (jacobian.adjugate().T * covector) / determinant
        lifted = tuple(self._with_conditions(tidy(component)) for component in components)
        if self.Q:
            return Transformation(space, Q=self.Q, P=lifted)
        return Transformation(space, q=self.q, p=lifted)

    def _with_conditions(self, expression: sp.Expr) -> Formula:
        formula = as_formula(expression)
        own = tuple(dict.fromkeys((*formula.conditions, *self.shift.conditions)))
        return Formula(expression, own, formula.text)

    def generating_function(self) -> GeneratingFunction:
        """F2 = sum Q_i(q, t) P_i + G, or F3 = -sum q_i(Q, t) p_i - G: it needs no inverse of the Jacobian."""
        given, momenta, sign = (self.Q, self.space.P, 1) if self.Q else (self.q, self.space.p, -1)
        value = sp.Add(*(f.expr * y for f, y in zip(given, momenta, strict=True)), self.shift.expr)
        conditions = tuple(dict.fromkeys(c for f in (*given, self.shift) for c in f.conditions))
        return GeneratingFunction(self.space, 2 if self.Q else 3, Formula(sign * value, conditions, str(sign * value)))

    def _repr_latex_(self) -> str:
        names = self.space.Q if self.Q else self.space.q
        rows = [f"{latex(x)} &= {latex(f.expr)}" for x, f in zip(names, self.Q or self.q, strict=True)]
        return "$\\begin{aligned} " + " \\\\ ".join(rows) + " \\end{aligned}$"
