"""Claims about Lie algebras stated in Python: the four sources of so(3)'s constants, and mutants of each."""

import pytest
import sympy as sp
from sympy.physics.matrices import msigma

import canon
from canon import (
    InputError,
    PhaseSpace,
    algebra,
    algebra_of_matrices,
    casimir,
    closure_of_fields,
    group,
    identify,
    matrix_algebra,
    verify,
)
from canon.mechanics.algebra.lie_algebra import LieAlgebra

SPACE = PhaseSpace("x y z", "px py pz", positive="c")
CYCLE = {"J1,J2": {"J3": 1}, "J2,J3": {"J1": 1}, "J3,J1": {"J2": 1}}
WRONG = CYCLE | {"J2,J3": {"J1": sp.Rational(1001, 1000)}}
GENERATORS = [sp.Matrix(3, 3, lambda j, k, i=i: -sp.LeviCivita(i, j, k)) for i in range(3)]
ROTATIONS = {f"J{i + 1}": m for i, m in enumerate(GENERATORS)}
MOMENTA = dict(zip(ROTATIONS, sp.Matrix(SPACE.q).cross(sp.Matrix(SPACE.p)), strict=True))
a, b = (sp.symbols(f"{letter}1:4", real=True) for letter in "ab")


def gibbs(factor):
    """θ(a, b) of Gibbs' vectors, course 7.12."""
    u, v = sp.Matrix(a), sp.Matrix(b)
    return [f / (1 - factor * u.dot(v)) for f in u + v + u.cross(v)]


@pytest.mark.parametrize(
    ("claim", "basis"),
    [(matrix_algebra, ROTATIONS), (algebra, MOMENTA), (matrix_algebra, {n: sp.I * m for n, m in ROTATIONS.items()})],
)
def test_structure_and_name(claim, basis):
    assert verify(claim(SPACE, basis, equals="so(3)", structure=CYCLE)).status == "proved"
    wrong = verify(claim(SPACE, basis, structure=WRONG))
    assert (wrong.status, wrong.detail["value"]) == ("refuted", "J1")
    assert verify(claim(SPACE, basis, equals="sl(2,R)")).status == "refuted"


def test_matrices_with_a_parameter():
    c = SPACE.symbol("c")
    boosts = {"K": [[0, 1 / c], [c, 0]], "D": [[1, 0], [0, -1]], "R": [[0, -1 / c], [c, 0]]}
    assert verify(matrix_algebra(SPACE, boosts, equals="so(2,1)", structure={"D,K": {"R": -2}, "D,R": {"K": -2},
        "K,R": {"D": 2}})).status == "proved"  # fmt: skip


def test_composition_function():
    doubled = {pair.replace("J", "a"): {n.replace("J", "a"): -2 for n in row} for pair, row in CYCLE.items()}
    assert verify(group(SPACE, gibbs(1), a, b, equals="so(3)", structure=doubled), budget=60).status == "proved"
    assert verify(group(SPACE, gibbs(sp.Rational(1001, 1000)), a, b, equals="so(3)"), budget=60).status == "refuted"


def test_a_law_of_many_parameters_that_is_not_associative():
    """Galilei's group with its mass phase, 11 parameters; a thousandth in the cocycle shows at third order."""
    A, B = (sp.symbols(f"{letter}1:12", real=True) for letter in "ab")
    u, v, w = (sp.Matrix(A[k : k + 3]) for k in (0, 3, 6))
    U, V, W = (sp.Matrix(B[k : k + 3]) for k in (0, 3, 6))
    K = sp.Matrix(3, 3, lambda i, j: -sum(sp.LeviCivita(i, j, k) * u[k] for k in range(3)))
    R = sp.eye(3) + 2 * (K + K * K) / (1 + u.dot(u))
    rotations = (u + U + u.cross(U)) / (1 - u.dot(U))
    rest = [*rotations, *(R * V + v), *(R * W + v * B[9] + w), A[9] + B[9]]
    phase = A[10] + B[10] + v.dot(R * W)
    right, wrong = (phase + k * v.dot(v) * B[9] for k in (sp.Rational(1, 2), sp.Rational(501, 1000)))
    assert verify(group(SPACE, [*rest, right], A, B, equals="bargmann"), budget=60).status == "proved"
    found = verify(group(SPACE, [*rest, wrong], A, B, equals="bargmann"), budget=60)
    assert (found.status, found.detail["fails"]) == ("refuted", "associativity of θ11 at order 3")


def test_casimir():
    M = sp.symbols("M1:4", real=True)
    tensor = sp.Matrix([[0, M[2], -M[1]], [-M[2], 0, M[0]], [M[1], -M[0], 0]])
    square = sum(x**2 for x in M)
    assert verify(casimir(SPACE, square, M, tensor)).status == "proved"
    assert verify(casimir(SPACE, square + M[0] ** 2 / 1000, M, tensor.tolist())).status == "refuted"


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        (lambda: algebra(SPACE, MOMENTA), "say which algebra"),
        (lambda: algebra(SPACE, MOMENTA, equals="spin(3)"), "unknown algebra"),
        (lambda: algebra(SPACE, MOMENTA, structure={"J1,Q": {"J2": 1}}), "of the basis J1, J2, J3"),
        (lambda: algebra(SPACE, MOMENTA, structure=CYCLE | {"J2,J1": {"J3": -1}}), "stated twice"),
        (lambda: matrix_algebra(SPACE, {"A": [[0, 1]]}, equals="u(1)"), "a square matrix is expected, 1 by 1"),
        (lambda: group(SPACE, [SPACE.q[0] + b[0]], [SPACE.q[0]], [b[0]], equals="u(1)"), "no parameter of a group"),
    ],
)
def test_what_is_wrong_is_said(stated, message):
    with pytest.raises(InputError, match=message):
        stated()


def turned(sign):
    """[a, b] = c, [b, c] = a, [c, a] = E0 b with E0 so assumed."""
    E0 = sp.Symbol("E0", **{sign: True})
    return LieAlgebra.of(("a", "b", "c"), {"a,b": {"c": 1}, "b,c": {"a": 1}, "c,a": {"b": E0}})


def test_identify_by_the_sign_of_a_parameter():
    assert identify(turned("negative")).identity.name == "sl(2,R)"
    assert identify(turned("positive")).identity.name == "so(3)"
    free = turned("real")
    with pytest.raises(InputError, match="declare the signs"):
        identify(free)


def test_matrices_of_sympy():
    """Pauli's, halved: hermitian, so that −i[A, B] is the bracket."""
    half = {name: msigma(k) / 2 for k, name in enumerate(ROTATIONS, 1)}
    found = algebra_of_matrices(half)
    assert found.physicists
    assert list(found.algebra.rows()) == [("J1", "J2", "J3"), ("J1", "J3", "-J2"), ("J2", "J3", "J1")]
    with pytest.raises(InputError, match="a claim 'matrix_algebra' takes others"):
        algebra_of_matrices({"A": sp.Matrix([[sp.sqrt(2)]])})


def test_text_is_no_component_of_a_field():
    x = sp.Symbol("x", real=True)
    with pytest.raises(InputError, match=r"text is read by space.formula"):
        closure_of_fields({"X": ["x"]}, [x])  # type: ignore[list-item]


def test_the_matrix_of_a_group_is_square():
    space = canon.PhaseSpace("q", "p")
    a = sp.Symbol("a", real=True)
    claim = canon.group(space, None, [a], matrix=[[sp.exp(a), 0], [0, 1]], equals="u(1)")
    assert [[entry.expr for entry in row] for row in claim.keys["matrix"]] == [[sp.exp(a), 0], [0, 1]]
    for given in ([], [[1, a]], [[1, 0], [a]], sp.Matrix([[1, a]])):
        with pytest.raises(InputError, match="a square matrix is expected"):
            canon.group(space, None, [a], matrix=given)
    with pytest.raises(InputError, match="composition with both sets"):
        canon.group(space, [a], [a])
    with pytest.raises(InputError, match="is no parameter of a group"):
        canon.group(space, None, [space.q[0]], matrix=[[1]])
