import pytest
import sympy as sp

from canon import InputError, PhaseSpace, PointTransformation

SPACE = PhaseSpace("x y", "px py", new=("r theta", "p_r p_theta"), positive="r")
(x, y), (px, py) = SPACE.q, SPACE.p
r, theta, p_r, p_theta = SPACE.new
POLAR = PointTransformation(SPACE, q=(r * sp.cos(theta), r * sp.sin(theta)))


def test_polar_momenta(vanishes):
    """Goldstein, Poole and Safko (2002), section 9.2: p_r = (x px + y py)/r, p_theta = x py - y px."""
    lift = POLAR.lift()
    assert vanishes(lift.symplectic_residual())
    forward = lift.forward()
    assert forward.Q[0].expr == sp.sqrt(x**2 + y**2)
    assert forward.Q[1].expr == sp.atan2(y, x)
    assert vanishes(forward.P[0].expr - (x * px + y * py) / sp.sqrt(x**2 + y**2))
    assert vanishes(forward.P[1].expr - (x * py - y * px))


def test_its_generating_function_gives_the_same_map(vanishes):
    generated = POLAR.generating_function().transformation().backward()
    assert vanishes(u - v for u, v in zip(generated.expressions, POLAR.lift().expressions, strict=True))


def test_spherical_coordinates_are_solved_for():
    space = PhaseSpace("x y z", "px py pz", new=("r theta phi", "p_r p_theta p_phi"), positive="r")
    R, t, f = space.Q
    forms = (R * sp.sin(t) * sp.cos(f), R * sp.sin(t) * sp.sin(f), R * sp.cos(t))
    forward = PointTransformation(space, q=forms).lift().forward()
    X, Y, Z = space.q
    assert [formula.expr for formula in forward.Q] == [
        sp.sqrt(X**2 + Y**2 + Z**2),
        sp.atan2(sp.sqrt(X**2 + Y**2), Z),
        sp.atan2(Y, X),
    ]


@pytest.mark.parametrize("forward", [True, False])
def test_a_gauge_function_shifts_the_momenta(forward, vanishes):
    space = PhaseSpace("x y", "px py", new=("X Y", "PX PY"), real="B")
    B, t = space.symbols("B"), space.t
    u, v = space.q if forward else space.Q
    forms = (u + v**3, v + t)
    gauge = B * u * v**2 + t * u
    given = {"Q": forms} if forward else {"q": forms}
    point = PointTransformation(space, **given, shift=gauge)
    lift = point.lift()
    assert vanishes(lift.symplectic_residual())
    direction = "forward" if forward else "backward"
    generated = getattr(point.generating_function().transformation(), direction)()
    assert vanishes(a - b for a, b in zip(generated.expressions, lift.expressions, strict=True))


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: PointTransformation(SPACE, q=(r, r)).lift(), "not independent"),
        (lambda: PointTransformation(SPACE, q=(r,)), "1 formulas for 2 coordinates"),
        (lambda: PointTransformation(SPACE, q=(r, p_r)), "p_r cannot occur"),
        (lambda: PointTransformation(SPACE), "given by Q or by q"),
    ],
)
def test_what_is_ill_posed_is_an_input_error(build, message):
    with pytest.raises(InputError, match=message):
        build()
