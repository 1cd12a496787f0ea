"""The integral invariants of Poincaré, and that of Poincaré and Cartan."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.mechanics.formulas import Expression, as_expression, check_symbols, replaced
from canon.mechanics.one_form import exterior_derivative
from canon.mechanics.poisson import standard_j
from canon.mechanics.transformation import Transformation


def index_sets(n: int, order: int) -> Iterator[tuple[int, ...]]:
    """The sets of 2 `order` of the 2n variables, on which the components of the invariant's form are taken.

    **Raises:** `InputError` for an order that is not between 1 and n.
    """
    if not 1 <= order <= n:
        raise InputError(f"the order of an integral invariant is between 1 and {n}, not {order}", "order")
    return combinations(range(2 * n), 2 * order)


def pfaffian(matrix: Sequence[Sequence[Any]]) -> sp.Expr:
    """The Pfaffian of an antisymmetric matrix of even size, by expansion along the first row; 1 for the empty one."""
    size = len(matrix)
    if size == 0:
        return sp.S.One
    terms = []
    for column in range(1, size):
        if matrix[0][column] == 0:
            continue
        kept = [k for k in range(1, size) if k != column]
        minor = pfaffian([[matrix[i][j] for j in kept] for i in kept])
        terms.append((-1) ** (column + 1) * matrix[0][column] * minor)
    return sp.Add(*terms)


def minor_sum(transformation: Transformation, order: int, columns: Sequence[int]) -> sp.Expr:
    """One component of the pulled-back form: the sum of the minors d(Q_I, P_I)/d(x_A) over all sets I of `order` pairs.

    With the form sigma = sum dQ_i ^ dP_i it is the component on A = `columns` of sigma^order / order!, up to the sign
    (-1)^(order (order - 1) / 2) that sorts the Qs before the Ps. Arnold (1989), section 38.
    """
    jacobian = transformation.jacobian()
    pairs = jacobian.rows // 2
    chosen = (
        jacobian.extract([*rows, *(row + pairs for row in rows)], list(columns))
        for rows in combinations(range(pairs), order)
    )
    return sp.Add(*(minor.det(method="berkowitz") for minor in chosen))


def invariant_residuals(transformation: Transformation, order: int) -> Iterator[sp.Expr]:
    """The components of the pulled-back form of `order` less those of the form itself, one by one.

    The component on a set A of 2k variables is the Pfaffian of M^T J M restricted to A; that of the form itself is
    the Pfaffian of J restricted to A. Order 1 gives the entries of M^T J M - J, order n gives det M - 1.
    """
    jacobian = transformation.jacobian()
    n = jacobian.rows // 2
    if jacobian.cols != jacobian.rows:
        raise InputError("a square map is needed here")
    J = standard_j(n)
    form = jacobian.T * J * jacobian
    for chosen in index_sets(n, order):
        there, here = ([[matrix[i, j] for j in chosen] for i in chosen] for matrix in (form, J))
        yield pfaffian(there) - pfaffian(here)


def cartan_form(transformation: Transformation, H: Expression, K: Expression) -> tuple[sp.Expr, ...]:
    """The components of (p dq - H dt) - (P dQ - K dt) on the arguments of the map and t, in this order.

    Arnold (1989), section 45.
    """
    space = transformation.space
    arguments = (*transformation.arguments, space.t)
    given = {target: formula.expr for target, formula in transformation.mapping.items()}
    energies = [as_expression(value) for value in (H, K)]
    check_symbols(energies, transformation.space.vocabulary)
    energy, new_energy = (replaced(value, given) for value in energies)

    def differential(coordinate: sp.Expr, momentum: sp.Expr) -> list[sp.Expr]:
        return [momentum * coordinate.diff(x) for x in arguments]

    old = [differential(given.get(x, x), given.get(y, y)) for x, y in zip(space.q, space.p, strict=True)]
    new = [differential(given.get(x, x), given.get(y, y)) for x, y in zip(space.Q, space.P, strict=True)]
    parts = [sp.Add(*(row[k] for row in old), *(-row[k] for row in new)) for k in range(len(arguments))]
    parts[-1] += new_energy - energy
    return tuple(parts)


def cartan_residuals(transformation: Transformation, H: Expression, K: Expression) -> tuple[sp.Expr, ...]:
    """The exterior derivative of `cartan_form`: the form is closed exactly where all of these vanish."""
    arguments = (*transformation.arguments, transformation.space.t)
    return exterior_derivative(cartan_form(transformation, H, K), arguments)
