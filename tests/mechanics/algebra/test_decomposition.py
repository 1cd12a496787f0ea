"""Sums of algebras that are neither semisimple nor abelian: taken apart, and named."""

import random
from fractions import Fraction

import pytest

from canon.mechanics.algebra.from_matrices import algebra_of_matrices
from canon.mechanics.algebra.identify import identify
from canon.mechanics.algebra.identity import isomorphic
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.algebra.names import read_name
from canon.mechanics.algebra.standard import euclidean, orthogonal
from canon.mechanics.algebra.sums import direct_sum

E2, E3 = (algebra_of_matrices(euclidean(n)).algebra for n in (2, 3))
SO3 = algebra_of_matrices(orthogonal(3)).algebra
HEISENBERG = LieAlgebra.of(["q", "p", "one"], {"q,p": "one"})
AFFINE = LieAlgebra.of(["a", "b"], {"a,b": "b"})
HYPERBOLIC = LieAlgebra.of(["k", "x", "y"], {"k,x": "x", "k,y": "-y"})
SPIRAL = LieAlgebra.of(["d", "x", "y"], {"d,x": "x + y", "d,y": "y"})
LINE = LieAlgebra(("z",), {})


def disguised(algebra: LieAlgebra, seed: int = 0) -> LieAlgebra:
    """The algebra in a basis chosen at random."""
    rng, n = random.Random(seed), algebra.dimension
    return algebra.in_basis([[rng.randint(-3, 3) for _ in range(n)] for _ in range(n)])


@pytest.mark.parametrize(
    ("parts", "name"),
    [
        ((E3, HEISENBERG), "heisenberg(1) + e(3)"),
        ((E2, E2), "e(2) + e(2)"),
        ((E2, HYPERBOLIC, LINE), "iso(1,1) + e(2) + u(1)"),
        ((AFFINE, AFFINE, HEISENBERG), "aff(1) + aff(1) + heisenberg(1)"),
        ((SO3, E3, HEISENBERG, LINE, LINE), "so(3) + heisenberg(1) + e(3) + u(1)^2"),
    ],
)
def test_sums_are_named_in_any_basis(parts, name):
    plain = direct_sum(*parts)
    for algebra in (plain, disguised(plain)):
        found = identify(algebra)
        assert found.identity.name == name
        assert isomorphic(found.identity, read_name(name)) is True
        assert sum(rows.nrows() for _, rows in found.summands) == algebra.dimension


def test_near_misses_of_sums():
    """Equal dimensions, Levi subalgebras and centres, other summands."""
    found = identify(disguised(direct_sum(E2, E2))).identity
    for other in ("e(2) + iso(1,1)", "iso(1,1)^2", "h(1)^2", "aff(1)^3", "e(2)", "galilei"):
        assert isomorphic(found, read_name(other)) is False
    assert isomorphic(found, read_name("e(2)^2")) is True
    unnamed = identify(disguised(direct_sum(E2, SPIRAL))).identity
    assert unnamed.name == "e(2) + a solvable algebra of dimension 3"
    assert isomorphic(unnamed, read_name("e(2)^2")) is False


def over_roots(square: int, algebra: LieAlgebra) -> LieAlgebra:
    """The algebra over Q(√square) read as one over Q: e_a and √square e_a."""
    n = algebra.dimension
    constants: dict[tuple[int, int], dict[int, Fraction]] = {}
    for (a, b), row in algebra.constants.items():
        values = {c: Fraction(str(v)) for c, v in row.items()}
        constants[a, b] = values
        constants[a, n + b] = {n + c: v for c, v in values.items()}
        constants[n + a, b] = {n + c: v for c, v in values.items()}
        constants[n + a, n + b] = {c: square * v for c, v in values.items()}
    return LieAlgebra(tuple(f"x{k}" for k in range(2 * n)), constants)


def test_summands_that_are_none_over_the_rationals():
    """Over Q(√2) two conjugate ideals; over Q(i) a complex algebra, which is no sum, and none that has a name."""
    assert identify(over_roots(2, HEISENBERG)).identity.name == "heisenberg(1) + heisenberg(1)"
    assert identify(disguised(over_roots(2, AFFINE))).identity.name == "aff(1) + aff(1)"
    open_one = identify(over_roots(2, E2)).identity
    assert isomorphic(open_one, read_name("e(2)^2")) is None  # it is, which isn't found out
    assert isomorphic(open_one, read_name("so(3) + u(1)^3")) is False
    for given, real in ((HEISENBERG, "h(1)^2"), (E2, "e(2)^2"), (AFFINE, "aff(1)^2")):
        found = identify(over_roots(-1, given)).identity
        assert found.other
        assert isomorphic(found, read_name(real)) is False
