import pytest
import sympy as sp

from canon import (
    GeneratingFunction,
    Hamiltonian,
    InfinitesimalTransformation,
    InputError,
    Lagrangian,
    PhaseSpace,
    PointTransformation,
    Transformation,
    bracket,
    bracket_matrix,
    closed_lie_series,
    compose,
    extended_by_time,
    identity_transformation,
    jacobi_sum,
    poisson_bracket,
    truncated_lie_series,
    verify,
)
from canon.mechanics.time_dependence import hamiltonian_shift, new_hamiltonian_residuals

SPACE = PhaseSpace("q", "p", new=("phi", "I"), positive="m omega I")
q, p, phi, I, m, omega = SPACE.symbols("q p phi I m omega")
BACK = Transformation(SPACE, q=sp.sqrt(2 * I / (m * omega)) * sp.sin(phi), p=sp.sqrt(2 * I * m * omega) * sp.cos(phi))
H = p**2 / (2 * m) + m * omega**2 * q**2 / 2


def test_directions():
    assert BACK.direction == "backward"
    assert BACK.arguments == (phi, I)
    assert BACK.targets == (q, p)
    assert BACK.inverse().direction == "forward"
    assert BACK.inverse().inverse() == BACK


def test_the_symplectic_residual_vanishes_for_the_oscillator(vanishes):
    assert vanishes(BACK.symplectic_residual())
    assert vanishes(BACK.poisson_brackets().residual(SPACE.J))
    assert vanishes(BACK.lagrange_brackets().residual(SPACE.J))


def test_valence_is_that_of_the_forward_map(vanishes):
    doubled = PhaseSpace("q", "p", new=("Q", "P"))
    Q, P = doubled.new
    assert vanishes(Transformation(doubled, Q=2 * doubled.q[0], P=3 * doubled.p[0]).symplectic_residual(6))
    assert vanishes(Transformation(doubled, q=Q / 2, p=P / 3).symplectic_residual(6))


def test_forward_formulas_are_solved_for(vanishes):
    forward = BACK.forward()
    angle, action = forward.expressions
    assert action == m * omega * q**2 / 2 + p**2 / (2 * m * omega)
    assert vanishes(sp.tan(angle) - m * omega * q / p)
    assert vanishes(forward.symplectic_residual())


def test_the_new_hamiltonian_of_the_oscillator():
    assert BACK.transformed(H) == omega * I


def test_composition_is_associative_and_has_the_identity(vanishes):
    space = PhaseSpace("q", "p", new=("Q", "P"), positive="a")
    x, y = space.old
    a = space.symbols("a")
    kick = Transformation(space, Q=x, P=y + a * x**3)
    drift = Transformation(space, Q=x + a * y, P=y)
    turn = Transformation(space, Q=y, P=-x)
    left = turn.after(drift).after(kick)
    right = turn.after(drift.after(kick))
    assert left.expressions == (y + a * x**3, -x - a * (y + a * x**3))
    assert vanishes(u - v for u, v in zip(left.expressions, right.expressions, strict=True))
    same = identity_transformation(space)
    assert kick.after(same).expressions == kick.expressions
    assert same.after(kick).expressions == kick.expressions
    assert vanishes(left.symplectic_residual())


def test_backward_maps_compose_too(vanishes):
    space = PhaseSpace("q", "p", new=("Q", "P"))
    Q, P = space.new
    one = Transformation(space, q=Q, p=P - Q**2)
    two = Transformation(space, q=Q - P, p=P)
    both = compose(one, two)
    assert both.expressions == (Q - P, P - (Q - P) ** 2)
    forward = two.forward().after(one.forward())
    assert vanishes(u - v for u, v in zip(forward.expressions, both.forward().expressions, strict=True))


def test_parameters_of_composed_maps_must_agree():
    spaces = [PhaseSpace("q", "p", new=("Q", "P"), **{word: "a"}) for word in ("real", "positive")]
    maps = [Transformation(s, Q=s.symbols("a") * s.q[0], P=s.p[0] / s.symbols("a")) for s in spaces]
    with pytest.raises(InputError, match="other assumptions"):
        maps[0].after(maps[1])


def test_domains_come_along_in_composition():
    space = PhaseSpace("q", "p", new=("Q", "P"))
    x, y = space.old
    logarithm = Transformation(space, Q=sp.log(x), P=x * y)
    shift = Transformation(space, Q=x + 1, P=y)
    conditions = logarithm.after(shift).Q[0].conditions
    assert [condition.terms for condition in conditions] == [(x + 1,)]


def test_a_rotating_frame_adds_to_the_hamiltonian(vanishes):
    space = PhaseSpace("x y", "px py", new=("X Y", "PX PY"), real="Omega")
    (x, y), (px, py), t, Omega = space.q, space.p, space.t, space.symbols("Omega")
    c, s = sp.cos(Omega * t), sp.sin(Omega * t)
    turning = Transformation(space, Q=(c * x + s * y, -s * x + c * y), P=(c * px + s * py, -s * px + c * py))
    X, Y, PX, PY = space.new
    free = (px**2 + py**2) / 2
    K = (PX**2 + PY**2) / 2 - Omega * (X * PY - Y * PX)
    assert vanishes(turning.transformed(free) - K)
    assert vanishes(new_hamiltonian_residuals(turning, free, K))
    assert not vanishes(new_hamiltonian_residuals(turning, free, K + X**2))
    shift = hamiltonian_shift(turning)
    assert shift is not None
    extended = extended_by_time(turning)
    assert extended == extended_by_time(turning, shift.function)
    assert vanishes(extended.symplectic_residual())
    assert not vanishes(extended_by_time(turning, -shift.function).symplectic_residual())


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Transformation(SPACE, Q=q, P=(p, p)), "2 formulas for 1 variables"),
        (lambda: Transformation(SPACE, Q=q), "given by Q and P"),
        (lambda: Transformation(SPACE), "given by Q and P"),
        (lambda: Transformation(SPACE, Q=q, P=p, q=phi, p=I), "given by Q and P"),
        (lambda: Transformation(SPACE, Q=phi, P=p), "phi cannot occur here"),
        (lambda: Transformation(SPACE, q=q, p=I), "q cannot occur here"),
        (lambda: Transformation(SPACE, Q=0.5 * q, P=2 * p), "floating-point"),
        (lambda: Transformation(SPACE, Q="q", P="p"), "an expression is expected"),
    ],
)
def test_what_is_ill_posed_is_an_input_error(build, message):
    with pytest.raises(InputError, match=message):
        build()


def test_fewer_new_pairs_than_old_ones():
    space = PhaseSpace("x y", "px py", new=("Q", "P"))
    (x, y), (px, py) = space.q, space.p
    down = Transformation(space, Q=x + y, P=(px + py) / 2)
    assert down.symplectic_residual() == sp.zeros(2, 2)
    with pytest.raises(InputError):
        down.inverse()


def test_it_shows_itself_in_latex():
    assert repr(BACK) == f"Transformation({BACK})"
    assert BACK._repr_latex_().startswith("$\\begin{aligned} q &=")


def test_maps_and_generating_functions_read_as_formulas():
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p, Q = space.symbols("q p Q")
    assert str(Transformation(space, Q=[p], P=[-q])) == "Q = p, P = -q"
    F = GeneratingFunction(space, type=1, F=q * Q)
    assert str(F) == "type 1: F(q, Q) = Q*q"
    assert str(F.transformation()) == str(F)


def test_a_variable_is_complex_if_its_formula_is():
    """As in a claim file: else abs(a)**2 would be taken for a**2."""
    space = PhaseSpace("q", "p", new=("a", "b"))
    q, p, a = space.symbols("q p a")
    root = sp.sqrt(2)
    T = Transformation(space, Q=(q + sp.I * p) / root, P=(p + sp.I * q) / root)
    complex_a, complex_b = T.space.symbols("a b")
    assert (a.is_real, complex_a.is_real, complex_a.is_complex) == (True, None, True)
    H = (q**2 + p**2) / 2
    assert verify(T.new_hamiltonian(H, -sp.I * complex_a * complex_b)).status == "proved"
    with pytest.raises(InputError, match="this a is real, and the a of the phase space is complex"):
        T.new_hamiltonian(H, sp.Abs(a) ** 2)
    declared = PhaseSpace("q", "p", new=("a", "b"), real="a b")
    assert Transformation(declared, Q=T.Q, P=T.P).space.symbols("a").is_real
    with pytest.raises(InputError, match=r"nothing is said of its variables.*complex='q p a b'"):
        GeneratingFunction(space, 2, sp.I * q * space.symbols("b"))


def test_a_symbol_that_only_shares_its_name_is_refused():
    """A derivative by the space's q would miss it, and the map would wrongly be refuted."""
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = sp.symbols("q p")
    with pytest.raises(InputError, match=r"transformation, Q: this p is a symbol without assumptions.*space.symbols"):
        Transformation(space, Q=p, P=-q)
    with pytest.raises(InputError, match="key 'f'"):
        bracket(space, q, space.symbols("p"), 1)
    with pytest.raises(InputError, match="generating_function, F"):
        GeneratingFunction(space, 2, q * space.symbols("P"))
    real = Transformation(space, Q=space.symbols("p"), P=-space.symbols("q"))
    with pytest.raises(InputError, match="the Q of the phase space is real"):
        real.pull_back(sp.Symbol("Q") ** 2)
    with pytest.raises(InputError, match="hamiltonian"):
        real.symmetry(q**2 + p**2)
    mine = space.symbols("p")
    for attempt in (
        lambda: poisson_bracket(q, mine, space),
        lambda: bracket_matrix([mine, q], space),
        lambda: jacobi_sum(mine, mine, q, space),
        lambda: Hamiltonian(space, q**2),
        lambda: Hamiltonian(space, mine**2).rate(q),
        lambda: Lagrangian(space, q**2, sp.Symbol("v", real=True)),
        lambda: PointTransformation(space, Q=2 * q),
        lambda: truncated_lie_series(q, mine, sp.Symbol("s"), space, 2),
        lambda: closed_lie_series(mine, q, sp.Symbol("s"), space),
        lambda: InfinitesimalTransformation(space, q),
        lambda: InfinitesimalTransformation(space, mine).change(q),
        lambda: space.where(q > 0),
        lambda: space.where(sp.Eq(q, 0)),
    ):
        with pytest.raises(InputError, match="this q is a symbol without assumptions"):
            attempt()


def test_a_map_of_which_one_half_moves_with_time_adds_to_the_hamiltonian(vanishes):
    """P = p + t q: F₂ = qP − t q²/2 adds −q²/2; and the other half alone, Q = q + t p, adds p²/2."""
    space = PhaseSpace("q", "p", new=("Q", "P"))
    (x, y), P, t = space.old, space.P[0], space.t
    for new, added in (((x, y + t * x), -(x**2) / 2), ((x + t * y, y), y**2 / 2)):
        moved = Transformation(space, Q=new[0], P=new[1])
        shift = hamiltonian_shift(moved)
        assert shift is not None
        assert vanishes((shift.function - added).diff(z) for z in (x, y))
    assert moved.transformed(y**2 / 2) == P**2
    assert hamiltonian_shift(Transformation(space, Q=y, P=-x)).function == 0


PLANE = PhaseSpace("q", "p", new=("Q", "P"))


SQUARE = ("q**2", "p/(2*q)")


@pytest.mark.parametrize(
    ("region", "new", "old"),
    [
        ("q < 0", SQUARE, ("-sqrt(Q)", "-2*P*sqrt(Q)")),
        ("q > 0", SQUARE, ("sqrt(Q)", "2*P*sqrt(Q)")),
        ("-1.001 < q < -1", SQUARE, ("-sqrt(Q)", "-2*P*sqrt(Q)")),
        ("q < 1", ("(q - 1)**2", "p/(2*(q - 1))"), ("1 - sqrt(Q)", "-2*P*sqrt(Q)")),
        ("q < 0", ("q**3", "p/(3*q**2)"), ("-(-Q)**(1/3)", "3*P*(-Q)**(2/3)")),
        ("q < 0", ("cosh(q)", "p/sinh(q)"), None),
    ],
)
def test_the_domain_chooses_the_branch(region: str, new: tuple[str, str], old: tuple[str, str] | None) -> None:
    space = PLANE.where(region)
    forward = Transformation(space, Q=space.formula(new[0]), P=space.formula(new[1]))
    back = forward.backward()
    if old is not None:
        wanted = [space.formula(text).expr for text in old]
        assert [sp.simplify(a - b) for a, b in zip(back.expressions, wanted, strict=True)] == [0, 0]
    q, p, Q, P = map(space.symbol, "qpQP")
    at = {q: -sp.Rational(2001, 2000) if "q >" not in region else sp.Rational(1, 3), p: sp.Rational(3, 7)}
    image = dict(zip((Q, P), (value.subs(at) for value in forward.expressions), strict=True))
    assert abs(complex((forward.transformed(q**3 + p).subs(image) - (q**3 + p).subs(at)).evalf())) < 1e-12


def test_without_a_domain_that_chooses_there_is_no_one_new_hamiltonian() -> None:
    q, p, Q, P = map(PLANE.symbol, "qpQP")
    square = Transformation(PLANE, Q=q**2, P=p / (2 * q))
    assert sp.simplify(square.transformed(q**2 + q * p) - Q - 2 * P * Q) == 0
    with pytest.raises(InputError, match="H is not one function of the new variables throughout the domain"):
        square.transformed(q**3)
