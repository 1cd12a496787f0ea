"""`volume`, `integral_invariant`, `cartan_invariant`, `bracket_invariance`."""

import itertools
import random

import pytest
import sympy as sp

from canon.claims.determinant import determinant, lagrange_matrix, pfaffian
from canon.decide.tape import Tape
from canon.errors import InputError

TWO = 'q = ["x", "y"]\np = ["px", "py"]\nQ = ["X", "Y"]\nP = ["PX", "PY"]\n'


@pytest.mark.parametrize(
    ("Q", "P", "expected", "sign"),
    [
        ("p", "-q", "proved", "1"),
        ("p", "q", "proved", "-1"),
        ("2*q", "p", "refuted", "2"),
        ("abs(q)", "p", "proved", None),
        ("1j*q", "p", "proved", "1j"),
        ("q*exp(1j*p)", "p", "proved", None),
        ("q*exp(p)", "p", "refuted", None),
    ],
)
def test_volume(ask, Q, P, expected, sign):
    (verdict,) = ask('kind = "volume"', transformation=f'Q = ["{Q}"]\nP = ["{P}"]')
    assert verdict.status == expected
    assert sign is None or verdict.detail["determinant"] == sign


def test_volume_of_a_holomorphic_map_of_complex_variables(ask):
    """A holomorphic determinant of modulus one is constant, by the open mapping theorem."""
    complexes = {"symbols": 'q = "complex"\np = "complex"'}
    (turned,) = ask('kind = "volume"', transformation='Q = ["1j*q"]\nP = ["p"]', **complexes)
    (bent,) = ask('kind = "volume"', transformation='Q = ["exp(q)"]\nP = ["p"]', **complexes)
    assert turned.status == "proved"
    assert bent.status == "refuted"


@pytest.mark.parametrize(
    ("Q", "P", "orders"),
    [
        (("x", "y"), ("px", "py"), ("proved", "proved")),
        (("px", "py"), ("x", "y"), ("refuted", "proved")),  # scale -1: even powers are preserved
        (("px", "y"), ("x", "py"), ("refuted", "refuted")),  # det M = -1
        (("x + y*px", "2*y"), ("px", "py/2"), ("refuted", "proved")),
        (("2*x", "2*y"), ("px", "py"), ("refuted", "refuted")),
    ],
)
def test_integral_invariants(ask, Q, P, orders):
    transformation = f"Q = {list(Q)}\nP = {list(P)}"
    verdicts = ask(
        *(f'kind = "integral_invariant"\norder = {k}' for k in (1, 2)), space=TWO, transformation=transformation
    )
    assert tuple(verdict.status for verdict in verdicts) == orders


def test_the_middle_invariant_of_three_degrees_of_freedom(ask):
    """Order 2 of 3 holds for scale −1, by Pfaffians too where the brackets have no common scale."""
    space = 'q = ["a","b","c"]\np = ["u","v","w"]\nQ = ["A","B","C"]\nP = ["U","V","W"]\n'
    (anti,) = ask(
        'kind = "integral_invariant"\norder = 2',
        space=space,
        transformation='Q = ["u", "v", "w"]\nP = ["a", "b", "c"]',
    )
    (mixed,) = ask(
        'kind = "integral_invariant"\norder = 2',
        space=space,
        transformation='Q = ["2*a", "b/2", "c"]\nP = ["u", "v", "w"]',
    )
    assert anti.status == "proved"
    assert mixed.status == "refuted"


DAMPED = {
    "symbols": 'g = "positive"',
    "hamiltonian": 'H = "exp(-g*t)*p**2/2 + exp(g*t)*q**2/2"',
    "transformation": 'Q = ["q*exp(g*t/2)"]\nP = ["p*exp(-g*t/2)"]',
}


def test_poincare_cartan_with_time(ask):
    right, wrong = ask(
        'kind = "cartan_invariant"\nK = "P**2/2 + Q**2/2 + g*Q*P/2"',
        'kind = "cartan_invariant"\nK = "P**2/2 + Q**2/2"',
        **DAMPED,
    )
    assert right.status == "proved"
    assert right.detail["potential"] == "0"
    assert wrong.status == "refuted"


def test_poincare_cartan_of_an_exchange_finds_the_generating_function(ask):
    (verdict,) = ask(
        'kind = "cartan_invariant"\nK = "P**2/2"',
        hamiltonian='H = "q**2/2"',
        transformation='Q = ["-p"]\nP = ["q"]',
    )
    assert verdict.status == "proved"
    assert verdict.detail["potential"] == "p*q"


@pytest.mark.parametrize(
    ("transformation", "f", "g", "expected"),
    [
        ('Q = ["p"]\nP = ["-q"]', "Q", "P", "proved"),
        ('Q = ["p"]\nP = ["q"]', "Q", "P", "refuted"),
        ('Q = ["2*q"]\nP = ["p"]', "Q", "Q**2", "proved"),
        ('q = ["2*Q"]\np = ["P"]', "Q", "P", "refuted"),
        ('q = ["2*Q"]\np = ["P"]', "Q", "Q**2", "proved"),
        ('q = ["sqrt(2*P)*sin(Q)"]\np = ["sqrt(2*P)*cos(Q)"]', "P*Q", "P**2", "proved"),
    ],
)
def test_brackets_in_either_set_of_variables(status, transformation, f, g, expected):
    claim = f'kind = "bracket_invariance"\nf = "{f}"\ng = "{g}"'
    assert status(claim, transformation=transformation) == expected


def test_brackets_without_the_inverse_of_a_map_of_two_degrees_of_freedom(ask):
    """A backward map that isn't canonical: {X, PX} is −1/2 in the old variables, {X, Y} is 0 in both."""
    backward = 'q = ["PX", "Y + X**2"]\np = ["2*X", "PY + X"]'
    verdicts = ask(
        'kind = "bracket_invariance"\nf = "X"\ng = "PX"',
        'kind = "bracket_invariance"\nf = "X"\ng = "X**3"',
        'kind = "identity"\nlhs = "bracket(px, x)"\nrhs = "-1"',
        space=TWO,
        transformation=backward,
    )
    assert [verdict.status for verdict in verdicts] == ["refuted", "proved", "proved"]


def test_a_map_of_too_few_pairs(status):
    with pytest.raises(AssertionError, match="as many new pairs"):
        status(
            'kind = "volume"',
            space='q = ["x", "y"]\np = ["px", "py"]\nQ = ["X"]\nP = ["PX"]\n',
            transformation='Q = ["x"]\nP = ["px"]',
        )


def test_determinants_and_pfaffians_agree_with_sympy():
    rng = random.Random(3)
    tape = Tape()
    for size in (1, 2, 3, 4, 5):
        matrix = sp.Matrix(size, size, lambda i, j: rng.randrange(-3, 4))
        node = determinant(tape, [[tape.load(entry) for entry in matrix.row(i)] for i in range(size)])
        assert tape.value(node) == int(matrix.det())
    for size in (2, 4, 6):
        upper = {(i, j): rng.randrange(-3, 4) for i, j in itertools.combinations(range(size), 2)}
        matrix = sp.Matrix(size, size, lambda i, j, u=upper: u.get((i, j), 0) - u.get((j, i), 0))
        nodes = [[tape.load(entry) for entry in matrix.row(i)] for i in range(size)]
        value = tape.value(pfaffian(tape, nodes, range(size)))
        assert value is not None
        assert value**2 == int(matrix.det())


def test_the_lagrange_matrix_of_the_identity_is_j():
    tape = Tape()
    unit = [[tape.number(int(i == j)) for j in range(4)] for i in range(4)]
    rows = [[tape.value(entry) for entry in row] for row in lagrange_matrix(tape, unit)]
    assert rows == [[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, 0, 0], [0, -1, 0, 0]]


def test_an_order_out_of_range(status):
    with pytest.raises((InputError, AssertionError)):
        status('kind = "integral_invariant"\norder = 2', transformation='Q = ["q"]\nP = ["p"]')
