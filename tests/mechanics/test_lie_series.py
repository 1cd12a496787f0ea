import pytest
import sympy as sp

from canon import InfinitesimalTransformation, InputError, PhaseSpace, closed_lie_series, truncated_lie_series

SPACE = PhaseSpace("q", "p", new=("Q", "P"), positive="m omega", real="s g")
q, p, m, omega, s, g = SPACE.symbols("q p m omega s g")
OSCILLATOR = p**2 / (2 * m) + m * omega**2 * q**2 / 2


def agree(closed: sp.Expr, f: sp.Expr, G: sp.Expr, order: int = 4) -> list[sp.Expr]:
    """The derivatives at s = 0 of the closed form less those of the series."""
    series = truncated_lie_series(f, G, s, SPACE, order)
    return [(closed - series).diff(s, k).subs(s, 0) for k in range(order + 1)]


@pytest.mark.parametrize(
    ("f", "G"),
    [
        (q, OSCILLATOR),
        (p**2, OSCILLATOR),
        (q**3, OSCILLATOR),
        (q + p**2, OSCILLATOR),
        (sp.sin(q), OSCILLATOR),
        (p, q**4),
        (q, p**2 / 2 + g * q),
        (q * p + q, q * p),
        (p, q**2 * p),
        (q**2, q**2 * p),
        (q, OSCILLATOR**2),
        (q, p**2 / 2 - q**2 / 2),
    ],
)
def test_closed_forms_agree_with_their_series(f, G, vanishes):
    closed = closed_lie_series(f, G, s, SPACE)
    assert closed is not None
    assert vanishes(agree(closed, f, G))


def test_known_sums():
    assert closed_lie_series(q, OSCILLATOR, s, SPACE) == q * sp.cos(omega * s) + p * sp.sin(omega * s) / (m * omega)
    assert closed_lie_series(p, q * p, s, SPACE) == p * sp.exp(-s)
    assert closed_lie_series(p, q**3, s, SPACE) == p - 3 * s * q**2
    assert closed_lie_series(q, q**2 * p, s, SPACE) == q / (1 - s * q)


def test_what_has_no_closed_form_is_none():
    assert closed_lie_series(q, p**2 / 2 + q**4, s, SPACE) is None


def test_what_moves_with_something_unknown_has_no_closed_form():
    """Beside a free coordinate one in a quartic well; a function of both is no sum, and none of one alone."""
    space = PhaseSpace("x y", "px py", real="s")
    (x, y), (px, py), t = space.q, space.p, space.symbols("s")
    G = px**2 / 2 + py**2 / 2 + y**4
    assert closed_lie_series(x**2, G, t, space) == sp.expand((x + t * px) ** 2)
    assert closed_lie_series(x * sp.sin(y), G, t, space, depth=1) is None


def test_coupled_oscillators(vanishes):
    """ẍ = −x − y/2, ÿ = −y − x/2: a recurrence of four terms, frequencies √(3/2) and √(1/2)."""
    space = PhaseSpace("x y", "px py", real="s")
    (x, y), (px, py), t = space.q, space.p, space.symbols("s")
    H = (px**2 + py**2 + x**2 + y**2 + x * y) / 2
    closed = closed_lie_series(x, H, t, space)
    assert closed is not None
    series = truncated_lie_series(x, H, t, space, 5)
    assert vanishes((closed - series).diff(t, k).subs(t, 0) for k in range(6))


def test_a_magnetic_field(vanishes):
    space = PhaseSpace("x y", "px py", real="B s")
    (x, y), (px, py), (B, t) = space.q, space.p, space.symbols("B s")
    H = ((px + B * y / 2) ** 2 + (py - B * x / 2) ** 2) / 2
    closed = closed_lie_series(x, H, t, space)
    assert closed is not None
    series = truncated_lie_series(x, H, t, space, 4)
    assert vanishes((closed - series).diff(t, k).subs(t, 0) for k in range(5))


def test_a_generator_moves_the_variables(vanishes):
    turn = InfinitesimalTransformation(SPACE, (q**2 + p**2) / 2)
    assert turn.changes() == ((p,), (-q,))
    assert turn.change(q) == p
    finite = turn.finite(s)
    assert vanishes(finite.symplectic_residual())
    assert vanishes(
        u - v
        for u, v in zip(finite.expressions, (q * sp.cos(s) + p * sp.sin(s), p * sp.cos(s) - q * sp.sin(s)), strict=True)
    )
    assert turn.finite(s, order=1).expressions == (q + s * p, p - s * q)


def test_without_a_closed_form_an_order_is_asked_for():
    with pytest.raises(InputError, match="give an order"):
        InfinitesimalTransformation(SPACE, p**2 / 2 + q**4).finite(s)


def test_a_function_is_summed_by_itself_where_the_flow_of_its_variables_is_not_found():
    """The pendulum's energy: its variables move by elliptic functions, and it doesn't move."""
    space = PhaseSpace("q", "p")
    x, y = space.symbols("q p")
    energy = y**2 / 2 - sp.cos(x)
    assert closed_lie_series(energy, energy, sp.Symbol("s"), space, depth=1) == energy
