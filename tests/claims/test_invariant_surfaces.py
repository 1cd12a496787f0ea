"""Integral invariants over surfaces, and over states of different times, before and after a map."""

import numpy as np
import pytest

from canon import (
    InputError,
    PhaseSpace,
    Transformation,
    cartan_loop_invariant,
    surface_invariant,
)
from tests.claims.known_loops import TURN, Array, damped, disc, ellipse, henon, leapfrog


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
