"""Direct and semidirect sums, the ideals found in them again, and root systems with their vectors."""

from itertools import permutations

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.from_matrices import algebra_of_matrices
from canon.mechanics.algebra.identify import identify
from canon.mechanics.algebra.lie_algebra import LieAlgebra, structure
from canon.mechanics.algebra.root_system import cartan_matrix, positive_roots
from canon.mechanics.algebra.roots import roots_of
from canon.mechanics.algebra.standard import hermitian, orthogonal, special_linear, symplectic
from canon.mechanics.algebra.sums import direct_sum, semidirect_sum
from tests.mechanics.algebra.test_lie_algebra import SO3, two_vectors

ROTATIONS = structure("xyz", SO3)
R3 = LieAlgebra(("a", "b", "c"), {})
VECTOR = {
    "x": [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
    "y": [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
    "z": [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
}


def test_summands_are_found_again_in_another_basis():
    g = direct_sum(ROTATIONS, two_vectors(-1), two_vectors(0), LieAlgebra(("c",), {}))
    assert g.names[:4] == ("x_1", "y_1", "z_1", "J0_2")
    assert direct_sum(ROTATIONS, R3).names == (*"xyz", *"abc")
    n = g.dimension
    mixed = [[linear.rational(int(i == j or (i + 1) % n == j)) for j in range(n)] for i in range(n - 1)]
    mixed.append([linear.rational(int(j == n - 1)) for j in range(n)])
    found = identify(g.in_basis(linear.matrix(mixed, n)))
    assert found.identity.name == "so(3) + so(3,1) + e(3) + u(1)"
    back = linear.matrix(mixed, n)
    for (name, rows), expected in zip(
        found.summands, (range(3), range(3, 9), range(9, 15), range(15, 16)), strict=True
    ):
        given = linear.rows(rows * back)
        assert name in found.identity.name
        assert len(given) == len(expected)
        assert all(v == 0 for row in given for k, v in enumerate(row) if k not in expected), name


def test_two_ideals_that_need_a_root_are_one_summand():
    found = identify(direct_sum(ROTATIONS, two_vectors(2)))
    assert [(name, found.words(rows)[:2]) for name, rows in found.summands] == [
        ("so(3)", ("x", "y")), ("so(3) + so(3)", ("J0", "J1"))
    ]  # fmt: skip


def test_semidirect_sums():
    assert identify(semidirect_sum(ROTATIONS, R3, VECTOR)).identity.name == "e(3)"
    heisenberg = structure("qpz", {"q,p": "z"})
    scaled = semidirect_sum(structure("s", {}), heisenberg, {"s": [[1, 0, 0], [0, 1, 0], [0, 0, 2]]})
    assert dict(scaled.bracket({"s": 1}, {"z": 1})) == {"z": 2}
    with pytest.raises(InputError, match=r"Jacobi's identity fails for s, q, p"):  # no derivation
        semidirect_sum(structure("s", {}), heisenberg, {"s": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})
    with pytest.raises(InputError, match="Jacobi"):  # no homomorphism
        semidirect_sum(ROTATIONS, R3, {**VECTOR, "z": [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]})
    with pytest.raises(InputError, match="3 rows and columns"):
        semidirect_sum(ROTATIONS, R3, {"x": [[1]]})


SIMPLE = {
    ("A", 2): hermitian(3), ("B", 2): orthogonal(4, 1), ("C", 3): symplectic(3), ("D", 4): orthogonal(8),
    ("A", 3): special_linear(4),
}  # fmt: skip


@pytest.mark.parametrize("kind", SIMPLE)
def test_the_roots_are_those_of_the_type(kind):
    """As many, with a Cartan matrix that differs by the order of the simple roots, and coordinates that fit."""
    from canon.mechanics.algebra.complex_type import ComplexType

    type_ = ComplexType(*kind)
    found, known = roots_of(algebra_of_matrices(SIMPLE[kind]).algebra), cartan_matrix(type_)
    order = next(
        p
        for p in permutations(range(type_.rank))
        if all(found.cartan_matrix[p[i]][p[j]] == known[i][j] for i in range(type_.rank) for j in range(type_.rank))
    )
    positive = {tuple(root.coordinates[k] for k in order) for root in found.roots if root.is_positive}
    assert positive == set(positive_roots(type_))
    assert len(found.roots) == 2 * len(positive)
    assert sorted(found.roots[k].coordinates for k in found.simple) == sorted(
        tuple(int(i == j) for j in range(type_.rank)) for i in range(type_.rank)
    )


@pytest.mark.parametrize(
    "algebra",
    [ROTATIONS, two_vectors(-1), two_vectors(2), algebra_of_matrices(orthogonal(3, 2)).algebra],
    ids=["so(3)", "so(3,1)", "so(4), with roots of 2", "so(3,2)"],
)
def test_root_vectors_are_eigenvectors(algebra):
    """[h, v] = α(h) v for every h of the Cartan subalgebra, in algebraic numbers."""
    found = roots_of(algebra)
    names = sp.symbols(algebra.names)

    def element(formula):
        return {s.name: sp.expand(formula).coeff(s) for s in names if sp.expand(formula).coeff(s) != 0}

    for root in found.roots:
        for h, value in zip(found.cartan, root.values, strict=True):
            image = algebra.bracket(element(h), element(root.vector))
            total = sum(v * sp.Symbol(name) for name, v in image.items()) - value * root.vector
            assert sp.radsimp(sp.expand(total)) == 0


def test_what_has_no_root_system():
    with pytest.raises(InputError, match="degenerate"):
        roots_of(two_vectors(0))
    with pytest.raises(InputError, match="rational"):
        roots_of(two_vectors(sp.Symbol("k", positive=True)))
