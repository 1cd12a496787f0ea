"""Algebras that are neither semisimple nor abelian, recognised by what characterises them.

Each criterion is necessary and sufficient, so that what isn't recognised here is none of them.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mat

from canon.mechanics.algebra import linear
from canon.mechanics.algebra.ideals import centre, derived
from canon.mechanics.algebra.identity import Core
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.algebra.semisimple import simple_ideals


def recognised(algebra: LieAlgebra, S: fmpq_mat, R: fmpq_mat) -> Core | None:
    """The name of an algebra with this Levi subalgebra, which acts faithfully on this radical; None: it has none."""
    if not S.nrows():
        return _solvable(algebra)
    r = R.nrows()
    if S.nrows() == r * (r - 1) // 2 and r >= 3 and _is_abelian(algebra, R):
        core = _orthogonal(algebra, S, R)
        if core is not None:
            return core
    return _galilean(algebra, S, R) if S.nrows() == 3 and r in (7, 8) else None


def conjugate_cores(algebra: LieAlgebra, count: int) -> Core | None:
    """The name of each of so many conjugate summands over R of what is no direct sum over Q; None: they may have none.

    Their dimensions are equal, which tells Heisenberg's algebras and that of the affine maps of the line.
    """
    n, products = algebra.dimension, derived(algebra)
    if n == 2 * count and products.nrows() == count:
        return Core("aff", (1,))
    if products.nrows() == count and centre(algebra) == products:
        return Core("heisenberg", ((n // count - 1) // 2,))
    return None


def action(algebra: LieAlgebra, x: list[fmpq], space: fmpq_mat) -> fmpq_mat:
    """ad x on an invariant subspace, in its rows as a basis (columns are images)."""
    return linear.coordinates(space, algebra.images(x, space)).transpose()


def _is_abelian(algebra: LieAlgebra, space: fmpq_mat) -> bool:
    return all(all(entry == 0 for entry in row) for row in algebra.products(space))


def _orthogonal(algebra: LieAlgebra, S: fmpq_mat, R: fmpq_mat) -> Core | None:
    """iso(p, q): S acts faithfully on R and keeps a nondegenerate symmetric form, so it is all of that form's so(p, q).

    For so(p, q) in three or more dimensions such a form is unique up to a factor.
    """
    forms = invariant_forms([action(algebra, x, R) for x in linear.rows(S)])
    if len(forms) != 1:
        return None
    positive, negative, zero = linear.signature(forms[0])
    return None if zero else Core("iso", (max(positive, negative), min(positive, negative)))


def invariant_forms(matrices: Sequence[fmpq_mat]) -> list[fmpq_mat]:
    """A basis of the symmetric forms g that the matrices keep: Xᵀ g + g X = 0."""
    r = matrices[0].nrows()
    pairs = [(i, j) for i in range(r) for j in range(i, r)]
    position = {pair: k for k, pair in enumerate(pairs)}
    equations = []
    for X in matrices:
        for i, j in pairs:
            row = [fmpq(0)] * len(pairs)
            for k in range(r):
                row[position[min(k, j), max(k, j)]] += X[k, i]
                row[position[min(i, k), max(i, k)]] += X[k, j]
            equations.append(row)
    found = []
    for values in linear.rows(linear.null_space(linear.matrix(equations, len(pairs)))):
        form = fmpq_mat(r, r)
        for (i, j), value in zip(pairs, values, strict=True):
            form[i, j] = form[j, i] = value
        found.append(form)
    return found


def _solvable(algebra: LieAlgebra) -> Core | None:
    n, products = algebra.dimension, derived(algebra)
    if n == 2 and products.nrows() == 1:
        return Core("aff", (1,))
    Z = centre(algebra)
    if products.nrows() == 1 and Z.nrows() == 1 and linear.contains(products, linear.rows(Z)[0]):
        return Core("heisenberg", ((n - 1) // 2,))  # a nondegenerate antisymmetric form on g/Z, by Darboux
    if n == 3 and products.nrows() == 2 and _is_abelian(algebra, products):
        (x,) = linear.rows(linear.complement(products, _all(n)))
        A = action(algebra, x, products)
        if A[0, 0] + A[1, 1] == 0:  # det A is not 0, since [g, g] is its image
            return Core("iso", (2, 0) if A.det() > 0 else (1, 1))
    return None


def _all(n: int) -> fmpq_mat:
    return linear.matrix([[fmpq(int(i == j)) for j in range(n)] for i in range(n)], n)


def _galilean(algebra: LieAlgebra, S: fmpq_mat, R: fmpq_mat) -> Core | None:
    """Galilei's algebra, and its extension by the mass.

    R = V ⊕ W under S = so(3): V twice the vector module, V = R³ ⊗ R², and W invariant. H in W acts on V as 1 ⊗ A with A
    nilpotent and not 0, and [V, V] is 0, or it is the centre and R³ ⊗ R² has the form δ ⊗ ω with ω nondegenerate.
    Levy-Leblond, in Group Theory and its Applications II (1971), 221.
    """
    inner = algebra.in_basis(S)
    (*others, ideal) = simple_ideals(inner)
    if others or ideal.is_complex or ideal.compact_dimension != 3:
        return None
    inverse = inner.killing_form().inv()
    generators = [action(algebra, x, R) for x in linear.rows(S)]
    r = R.nrows()
    casimir = fmpq_mat(r, r)  # 1 on the vector module as it is on the adjoint one
    for a in range(3):
        for b in range(3):
            casimir += generators[a] * generators[b] * inverse[a, b]
    W = linear.null_space(casimir) * R
    V = linear.null_space(casimir - _all(r)) * R
    if V.nrows() != 6 or W.nrows() != r - 6:
        return None
    products = linear.span(algebra.products(V), algebra.dimension)
    Z = centre(algebra)
    if r == 7 and products.nrows():
        return None
    if r == 8:
        rank = adapted_rank(algebra, V, products) if products.nrows() == 1 else 0
        if Z.nrows() != 1 or products != linear.span(linear.rows(Z), algebra.dimension) or rank != 6:
            return None
    outside = [w for w in linear.rows(W) if any(x != 0 for x in _flat(algebra.adjoint_of(w)))]
    if len(outside) < 1:
        return None
    A = action(algebra, outside[0], V)
    is_nilpotent = all(x == 0 for x in _flat(A * A))
    return Core("galilei" if r == 7 else "bargmann") if is_nilpotent and any(x != 0 for x in _flat(A)) else None


def adapted_rank(algebra: LieAlgebra, V: fmpq_mat, line: fmpq_mat) -> int:
    """The rank of the form on V that the bracket into a line defines."""
    (column,) = linear.pivots(line)
    rows = linear.rows(V)
    return linear.matrix(([algebra.product(a, b)[column] for b in rows] for a in rows), len(rows)).rank()


def _flat(values: fmpq_mat) -> list[fmpq]:
    return [entry for row in linear.rows(values) for entry in row]
