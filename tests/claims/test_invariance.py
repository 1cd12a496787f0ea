"""Integral invariants of maps: exact values, known changes, what isn't resolved, angles, and time."""

import json

import numpy as np
import pytest
import sympy as sp

from canon import (
    InputError,
    NotInvariant,
    PhaseSpace,
    Transformation,
    cartan_loop_invariant,
    loop_invariant,
    surface_invariant,
)

Array = np.ndarray
TURN = 2 * np.pi


def ellipse(s: Array) -> Array:
    """Half-axes 2 and 0.7: ∮ p dq = −1.4 π."""
    return np.stack([0.3 + 2 * np.cos(TURN * s), 1 + 0.7 * np.sin(TURN * s)], axis=1)


def disc(u: Array) -> Array:
    """The ellipse filled: by Stokes's theorem ∬ dp∧dq = −1.4 π too."""
    r, angle = u[:, 0], TURN * u[:, 1]
    return np.stack([0.3 + 2 * r * np.cos(angle), 1 + 0.7 * r * np.sin(angle)], axis=1)


def leapfrog(q: Array, p: Array, h: float = 0.1) -> tuple[Array, Array]:
    for _ in range(10):
        p = p - h / 2 * np.sin(q)
        q = q + h * p
        p = p - h / 2 * np.sin(q)
    return q, p


def henon(z: Array) -> Array:
    return np.array([1 - 1.4 * z[0] ** 2 + z[1], 0.3 * z[0]])


def damped(q: Array, p: Array) -> tuple[Array, Array]:
    """Multiplies areas by 0.9, wherever they are."""
    return q + 0.1 * p, 0.9 * p


# -- loops -------------------------------------------------------------------------------------


def test_a_symplectic_step_keeps_the_loop_integral() -> None:
    found = loop_invariant(leapfrog, ellipse)
    assert found.preserved is True
    assert found.before == pytest.approx(-1.4 * np.pi, abs=found.found.before.bound)
    assert abs(found.difference) <= found.bound < 1e-11
    assert found.require() is found


def test_a_known_change_is_found() -> None:
    found = loop_invariant(damped, ellipse)
    assert found.preserved is False
    assert found.verdict == "undecided"
    assert found.difference == pytest.approx(0.1 * 1.4 * np.pi, rel=1e-12)
    with pytest.raises(NotInvariant, match="changes by more than rounding"):
        found.require()
    with pytest.raises(TypeError, match="neither true nor false"):
        bool(found)


def test_a_change_of_a_billionth_is_found() -> None:
    found = loop_invariant(lambda q, p: (q, (1 + 1e-9) * p), ellipse)
    assert found.preserved is False
    assert found.difference == pytest.approx(-1.4e-9 * np.pi, rel=1e-3)


def test_valence() -> None:
    assert loop_invariant(henon, ellipse, scale=-0.3).preserved is True
    found = loop_invariant(henon, ellipse)
    assert found.preserved is False
    assert found.after == pytest.approx(0.3 * 1.4 * np.pi, rel=1e-13)
    with pytest.raises(InputError, match="scale"):
        loop_invariant(henon, ellipse, scale=0.0)


def test_what_is_not_resolved_is_said() -> None:
    found = loop_invariant(lambda q, p: (q, np.abs(p - 1)), ellipse, most_nodes=1024)
    assert found.preserved is None
    assert found.verdict == "undecided"
    assert "1024 nodes: not resolved" in str(found)
    assert "nothing is known" in str(found)


def test_single_precision_is_measured_against_its_own_rounding() -> None:
    def rounded(q: Array, p: Array) -> tuple[Array, Array]:
        new_q, new_p = leapfrog(np.asarray(q, np.float32), np.asarray(p, np.float32), np.float32(0.1))
        return np.asarray(new_q, np.float32), np.asarray(new_p, np.float32)

    found = loop_invariant(rounded, ellipse)
    assert found.preserved is True
    assert 1e-8 < found.bound < 1e-3
    coarse = loop_invariant(lambda q, p: damped(*rounded(q, p)), ellipse)
    assert coarse.preserved is False


def test_points_of_a_loop_without_the_loop() -> None:
    nodes = ellipse(np.arange(256) / 256)
    assert loop_invariant(leapfrog, nodes).preserved is True
    few = loop_invariant(leapfrog, nodes[::16])
    assert few.preserved is None
    odd = loop_invariant(leapfrog, ellipse(np.arange(301) / 301))
    assert odd.preserved is True
    with pytest.raises(InputError, match="8 points at least"):
        loop_invariant(leapfrog, nodes[::64])


def test_a_loop_that_winds_round_an_angle() -> None:
    """Round the origin the action is ∮ p dq / 2π, and the angle gains a whole turn."""
    space = PhaseSpace("q", "p", new=("phi", "I"), positive="m omega")
    q, p, m, omega = space.symbols("q p m omega")
    action = (p**2 / (2 * m) + m * omega**2 * q**2 / 2) / omega
    polar = Transformation(space, Q=(sp.atan2(m * omega * q, p),), P=(action,))

    def circle(s: Array) -> Array:
        return np.stack([np.sin(TURN * s), np.cos(TURN * s)], axis=1)

    values = {"m": 2.0, "omega": 3.0}
    found = loop_invariant(polar, circle, parameters=values, new_periods=(TURN, None))
    assert found.preserved is True
    assert found.after == pytest.approx(np.pi, abs=1e-12)
    assert loop_invariant(polar, circle, parameters=values, most_nodes=512).preserved is None


def test_the_standard_map_on_the_cylinder() -> None:
    """An exact map keeps ∮ p dq round the cylinder, a shift of p changes it by 2π times the shift."""

    def round_it(s: Array) -> Array:
        return np.stack([TURN * s, 0.2 + 0.1 * np.cos(TURN * s)], axis=1)

    def kick(q: Array, p: Array, shift: float = 0.0) -> tuple[Array, Array]:
        p = p + 0.9 * np.sin(q) + shift
        return np.mod(q + p, TURN), p

    angle = (TURN, None)
    assert loop_invariant(kick, round_it, periods=angle, new_periods=angle).preserved is True
    shifted = loop_invariant(lambda q, p: kick(q, p, 0.5), round_it, periods=angle, new_periods=angle)
    assert shifted.preserved is False
    assert shifted.difference == pytest.approx(np.pi, rel=1e-12)


def test_a_backward_map_is_taken_as_it_is_written() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"))
    Q, P = space.symbols("Q P")
    back = Transformation(space, q=(Q / 2,), p=(P / 3,))
    assert loop_invariant(back, ellipse, scale=6.0).preserved is True


@pytest.mark.parametrize(
    ("loop", "message"),
    [
        (lambda s: np.stack([s, s**2], axis=1), "not closed"),
        (lambda s: np.stack([s, s, s], axis=1), "N, 2n"),
        (lambda s: s, "points"),
        (None, "a loop takes parameters"),
        (lambda s: np.stack([np.cos(TURN * s), np.log(s - 2)], axis=1), "finite"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
def test_what_is_no_loop(loop, message: str) -> None:
    with pytest.raises(InputError, match=message):
        loop_invariant(leapfrog, loop)


def test_what_goes_wrong_after_the_map_is_said_to_be_there() -> None:
    with pytest.raises(InputError, match="after the map, the loop has a point that is not finite"):
        loop_invariant(lambda q, p: (q, np.where(q > 2, np.nan, p)), ellipse)


def test_records() -> None:
    record = json.loads(json.dumps(loop_invariant(damped, ellipse).as_record()))
    assert record["integral"] == "∮ p dq"
    assert record["preserved"] is False
    assert record["before"]["resolved"] is True
    rough = loop_invariant(lambda q, p: (q, np.abs(p - 1)), ellipse, most_nodes=32)
    assert json.loads(json.dumps(rough.as_record()))["after"]["change"] == "nan"


# -- surfaces ----------------------------------------------------------------------------------


def test_the_area_of_an_ellipse() -> None:
    found = surface_invariant(leapfrog, disc, periodic=(False, True))
    assert found.preserved is True
    assert found.before == pytest.approx(-1.4 * np.pi, abs=1e-13)
    assert abs(found.difference) <= found.bound < 1e-10


def test_areas_that_change_by_a_known_amount() -> None:
    assert surface_invariant(henon, disc, periodic=(False, True), scale=-0.3).preserved is True
    found = surface_invariant(damped, disc, periodic=(False, True))
    assert found.preserved is False
    assert found.difference == pytest.approx(0.1 * 1.4 * np.pi, rel=1e-11)


def patch(u: Array) -> Array:
    """A curved four-dimensional patch of R⁶, in the order q1 q2 q3 p1 p2 p3."""
    a, b, c, d = u.T
    return np.stack([a + b * c / 5, b - a * d / 4, a * b / 3, c + a**2 / 6, d + b * c / 7, c - d], axis=1)


def linear(z: Array) -> Array:
    """A symplectic map of R⁶ that mixes the pairs: a shear in p, then one in q."""
    S = np.array([[1.0, 0.4, 0.0], [0.4, -0.5, 0.3], [0.0, 0.3, 0.2]])
    q, p = z[..., :3], z[..., 3:]
    p = p + q @ S
    return np.concatenate([q + p @ S, p], axis=-1)


def test_the_second_invariant() -> None:
    found = surface_invariant(linear, patch, periodic=(False,) * 4)
    assert found.preserved is True
    assert found.name == "∫ ω^2/2!"
    scaled = surface_invariant(
        lambda z: linear(z) * np.array([2, 2, 2, 3, 3, 3]), patch, periodic=(False,) * 4, scale=6
    )
    assert scaled.preserved is True
    assert scaled.after == pytest.approx(36 * found.before, rel=1e-12)


def test_the_third_invariant_of_a_step_that_is_not_linear() -> None:
    """∫ ω³/3! over a box of six dimensions: by Gauss's nodes, of which a third more are taken each time."""
    turned = np.array([[np.cos(i * j + 1.0) for j in range(6)] for i in range(6)]) / 10

    def cells(u: Array) -> Array:
        return (u - 0.5) @ turned

    def step(z: Array, more: float = 0.0) -> Array:
        q, p = z[..., :3], z[..., 3:]
        p = p - 0.3 * np.sin(q) - 0.1 * q.sum(axis=-1, keepdims=True) ** 2
        return np.concatenate([q + 0.3 * (1 + more) * p + more * q, p], axis=-1)

    found = surface_invariant(step, cells, periodic=(False,) * 6)
    assert found.preserved is True
    assert max(found.found.after.nodes) <= 8
    other = surface_invariant(lambda z: step(z, more=1e-9), cells, periodic=(False,) * 6)
    assert other.preserved is False
    assert other.after / other.before - 1 == pytest.approx(3e-9, rel=0.01)


def test_a_map_of_volume_one_that_keeps_no_areas() -> None:
    """(q1, p1) doubled, (q2, p2) halved: the second invariant is the volume, the first is not kept."""

    def stretched(z: Array) -> Array:
        return z * np.array([2.0, 0.5, 2.0, 0.5])

    def box(u: Array) -> Array:
        return u[:, [0, 1, 2, 3]] + u[:, [1, 2, 3, 0]] ** 2 / 5

    def sheet(u: Array) -> Array:
        return np.stack([u[:, 0], u[:, 1], u[:, 1], u[:, 0] ** 2], axis=1)

    assert surface_invariant(stretched, box, periodic=(False,) * 4).preserved is True
    assert surface_invariant(stretched, sheet, periodic=(False,) * 2).preserved is False


def test_the_volume_of_a_ball() -> None:
    """π²/2 of the unit ball of R⁴, in Hopf's coordinates."""

    def ball(u: Array) -> Array:
        r, tilt, a, b = u[:, 0], u[:, 1] * np.pi / 2, TURN * u[:, 2], TURN * u[:, 3]
        near, far = r * np.cos(tilt), r * np.sin(tilt)
        return np.stack([near * np.cos(a), far * np.cos(b), near * np.sin(a), far * np.sin(b)], axis=1)

    found = surface_invariant(lambda z: z, ball, periodic=(False, False, True, True), most_points=2**17)
    assert found.preserved is True
    assert abs(found.before) == pytest.approx(np.pi**2 / 2, abs=1e-12)


def test_a_surface_that_is_not_resolved_is_said_to_be_so() -> None:
    found = surface_invariant(
        lambda z: np.array([z[0], abs(z[1] - 1)]), disc, periodic=(False, True), most_points=2**12
    )
    assert found.preserved is None
    assert "not resolved" in str(found)


def test_nodes_are_not_fooled_by_a_fast_surface() -> None:
    """With 16 and with 32 nodes, 64 turns look like standing still."""

    def turns(u: Array) -> Array:
        angle = 64 * TURN * u[:, 1]
        return np.stack([u[:, 0] * np.cos(angle), u[:, 0] * np.sin(angle)], axis=1)

    found = surface_invariant(lambda z: z, turns, periodic=(False, True))
    assert found.preserved is True
    assert found.before == pytest.approx(-64 * np.pi, abs=1e-9)


@pytest.mark.parametrize(
    ("surface", "periodic", "message"),
    [
        (lambda u: u, (True, False), "does not close in direction 1"),
        (lambda u: u, (False,), "2, 4, 6"),
        (lambda u: u, True, "for each direction"),
        (lambda u: u[:, :3], (False,) * 4, "N, 2n"),
        (lambda u: u[:, :2], (False,) * 4, "no surface of 4"),
    ],
)
def test_what_is_no_surface(surface, periodic: tuple[bool, ...], message: str) -> None:
    with pytest.raises(InputError, match=message):
        surface_invariant(lambda z: z, surface, periodic=periodic)


# -- with time ---------------------------------------------------------------------------------


def states(s: Array) -> Array:
    a = TURN * s
    return np.stack([np.cos(a), 1.5 * np.sin(a), 0.4 * np.sin(a) + 0.1 * np.cos(2 * a)], axis=1)


def carried(z: Array, t: float) -> tuple[Array, float]:
    """The oscillator's flow, each state for a time of its own."""
    duration = 0.3 + 0.2 * z[0] * z[1]
    c, s = np.cos(duration), np.sin(duration)
    return np.array([c * z[0] + s * z[1], c * z[1] - s * z[0]]), t + duration


def test_a_flow_keeps_the_integral_of_poincare_and_cartan() -> None:
    energy = lambda z, t: (z[0] ** 2 + z[1] ** 2) / 2
    assert cartan_loop_invariant(carried, states, H=energy).preserved is True
    wrong = cartan_loop_invariant(carried, states, H=lambda z, t: energy(z, t) * 1.001)
    assert wrong.preserved is False
    assert cartan_loop_invariant(carried, states(np.arange(128) / 128), H=energy).preserved is True


def test_a_transformation_that_depends_on_time() -> None:
    """Into a frame that moves with velocity v: K = H − v P + …, by a Galilei boost."""
    space = PhaseSpace("q", "p", new=("Q", "P"), positive="m v")
    q, p, t, m, v = space.symbols("q p t m v")
    Q, P = space.symbols("Q P")
    boost = Transformation(space, Q=(q - v * t,), P=(p - m * v,))
    H = p**2 / (2 * m)
    values = {"m": 2.0, "v": 0.7}
    right = cartan_loop_invariant(boost, states, H=H, K=P**2 / (2 * m), parameters=values)
    assert right.preserved is True
    wrong = cartan_loop_invariant(boost, states, H=H, K=P**2 / m + Q**2, parameters=values)
    assert wrong.preserved is False
    with pytest.raises(InputError, match="no parameter"):
        cartan_loop_invariant(boost, states, H=H, parameters={"mass": 1.0})


def test_states_have_a_time() -> None:
    with pytest.raises(InputError, match="the time last"):
        cartan_loop_invariant(carried, ellipse, H=lambda z, t: 0.0)
    with pytest.raises(InputError, match="returns Z"):
        cartan_loop_invariant(lambda z, t: z[:1], states, H=lambda z, t: 0.0)
    with pytest.raises(InputError, match="real number"):
        cartan_loop_invariant(carried, states, H=lambda z, t: z)
