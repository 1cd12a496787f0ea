"""Direct and semidirect sums of Lie algebras."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from canon.errors import InputError
from canon.expected import instance_of, listed, table
from canon.mechanics.algebra.coefficients import Number, exact
from canon.mechanics.algebra.lie_algebra import LieAlgebra


def direct_sum(*algebras: LieAlgebra) -> LieAlgebra:
    """g₁ ⊕ g₂ ⊕ …: every bracket of elements of different summands is 0.

    The basis is that of the summands in turn; where a name occurs in several, all names get the number of their
    summand, as `x_1` and `x_2`.
    """
    for algebra in algebras:
        instance_of(algebra, LieAlgebra, "algebras")
    names = _distinct([algebra.names for algebra in algebras])
    constants: dict[tuple[int, int], dict[int, Number]] = {}
    start = 0
    for algebra in algebras:
        for (a, b), row in algebra.constants.items():
            constants[a + start, b + start] = {c + start: value for c, value in row.items()}
        start += algebra.dimension
    return LieAlgebra(names, constants)


def semidirect_sum(algebra: LieAlgebra, ideal: LieAlgebra, action: Mapping[str, Sequence[Sequence[Any]]]) -> LieAlgebra:
    """g ⋉ h with [x, y] = D(x) y for x in g, y in the ideal h; e(n) is so(n) ⋉ Rⁿ.

    **Arguments:** `action`, the matrix D(x) for each name x of the basis of g, whose column k is the image of the k-th
    basis element of h; names that are left out act by 0. `LieAlgebra(names, {})` is Rⁿ.

    **Raises:** `InputError` for a name that isn't of g, a matrix of another size, or where D isn't a homomorphism into
    the derivations of h: Jacobi's identity then fails, and the triple is named.
    """
    for name, given in (("algebra", algebra), ("ideal", ideal)):
        instance_of(given, LieAlgebra, name)
    table(action, "matrices", "action")
    n, size = algebra.dimension, ideal.dimension
    names = _distinct([algebra.names, ideal.names])
    constants: dict[tuple[int, int], dict[int, Any]] = {pair: dict(row) for pair, row in algebra.constants.items()}
    for (a, b), row in ideal.constants.items():
        constants[n + a, n + b] = {n + c: value for c, value in row.items()}
    for name, rows in action.items():
        a = algebra.position(name)
        place = f"the action of {name!r}"
        rows = [listed(row, "numbers", place) for row in listed(rows, "rows", place)]
        if len(rows) != size or any(len(row) != size for row in rows):
            raise InputError(f"a matrix of {size} rows and columns is expected", place)
        for k in range(size):
            constants[a, n + k] = {n + i: exact(rows[i][k]) for i in range(size) if rows[i][k] != 0}
    return LieAlgebra(names, constants)


def _distinct(groups: Sequence[Sequence[str]]) -> tuple[str, ...]:
    flat = tuple(name for group in groups for name in group)
    if len(set(flat)) == len(flat):
        return flat
    numbered = tuple(f"{name}_{k}" for k, group in enumerate(groups, 1) for name in group)
    return numbered if len(set(numbered)) == len(numbered) else tuple(f"e{k + 1}" for k in range(len(flat)))
