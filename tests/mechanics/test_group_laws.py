"""Composition functions of the groups of mechanics, in coordinates where the law is rational: the names found."""

import pytest
import sympy as sp

from canon import PhaseSpace, group, verify

SPACE = PhaseSpace("x", "p")
Pair = tuple[sp.Expr, sp.Expr]


def gibbs(u, v):
    """Two Gibbs vectors, n tan(φ/2): that of the rotation by v, then by u."""
    u, v = sp.Matrix(u), sp.Matrix(v)
    return list((u + v + u.cross(v)) / (1 - u.dot(v)))


def rotation(u):
    u = sp.Matrix(u)
    K = sp.Matrix([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
    return sp.eye(3) + 2 * (K + K * K) / (1 + u.dot(u))


def times(x: Pair, y: Pair) -> Pair:
    return x[0] * y[0] - x[1] * y[1], x[0] * y[1] + x[1] * y[0]


def plus(x: Pair, y: Pair) -> Pair:
    return x[0] + y[0], x[1] + y[1]


def special_linear(v):
    """(a, b, c, d) of SL(2, C) as pairs, a = 1 + …, with d = (1 + bc)/a."""
    one, i = sp.Integer(1), sp.Integer(0)
    a, b, c = (1 + v[0], v[1]), (v[2], v[3]), (v[4], v[5])
    size = a[0] ** 2 + a[1] ** 2
    over, back = times(plus((one, i), times(b, c)), (a[0], -a[1])), size
    return a, b, c, (over[0] / back, over[1] / back)


def lorentz(A, B):
    a, b, c, d = special_linear(A)
    e, f, g, h = special_linear(B)
    first = plus(times(a, e), times(b, g))
    rest = [plus(times(a, f), times(b, h)), plus(times(c, e), times(d, g))]
    return [first[0] - 1, first[1], *(part for pair in rest for part in pair)]


def moved(A, X):
    """M X M† for a hermitian X = (x₁₁, x₂₂, Re x₁₂, Im x₁₂)."""
    a, b, c, d = special_linear(A)
    zero = sp.Integer(0)
    rows = [[(X[0], zero), (X[2], X[3])], [(X[2], -X[3]), (X[1], zero)]]

    def entry(left, right):
        total = (zero, zero)
        for i, l in enumerate(left):
            for j, r in enumerate(right):
                total = plus(total, times(times(l, rows[i][j]), (r[0], -r[1])))
        return total

    corner = entry((a, b), (c, d))
    return [entry((a, b), (a, b))[0], entry((c, d), (c, d))[0], corner[0], corner[1]]


def so4(A, B):
    return gibbs(A[:3], B[:3]) + gibbs(A[3:], B[3:])


def euclidean(A, B):
    return gibbs(A[:3], B[:3]) + list(sp.Matrix(A[3:]) + rotation(A[:3]) * sp.Matrix(B[3:]))


def poincare(A, B):
    return lorentz(A[:6], B[:6]) + [x + y for x, y in zip(A[6:], moved(A[:6], B[6:]), strict=True)]


def general_linear(A, B):
    M, N = sp.Matrix(2, 2, A), sp.Matrix(2, 2, B)
    return list(M + N + M * N)


def unitary(A, B):
    return [*gibbs(A[:3], B[:3]), A[3] + B[3]]


def symplectic(A, B):
    M, N = (sp.Matrix([[1 + v[0], v[1]], [v[2], (1 + v[1] * v[2]) / (1 + v[0])]]) for v in (A, B))
    product = M * N
    return [product[0, 0] - 1, product[0, 1], product[1, 0]]


LAWS = [
    (so4, 6, "so(4)", "so(3,1)"), (euclidean, 6, "e(3)", "so(4)"), (lorentz, 6, "so(3,1)", "so(4)"),
    (poincare, 10, "poincare", "e(4)"), (general_linear, 4, "gl(2,R)", "u(2)"), (unitary, 4, "u(2)", "gl(2,R)"),
    (symplectic, 3, "sp(2,R)", "so(3)"),
]  # fmt: skip


@pytest.mark.parametrize(("law", "size", "name", "other"), LAWS)
def test_law(law, size, name, other):
    A, B = (sp.symbols(f"{letter}1:{size + 1}", real=True) for letter in "ab")
    composition = law(list(A), list(B))
    assert verify(group(SPACE, composition, A, B, equals=name), budget=60).status == "proved"
    assert verify(group(SPACE, composition, A, B, equals=other), budget=60).status == "refuted"


@pytest.mark.parametrize("law", [pytest.param(euclidean, marks=pytest.mark.slow), lorentz])
def test_a_thousandth_in_a_law_is_caught(law):
    A, B = (sp.symbols(f"{letter}1:7", real=True) for letter in "ab")
    composition = law(list(A), list(B))
    composition[-1] += A[0] * B[1] / 1000
    assert verify(group(SPACE, composition, A, B, equals="u(1)^6"), budget=60).status == "refuted"
    found = verify(group(SPACE, composition, A, B, structure={"a1,a2": {"a3": -2}}), budget=60)
    assert "associativity" in found.detail["fails"]
