"""Centre, series of ideals, radical and quotients of a Lie algebra with rational structure constants.

Subspaces are matrices whose rows are a basis (`canon.mechanics.algebra.linear`).
"""

from __future__ import annotations

from flint import fmpq, fmpq_mat

from canon.mechanics.algebra import linear
from canon.mechanics.algebra.lie_algebra import LieAlgebra


def whole(algebra: LieAlgebra) -> fmpq_mat:
    """The algebra itself as a subspace."""
    n = algebra.dimension
    return linear.matrix([[fmpq(int(i == j)) for j in range(n)] for i in range(n)], n)


def commutator(algebra: LieAlgebra, a: fmpq_mat, b: fmpq_mat) -> fmpq_mat:
    """[A, B]: the span of all brackets of elements of two subspaces."""
    return linear.span(
        (image for x in linear.rows(a) for image in linear.rows(algebra.images(x, b))),
        algebra.dimension,
    )


def derived(algebra: LieAlgebra) -> fmpq_mat:
    """[g, g]."""
    n = algebra.dimension
    vectors = []
    for row in algebra.constants.values():
        vector = [fmpq(0)] * n
        for c, value in row.items():
            vector[c] = linear.rational(value)  # pyright: ignore[reportArgumentType]
        vectors.append(vector)
    return linear.span(vectors, n)


def derived_series(algebra: LieAlgebra) -> tuple[fmpq_mat, ...]:
    """g, [g, g], [[g, g], [g, g]], … until it stays the same; the last has dimension 0 where g is solvable."""
    return series_of(algebra, whole(algebra))


def series_of(algebra: LieAlgebra, ideal: fmpq_mat) -> tuple[fmpq_mat, ...]:
    """The derived series of an ideal."""
    found = [ideal]
    while True:
        following = commutator(algebra, found[-1], found[-1])
        if following.nrows() == found[-1].nrows():
            return tuple(found)
        found.append(following)


def lower_central_series(algebra: LieAlgebra) -> tuple[fmpq_mat, ...]:
    """g, [g, g], [g, [g, g]], … until it stays the same; the last has dimension 0 where g is nilpotent."""
    found = [whole(algebra)]
    while True:
        following = commutator(algebra, found[0], found[-1])
        if following.nrows() == found[-1].nrows():
            return tuple(found)
        found.append(following)


def centraliser(algebra: LieAlgebra, space: fmpq_mat) -> fmpq_mat:
    """All x with [x, y] = 0 for every y of the subspace."""
    n = algebra.dimension
    equations: list[list[fmpq]] = []
    for y in linear.rows(space):
        equations += linear.rows(algebra.adjoint_of(y))
    return linear.null_space(linear.matrix(equations, n)) if equations else whole(algebra)


def centre(algebra: LieAlgebra) -> fmpq_mat:
    """All x that commute with everything."""
    return centraliser(algebra, whole(algebra))


def radical(algebra: LieAlgebra) -> fmpq_mat:
    """The largest solvable ideal: all x with K(x, [g, g]) = 0 (Cartan; Jacobson, Lie Algebras, 1962, III.4)."""
    products = derived(algebra)
    if not products.nrows():
        return whole(algebra)
    return linear.null_space(products * algebra.killing_form())


def quotient(algebra: LieAlgebra, ideal: fmpq_mat) -> LieAlgebra:
    """g modulo an ideal, in the basis elements of g that complete the ideal to a basis."""
    n = algebra.dimension
    rest = linear.complement(ideal, whole(algebra))
    full = linear.matrix([*linear.rows(rest), *linear.rows(ideal)], n)
    adapted = algebra.in_basis(full)
    kept = rest.nrows()
    constants = {
        pair: {c: value for c, value in row.items() if c < kept}
        for pair, row in adapted.constants.items()
        if max(pair) < kept
    }
    return LieAlgebra(adapted.names[:kept], constants)


def is_ideal(algebra: LieAlgebra, space: fmpq_mat) -> bool:
    """Whether the bracket of anything with an element of the subspace lies in it."""
    return all(linear.contains(space, v) for v in linear.rows(commutator(algebra, whole(algebra), space)))
