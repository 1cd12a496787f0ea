"""Groups by matrices: charts of Sp(2n), U(n), SL(2, C) and boosts, and what isn't closed under multiplication."""

import pytest
import sympy as sp

from canon import InputError, PhaseSpace, group, verify
from canon.claims.reader import read_text

SPACE = PhaseSpace("x", "p", positive="c")
I = sp.I


def decided(matrix, names, equals, inverse=None, structure=None):
    return verify(
        group(SPACE, matrix=matrix, first=names, inverse=inverse, equals=equals, structure=structure), budget=60
    )


def blocks(a, b, c, d):
    return sp.Matrix(sp.BlockMatrix([[a, b], [c, d]]))


def symplectic():
    """A chart of Sp(4, R): triangular, block diagonal, triangular; with its inverse."""
    d = sp.symbols("d1:11", real=True)
    C, B = (sp.Matrix([[v[0], v[1]], [v[1], v[2]]]) for v in (d[:3], d[7:]))
    A = sp.Matrix([[1 + d[3], d[4]], [d[5], 1 + d[6]]])
    Ai, one, zero = A.adjugate() / A.det(), sp.eye(2), sp.zeros(2)
    M = blocks(one, zero, C, one) * blocks(A, zero, zero, Ai.T) * blocks(one, B, zero, one)
    inverse = blocks(one, -B, zero, one) * blocks(Ai, zero, zero, A.T) * blocks(one, zero, -C, one)
    return M, d, inverse


def test_symplectic_matrices():
    M, names, inverse = symplectic()
    assert decided(M, names, "sp(4,R)", inverse).status == "proved"
    assert decided(M, names, "so(5)", inverse).status == "refuted"
    wrong = M.copy()
    wrong[0, 0] += names[0] * names[1] / 1000
    found = decided(wrong, names, "sp(4,R)")
    assert found.status == "refuted"
    assert "outside the span" in found.detail["fails"]


def test_unitary_matrices_of_the_oscillator():
    """U(2) by Euler's kind of angles about the identity: so(3) + u(1); U(3) by nine one-parameter groups."""
    a = sp.symbols("a1:5", real=True)
    half = [angle / 2 for angle in a]
    first = sp.Matrix([[sp.cos(half[0]), I * sp.sin(half[0])], [I * sp.sin(half[0]), sp.cos(half[0])]])
    second = sp.Matrix([[sp.cos(half[1]), sp.sin(half[1])], [-sp.sin(half[1]), sp.cos(half[1])]])
    third = sp.diag(sp.exp(I * half[2]), sp.exp(-I * half[2])) * sp.exp(I * a[3])
    found = decided(first * second * third, a, "u(2)", structure={"a1,a2": {"a3": 1}, "a2,a3": {"a1": 1},
                                                                  "a3,a1": {"a2": 1}})  # fmt: skip
    assert (found.status, found.detail["algebra"]) == ("proved", "so(3) + u(1)")

    n = sp.symbols("n1:10", real=True)

    def turn(i, j, angle, factor):
        R = sp.eye(3)
        R[i, i] = R[j, j] = sp.cos(angle)
        R[i, j], R[j, i] = factor * sp.sin(angle), -sp.conjugate(factor) * sp.sin(angle)
        return R

    pairs = ((0, 1), (0, 2), (1, 2))
    M, inverse = sp.eye(3), sp.eye(3)
    for k, (i, j) in enumerate(pairs):
        for factor, angle in ((1, n[2 * k]), (I, n[2 * k + 1])):
            M, inverse = M * turn(i, j, angle, factor), turn(i, j, -angle, factor) * inverse
    phases = n[6:]
    M = M * sp.diag(*(sp.cos(v) + I * sp.sin(v) for v in phases))
    inverse = sp.diag(*(sp.cos(v) - I * sp.sin(v) for v in phases)) * inverse
    assert decided(M.applyfunc(sp.expand), n, "u(3)", inverse.applyfunc(sp.expand)).status == "proved"


def test_lorentz_group_by_the_complex_gibbs_vector():
    """(1 + X)/(1 − X) with a traceless complex X: so(3,1), and not so(4)."""
    z = sp.symbols("z1:7", real=True)
    X = sp.Matrix([[z[0] + I * z[1], z[2] + I * z[3]], [z[4] + I * z[5], -z[0] - I * z[1]]])
    down = sp.conjugate((sp.eye(2) - X).det())
    norm = sp.expand(down * (sp.eye(2) - X).det())
    M = ((sp.eye(2) - X).adjugate() * (sp.eye(2) + X)).applyfunc(lambda e: sp.expand(e * down) / norm)
    inverse = M.xreplace({v: -v for v in z})
    assert decided(M, z, "so(3,1)", inverse).status == "proved"
    assert decided(M, z, "so(4)", inverse).status == "refuted"


def test_boosts_with_a_parameter_and_sl2():
    u, c = sp.Symbol("u", real=True), SPACE.symbols("c")
    gamma = 1 / sp.sqrt(1 - u**2 / c**2)
    assert decided([[gamma, gamma * u / c**2], [gamma * u, gamma]], [u], "u(1)").status == "proved"
    a, b, d = sp.symbols("a b d", real=True)
    found = decided([[1 + a, b], [d, (1 + b * d) / (1 + a)]], [a, b, d], "sl(2,R)")
    assert (found.status, found.detail["structure"]) == ("proved", {"a,b": "-2*b", "a,d": "2*d", "b,d": "-a"})


@pytest.mark.parametrize(
    ("corner", "fails"),
    [("1 + b*d", "M⁻¹ ∂M/∂"), ("2", "row 2, column 2 of M(0)"), ("1 + a", "M⁻¹ ∂M/∂")],
)
def test_what_is_no_group(corner, fails):
    a, b, d = sp.symbols("a b d", real=True)
    found = decided([[1 + a, b], [d, sp.sympify(corner, {"a": a, "b": b, "d": d})]], [a, b, d], "sl(2,R)")
    assert found.status == "refuted"
    assert fails in found.detail["fails"]


def test_names_that_are_no_coordinates():
    a, b = sp.symbols("a b", real=True)
    found = decided([[1, a + b], [0, 1]], [a, b], "u(1)^2")
    assert (found.status, found.detail["fails"]) == ("refuted", "independence of the derivatives at the identity")


BARE = """
[symbols]
k = "real"
[[claim]]
kind = "group"
first = ["t"]
matrix = [["cos(t)", "-sin(t)"], ["sin(t)", "cos(t)"]]
equals = "u(1)"
[[claim]]
kind = "group"
first = ["s"]
second = ["r"]
composition = ["s + r + k*s*r + s*r**2/1000"]
equals = "u(1)"
"""


def test_a_file_about_groups_needs_no_phase_space():
    reading = read_text(BARE)
    assert reading.problems == []
    circle, wrong = (verify(claim) for claim in reading.claims)
    assert (circle.status, wrong.status) == ("proved", "refuted")
    assert not {"q__", "p__"} & set(wrong.witness or {})
    problems = read_text(BARE + '[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "1"').problems
    assert "declares its coordinates" in problems[0]["message"]
    unknown = read_text(BARE.replace("k*s", "q__*s")).problems
    assert "unknown name 'q__'" in unknown[0]["message"]


def test_ill_posed_claims():
    a, b = sp.symbols("a b", real=True)
    with pytest.raises(InputError, match="a matrix with the first"):
        group(SPACE, [a + b], [a], [b], matrix=[[a]], equals="u(1)")
    with pytest.raises(InputError, match="square matrix"):
        group(SPACE, matrix=[[a, 1]], first=[a], equals="u(1)")
    with pytest.raises(InputError, match="3 rows, but the matrix has 1"):
        decided([[1 + a]], [a], "u(1)", sp.eye(3))
