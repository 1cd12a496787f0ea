"""Casimirs by linear algebra, and root systems by their Cartan matrices."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.casimirs import casimirs, poisson
from canon.mechanics.algebra.complex_type import ComplexType
from canon.mechanics.algebra.from_matrices import algebra_of_matrices
from canon.mechanics.algebra.invariants import motion_casimirs, orthogonal_casimirs
from canon.mechanics.algebra.root_system import cartan_matrix, positive_roots
from canon.mechanics.algebra.standard import euclidean, hermitian, orthogonal, symplectic
from tests.mechanics.algebra.test_identify import galilei
from tests.mechanics.algebra.test_lie_algebra import two_vectors

J, K = sp.symbols("J:3"), sp.symbols("K:3")
JK = sum(j * k for j, k in zip(J, K, strict=True))
JJ, KK = (sum(v**2 for v in vector) for vector in (J, K))


def same_span(found, expected):
    symbols = sorted({s for f in (*found, *expected) for s in f.free_symbols}, key=str)
    monomials = sorted({m for f in (*found, *expected) for m in sp.Poly(f, *symbols).monoms()})
    rows = [[sp.Poly(f, *symbols).coeff_monomial(m) for m in monomials] for f in (*found, *expected)]
    return sp.Matrix(rows).rank() == len(found) == len(expected)


def test_quadratic_casimirs_of_keplers_algebras():
    """M·D and M² + D² for so(4), M·D and M² − D² for so(3,1), P² and J·P for e(3): course sec-13.12-h."""
    assert same_span(casimirs(two_vectors(1)), [JK, JJ + KK])
    assert same_span(casimirs(two_vectors(-1)), [JK, JJ - KK])
    assert same_span(casimirs(two_vectors(0)), [JK, KK])


def test_casimirs_of_galileis_algebra_extended_by_the_mass():
    """M, and of degree 2 besides M² the internal energy: P² − 2 M H, with [K_i, H] = P_i and [K_i, P_j] = M δ_ij."""
    g = galilei(mass=1)
    assert casimirs(g, 1) == (sp.Symbol("M"),)
    M, H = sp.symbols("M H")
    P = sum(p**2 for p in sp.symbols("P:3"))
    assert same_span(casimirs(g), [M**2, P - 2 * M * H])


def as_table(f, names):
    return {
        tuple(k for k, e in enumerate(power) for _ in range(e)): Fraction(int(v.p), int(v.q))
        for power, v in sp.Poly(f, *sp.symbols(names)).terms()
    }


@pytest.mark.parametrize(
    ("matrices", "degrees"),
    [
        (orthogonal(3), [2]),
        (orthogonal(3, 1), [2, 2]),
        (orthogonal(4, 1), [2, 4]),
        pytest.param(orthogonal(6), [2, 4, 3], marks=pytest.mark.slow),
    ],
)
def test_orthogonal_casimirs_commute_with_everything(matrices, degrees):
    found, g = orthogonal_casimirs(matrices), algebra_of_matrices(matrices).algebra
    assert [sp.Poly(f).total_degree() for f in found] == degrees
    assert not any(poisson(g, a, as_table(f, g.names)) for f in found for a in range(g.dimension))
    assert orthogonal_casimirs(matrices, highest=2) == tuple(f for f, d in zip(found, degrees, strict=True) if d == 2)


@pytest.mark.parametrize(("matrices", "degrees"), [(euclidean(3, 1), [2, 4]), (euclidean(5), [2, 4, 3])])
def test_casimirs_of_motions_commute_with_everything(matrices, degrees):
    """P², W² of Poincaré's algebra; in a basis in which J_0 + P_0 takes the place of J_0 too."""
    g = algebra_of_matrices(matrices).algebra
    rows = [[linear.rational(int(i == j or (i, j) == (0, g.dimension - 1))) for j in range(g.dimension)]
            for i in range(g.dimension)]  # fmt: skip
    for algebra in (g, g.in_basis(linear.matrix(rows, g.dimension), g.names)):
        found = motion_casimirs(algebra)
        assert [sp.Poly(f).total_degree() for f in found] == degrees
        assert not any(poisson(algebra, a, as_table(f, g.names)) for f in found for a in range(g.dimension))


def test_invariants_span_what_linear_algebra_finds():
    """Of so(5) to degree 4: C_2² and C_4; of e(3): P² and J·P."""
    two, four = orthogonal_casimirs(orthogonal(5))
    assert same_span(casimirs(algebra_of_matrices(orthogonal(5)).algebra, 4), [sp.expand(two**2), four])
    assert same_span(casimirs(two_vectors(0)), motion_casimirs(two_vectors(0)))


def test_what_has_no_such_invariants():
    with pytest.raises(InputError, match="no basis of so"):
        orthogonal_casimirs(symplectic(2))
    with pytest.raises(InputError, match="real matrices"):
        orthogonal_casimirs(hermitian(2))
    with pytest.raises(InputError, match=r"the algebra is so\(4\), not iso"):
        motion_casimirs(two_vectors(1))
    with pytest.raises(InputError, match="rational"):
        casimirs(two_vectors(sp.Symbol("k", positive=True)))


def test_too_many_monomials():
    with pytest.raises(InputError, match="too many monomials"):
        casimirs(galilei(), 8)


@pytest.mark.parametrize(
    "kind",
    [("A", 1), ("A", 4), ("B", 2), ("B", 3), ("C", 3), ("D", 4), ("G", 2), ("F", 4), ("E", 6), ("E", 7)],
)
def test_root_systems(kind):
    """As many roots as the dimension less the rank, a Cartan matrix of the type's determinant, one highest root."""
    type_ = ComplexType(*kind)
    roots = positive_roots(type_)
    assert type_.dimension == type_.rank + 2 * len(roots)
    determinants = {"A": type_.rank + 1, "B": 2, "C": 2, "D": 4, "E": 9 - type_.rank, "F": 1, "G": 1}
    assert sp.Matrix(cartan_matrix(type_)).det() == determinants[type_.letter]
    heights = [sum(root) for root in roots]
    assert heights.count(max(heights)) == 1


def test_long_and_short_roots_of_b3_and_c3():
    """B_3 has three short positive roots of nine, C_3 six."""
    for letter, short in (("B", 3), ("C", 6)):
        a = sp.Matrix(cartan_matrix(ComplexType(letter, 3)))
        lengths = [1, 1, 1]  # of simple roots: a_ij (α_i, α_i) is symmetric
        for i in (1, 2):
            lengths[i] = sp.Rational(lengths[i - 1] * a[i - 1, i], a[i, i - 1])
        form = sp.diag(*lengths) * a / 2
        squares = [(sp.Matrix([r]) * form * sp.Matrix([r]).T)[0] for r in positive_roots(ComplexType(letter, 3))]
        assert squares.count(min(squares)) == short
