import sympy as sp

from canon import PhaseSpace, bracket_matrix, jacobi_sum, lagrange_bracket, lagrange_matrix, poisson_bracket
from canon.mechanics import poisson
from canon.mechanics.poisson import standard_j

SPACE = PhaseSpace("x y z", "px py pz")
X, Y, Z = SPACE.q
PX, PY, PZ = SPACE.p


def test_the_bracket_of_q_and_p_is_one():
    assert poisson_bracket(X, PX, SPACE) == 1
    assert poisson_bracket(PX, X, SPACE) == -1
    assert poisson_bracket(X, PY, SPACE) == 0


def test_angular_momentum_closes(vanishes):
    L = (Y * PZ - Z * PY, Z * PX - X * PZ, X * PY - Y * PX)
    assert vanishes(poisson_bracket(L[0], L[1], SPACE) - L[2])
    matrix = bracket_matrix(L, SPACE, ["L_x", "L_y", "L_z"])
    assert vanishes(matrix.entry("L_y", "L_z") - L[0])
    assert matrix.matrix == -matrix.matrix.T
    assert "L_x" in matrix._repr_latex_()


def test_jacobi(vanishes):
    assert vanishes(jacobi_sum(X**2 * PY, Y * sp.sin(PX), PZ * X + PY**3, SPACE))


def test_lagrange_brackets_invert_poisson_brackets(vanishes):
    space = PhaseSpace("q", "p", new=("Q", "P"))
    (Q,), (P,) = space.Q, space.P
    q, p = P * sp.exp(Q), Q + P**3
    values = poisson_bracket(*(f.xreplace({Q: space.q[0], P: space.p[0]}) for f in (q, p)), space)
    lagrange = lagrange_bracket(Q, P, [q], [p])
    assert vanishes(lagrange - values.xreplace({space.q[0]: Q, space.p[0]: P}))
    assert lagrange_matrix([Q, P], [q], [p]).matrix[0, 1] == lagrange


def test_the_brackets_of_the_coordinates_are_j():
    plane = PhaseSpace("x y", "px py")
    matrix = bracket_matrix([*plane.q, *plane.p], plane)
    assert matrix.matrix == standard_j(2) == sp.Matrix([[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, 0, 0], [0, -1, 0, 0]])
    assert matrix.residual(standard_j(2)) == sp.zeros(4)
    assert matrix.residual(sp.eye(4)) == standard_j(2) - sp.eye(4)
    assert bracket_matrix([X, PX], SPACE)._repr_latex_() == (
        r"$\begin{array}{c|cc} \{\cdot,\cdot\} & x & p_{x} \\ \hline x & 0 & 1 \\ p_{x} & -1 & 0 \end{array}$"
    )


def test_the_sum_of_jacobi_is_cyclic(monkeypatch):
    """It is 0 in any case: what it is a sum of is seen with a bracket that means nothing."""
    B = sp.Function("B")
    monkeypatch.setattr(poisson, "poisson_bracket", lambda f, g, space: B(f, g))
    assert jacobi_sum(X, Y, Z, SPACE) == B(X, B(Y, Z)) + B(Y, B(Z, X)) + B(Z, B(X, Y))


def test_entries_are_shown_over_one_denominator() -> None:
    """Polar coordinates: the matrix of brackets reads as J, whatever the sums that its entries are."""
    x, y, px, py = SPACE.symbols("x y px py")
    r = sp.sqrt(x**2 + y**2)
    radial = (x * px + y * py) / r
    assert bracket_matrix([r, radial], SPACE, ["r", "p_r"])._repr_latex_() == (
        r"$\begin{array}{c|cc} \{\cdot,\cdot\} & r & p_r \\ \hline r & 0 & 1 \\ p_r & -1 & 0 \end{array}$"
    )
