"""Sign and order conventions of books, and translations between them.

This package computes in the convention of Goldstein. A convention never changes a formula silently: what is written in
another book's convention is translated by the functions here, and what they say is a definition, not a claim.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import sympy as sp

from canon.errors import InputError
from canon.expected import listed, one_of, shown, text, yes_or_no
from canon.mechanics.formulas import Expression, as_expression
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.poisson import check_functions, standard_j

Order = Literal["qp", "pq"]


@dataclass(frozen=True)
class Conventions:
    """How a book writes brackets, J and generating functions.

    - `bracket_sign`: {q, p}, +1 or -1.
    - `order`: whether phase-space vectors are (q, p) or (p, q); `time_first`: whether t stands before them.
    - `J_sign`: with the vector z in this order, dz/dt = `J_sign` [[0, 1], [-1, 0]] dH/dz.
    - `function_signs`: F of types 1 to 4 is this sign times the F of this package's equations.
    - `names`: what the book calls its generating functions, types 1 to 4; empty where it names none.
    """

    name: str
    bracket_sign: int = 1
    order: Order = "qp"
    time_first: bool = False
    J_sign: int = 1
    function_signs: tuple[int, int, int, int] = (1, 1, 1, 1)
    names: tuple[str, str, str, str] = ("F1", "F2", "F3", "F4")
    source: str = ""

    def __post_init__(self) -> None:
        functions = listed(self.function_signs, "signs", "function_signs")
        for sign in (self.bracket_sign, self.J_sign, *functions):
            if not isinstance(sign, int) or isinstance(sign, bool) or sign not in (1, -1):
                raise InputError(f"signs are +1 or -1, not {shown(sign)}", "conventions")
        names = listed(self.names, "names", "names")
        if len(functions) != 4 or len(names) != 4:
            raise InputError("four signs and four names are expected, of the types 1 to 4", "conventions")
        for said, where in (*((name, "names") for name in names), (self.name, "name"), (self.source, "source")):
            text(said, where)
        one_of(self.order, ("qp", "pq"), "order")
        yes_or_no(self.time_first, "time_first")
        if self.J_sign != (1 if self.order == "qp" else -1):
            raise InputError("with this J, Hamilton's equations would have the wrong sign", "conventions")

    def J(self, n: int) -> sp.ImmutableMatrix:
        """The matrix with dz/dt = J dH/dz for vectors z in this convention's order."""
        return sp.ImmutableMatrix(self.J_sign * standard_j(n))

    def variables(self, space: PhaseSpace) -> tuple[sp.Symbol, ...]:
        """The phase-space vector, with time in front where the convention puts it there."""
        check_space(space)
        pair = space.q + space.p if self.order == "qp" else space.p + space.q
        return ((space.t,) if self.time_first else ()) + pair

    def bracket(self, f: Expression, g: Expression, space: PhaseSpace) -> sp.Expr:
        """The Poisson bracket as this convention writes it, computed from its own definition.

        dz_f J dz_g with the gradients in the convention's order, times the sign that makes {q, p} = `bracket_sign`.
        """
        check_space(space)
        pair = space.q + space.p if self.order == "qp" else space.p + space.q
        values = [as_expression(value) for value in (f, g)]
        check_functions(values, space)
        left, right = ([value.diff(x) for x in pair] for value in values)
        J = self.J(space.n)
        return sp.Add(
            *(self.bracket_sign * left[i] * J[i, j] * right[j] for i in range(len(pair)) for j in range(len(pair)))
        )

    def evolution_sign(self) -> int:
        """s in df/dt = partial df/dt + s {f, H}."""
        return self.bracket_sign


GOLDSTEIN = Conventions(
    "Goldstein, Poole and Safko",
    source="Classical Mechanics, 3rd edition (2002): J in eq. 8.38a, F1 to F4 in table 9.1, brackets in eq. 9.67",
)
LANDAU_LIFSHITZ = Conventions(
    "Landau and Lifshitz",
    bracket_sign=-1,
    names=("F", "Φ", "", ""),
    source="Mechanics, 3rd edition (1976): [f, g] in eq. 42.5, [p, q] = 1 in 42.13; F(q, Q) in 45.7, Φ(q, P) in 45.8",
)
SICM = Conventions(
    "Sussman and Wisdom",
    time_first=True,
    source="Structure and Interpretation of Classical Mechanics, 2nd edition (2015): state (t, q, p), chapter 5",
)


def translated_bracket(value: Expression, origin: Conventions, target: Conventions) -> sp.Expr:
    """The bracket of the same two functions in another convention, from its value in the first."""
    return as_expression(value) * origin.bracket_sign * target.bracket_sign


def translated_iterated_bracket(value: Expression, depth: int, origin: Conventions, target: Conventions) -> sp.Expr:
    """The same for `depth` brackets inside each other: each brings its own sign."""
    return as_expression(value) * (origin.bracket_sign * target.bracket_sign) ** depth


def translated_matrix(matrix: sp.MatrixBase, origin: Conventions, target: Conventions) -> sp.ImmutableMatrix:
    """A matrix with a row and a column for each phase-space variable, with these put into the target's order.

    It serves Jacobians, Hessians, bilinear forms, and J itself: J of one convention becomes J of the other.

    **Raises:** `InputError` for a matrix that is not square of even size.
    """
    size = matrix.rows
    if size != matrix.cols or size % 2:
        raise InputError(f"a square matrix of even size is expected, not {matrix.rows} by {matrix.cols}")
    if origin.order == target.order:
        return sp.ImmutableMatrix(matrix)
    place = [*range(size // 2, size), *range(size // 2)]
    return sp.ImmutableMatrix(size, size, lambda i, j: matrix[place[int(i)], place[int(j)]])


def translated_vector(vector: Sequence[Expression], origin: Conventions, target: Conventions) -> tuple[sp.Expr, ...]:
    """A phase-space vector with the target's order; time, where the origin carries it, goes or stays with the target.

    **Raises:** `InputError` when the count is wrong, or the target wants a time that the origin does not carry.
    """
    values = [as_expression(value) for value in vector]
    if len(values) % 2 != int(origin.time_first):
        raise InputError(f"{len(values)} components do not make a state in the convention of {origin.name}")
    if target.time_first and not origin.time_first:
        raise InputError(f"the convention of {target.name} wants the time in front")
    time, pair = (values[:1], values[1:]) if origin.time_first else ([], values)
    half = len(pair) // 2
    if origin.order != target.order:
        pair = pair[half:] + pair[:half]
    return (*(time if target.time_first else ()), *pair)


def generating_function_in(F: GeneratingFunction, target: Conventions) -> sp.Expr:
    """F as the target's book writes it: F itself times the book's sign for its type.

    **Raises:** `InputError` for a mixed type with signs that differ among the degrees of freedom.
    """
    return F.F.expr * _sign(F.types, target)


def generating_function_from(
    space: PhaseSpace,
    type: int | Sequence[int],
    F: Expression,
    origin: Conventions,  # noqa: A002
) -> GeneratingFunction:
    """The generating function that the origin's book writes as `F`, in this package's convention."""
    types = (type,) * space.n if isinstance(type, int) else tuple(type)
    return GeneratingFunction(space, type, as_expression(F) * _sign(types, origin))


def _sign(types: Sequence[int], conventions: Conventions) -> int:
    signs = {conventions.function_signs[kind - 1] for kind in types}
    if len(signs) != 1:
        raise InputError(f"{conventions.name}: the signs of the types {tuple(types)} differ, so there is no one F")
    return signs.pop()
