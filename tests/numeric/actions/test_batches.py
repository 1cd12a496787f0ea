"""Actions of many orbits at once, in double precision, against closed forms of 50 digits and more."""

from typing import Any

import jax
import jax.numpy as jnp
import mpmath as mp
import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.actions.central import central_actions
from canon.numeric.actions.isochrone import isochrone_actions, isochrone_angle
from canon.numeric.actions.motion import motion
from canon.numeric.actions.pendulum import pendulum_actions, pendulum_angle
from canon.numeric.precision import double

COUNT = 60


def orbits(b: float, eccentricity: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Orbits of the isochrone around circles of several radii: L_c² = r⁴/(s (b + s)²)."""
    rng = np.random.default_rng(5)
    r = np.exp(rng.normal(size=COUNT))
    s = np.sqrt(b * b + r * r)
    L = np.sqrt(r**4 / (s * (b + s) ** 2))
    across, along = rng.normal(size=(2, COUNT)) * eccentricity / 3
    return r, along * L / r, L * (1 + across)


def isochrone_reference(r: float, p: float, L: float, m: float, a: float, b: float) -> tuple[Any, Any, Any]:
    """J_r and both frequencies, from H = −(ma²/2)/(J_r/2π + ½(L + √(L² + 4amb)))², with 60 digits."""
    with mp.workdps(60):
        r, p, L, m, a, b = map(mp.mpf, (r, p, L, m, a, b))
        E = (p**2 + L**2 / r**2) / (2 * m) - a / (b + mp.sqrt(b * b + r * r))
        root = mp.sqrt(L * L + 4 * a * m * b)
        rate = (-2 * m * E) ** mp.mpf(1.5) / (2 * mp.pi * a * m * m)
        return 2 * mp.pi * (a * m / mp.sqrt(-2 * m * E) - (L + root) / 2), rate, rate * (1 + L / root) / 2


@pytest.mark.parametrize("b", [0.0, 1.0])
@pytest.mark.parametrize("eccentricity", [0.3, 1e-6, 1e-9])
def test_closed_forms_keep_the_digits_of_the_state(b: float, eccentricity: float) -> None:
    r, p, L = orbits(b, eccentricity)
    m, a = 1.5, 0.7
    p, L = p * np.sqrt(a * m), L * np.sqrt(a * m)
    with double():
        # with the potential known when it is compiled: a compiler that reassociates constants must not see them
        found = jax.jit(lambda *state: isochrone_actions(*state, m=m, a=a, b=b))(*map(jnp.asarray, (r, p, L)))
        rows = [np.asarray(x) for x in found]
    for k in range(COUNT):
        exact = isochrone_reference(r[k], p[k], L[k], m, a, b)
        error = abs(mp.mpf(float(rows[0][k])) - exact[0])
        assert error <= rows[4][k] <= 3e-15 * exact[0]
        assert error <= 9e-16 * exact[0]
        assert abs(rows[2][k] / exact[1] - 1) < 9e-16
        assert abs(rows[3][k] / exact[2] - 1) < 9e-16


def test_orbits_that_are_hardly_bound_and_those_that_are_not() -> None:
    """E → 0−: −2mE in double-double arithmetic has all its digits."""
    with double():
        p = np.sqrt(1.75 - np.array([1e-6, 1e-10, 1e-14]))
        found = isochrone_actions(jnp.ones(3), jnp.asarray(p), 0.5 * jnp.ones(3))
        for k in range(3):
            exact = isochrone_reference(1.0, p[k], 0.5, 1.0, 1.0, 0.0)
            assert abs(float(found.radial[k]) / exact[0] - 1) < 9e-16
        assert bool(jnp.isnan(isochrone_actions(1.0, 1.5, 0.5).radial))


def test_the_angle_of_the_isochrone() -> None:
    moved = motion("p**2/2 + 1/(8*q**2) - 1/(1 + sqrt(1 + q**2))", domain=(0, float("inf")))
    with double():
        for r, p in ((1.5, -0.1), (1.5, 0.1), (0.7, 0.3)):
            angle = moved.at(r, p).angle
            assert angle is not None
            assert abs(float(isochrone_angle(r, p, 0.5, b=1.0)) - angle.value) < 4e-16


@pytest.mark.parametrize("b", [0.0, 1e-3, 1.0])
def test_the_angle_of_a_nearly_radial_orbit(b: float) -> None:
    """At b = 0 it lost twice as many digits as L has zeros."""
    for L in (0.1, 1e-4, 1e-8, 1e-12):
        for r, p in ((1.0, 0.3), (1.5, -0.2)):
            with double():
                found = float(isochrone_angle(r, p, L, b=b))
            with mp.workdps(60):
                R, P, M, B = map(mp.mpf, (r, p, L, b))
                E = (P**2 + M**2 / R**2) / 2 - 1 / (B + mp.sqrt(B * B + R * R))
                c = -1 / (2 * E) - B
                e = mp.sqrt(1 - M**2 / c * (1 + B / c))
                eta = mp.acos((1 - (mp.sqrt(B * B + R * R) - B) / c) / e)
                eta = 2 * mp.pi - eta if p < 0 else eta
                assert abs(found - (eta - e * c / (c + B) * mp.sin(eta)) / (2 * mp.pi)) < 1e-14


def test_the_pendulum_from_the_bottom_to_beyond_the_separatrix() -> None:
    """15 digits for 1 − m from 0.5 to 1e-300, given as such, on both sides. sec-14.5-c."""
    distances = [0.5, 0.49, 0.1, 1e-3, 1e-8, 1e-16, 1e-100, 1e-300]
    given = np.array([*distances, *(-x for x in distances), 0.6, 0.9, -1.0, -30.0])
    with double():
        found = pendulum_actions(jnp.asarray(given), inertia=2.0, strength=8.0)
        action, period = (np.asarray(x) for x in found[:2])
    with mp.workdps(330):
        for k, value in enumerate(given):
            m1 = mp.mpf(float(value))
            m = 1 - m1
            exact = (
                (16 * (mp.ellipe(m) - m1 * mp.ellipk(m)), 4 * mp.ellipk(m)) if m1 > 0
                else (8 * mp.sqrt(m) * mp.ellipe(1 / m), 2 * mp.ellipk(1 / m) / mp.sqrt(m))
            )  # fmt: skip
            assert abs(mp.mpf(float(action[k])) / (4 * exact[0]) - 1) < 5e-16
            assert abs(mp.mpf(float(period[k])) / (exact[1] / 2) - 1) < 5e-16


def test_the_pendulum_at_the_bottom_and_on_the_separatrix() -> None:
    with double():
        small = jax.jit(pendulum_actions)(above_bottom=jnp.array([1e-200, 1e-5]))
        with mp.workdps(40):
            m = mp.mpf(1e-5)
            assert abs(float(small.action[1]) / (16 * (mp.ellipe(m) - (1 - m) * mp.ellipk(m))) - 1) < 5e-16
        assert float(small.action[0]) == pytest.approx(4 * np.pi * 1e-200, rel=4e-16)
        edge = jax.jit(pendulum_actions)(jnp.array([0.0, 1e-30, -1e-30, 2.0]))
        assert [float(x) for x in edge.action[:3]] == [16.0, 16.0, 8.0]
        assert float(edge.period[0]) == np.inf
        assert bool(jnp.isnan(edge.action[3]))


@pytest.mark.parametrize(
    ("cosine", "momentum"), [(0.3, 0.1), (1e-3, -9e-4), (1e-150, 0.9e-150), (0.1, 0.2), (1e-100, -2e-100)]
)
@pytest.mark.parametrize("side", [1, -1])
def test_angles_of_the_pendulum(cosine: float, momentum: float, side: int) -> None:
    sine = side * np.sqrt(1 - cosine**2)
    with double():
        w = float(pendulum_angle(sine, cosine, momentum))
    with mp.workdps(340):
        c, p = mp.mpf(cosine), mp.mpf(momentum)
        s = side * mp.sqrt(1 - c * c)
        m = s * s + p * p
        if c * c > p * p:
            part = mp.ellipf(mp.asin(s / mp.sqrt(m)), m) / mp.ellipk(m)
            exact = (1 + (2 - part if p < 0 else part)) / 4
        else:
            part = mp.ellipf(mp.asin(s), 1 / m) / mp.ellipk(1 / m)
            exact = (1 + (-part if p < 0 else part)) / 2
        assert abs(w - (exact - mp.floor(exact))) < 5e-16


@pytest.mark.slow
def test_any_central_potential() -> None:
    b, V = 1.0, "-k/(1 + sqrt(1 + r**2))"
    for eccentricity, most in ((0.3, 1e-11), (1e-3, 2e-11), (1e-6, 2e-8)):
        r, p, L = orbits(b, eccentricity)
        with double():
            exact = isochrone_actions(jnp.asarray(r), jnp.asarray(p), jnp.asarray(L), b=b)
            exact = [np.asarray(x) for x in exact]
        found = central_actions(V, r, p, L, parameters={"k": 1.0})
        assert np.all(np.abs(found.radial - exact[0]) <= found.bound)
        assert np.median(found.bound / exact[0]) < most
        assert np.allclose(found.radial_frequency, exact[2], rtol=1e-10, atol=0)
        assert np.allclose(found.azimuthal_frequency, exact[3], rtol=1e-11, atol=0)
        assert np.array_equal(found.azimuthal, 2 * np.pi * L)


@pytest.mark.parametrize(
    ("b", "state"),
    [
        pytest.param(1.0, (228.47656556327163, -0.011197773447956508, 7.629907728630332e-06), marks=pytest.mark.slow),
        pytest.param(1e-3, (150.81976651060782, 0.0, 4.151236409508389e-07), marks=pytest.mark.slow),
        (1e-2, (1000.0, 0.0, 1e-6)),
    ],
)
def test_the_bound_holds_where_an_orbit_passes_by_a_small_core(b: float, state: tuple[float, float, float]) -> None:
    """Sixteen nodes and thirty-two agree there to 1e-8 by chance, and J_r has the core as a small part of itself."""
    found = central_actions("-1/(b + sqrt(b**2 + r**2))", *state, parameters={"b": b})
    exact = isochrone_reference(*state, 1.0, 1.0, b)[0]
    assert abs(mp.mpf(float(found.radial)) - exact) <= found.bound <= 1e-11 * exact


def test_a_logarithmic_potential_with_a_mass_against_balls() -> None:
    found = central_actions("log(r)", [1.0, 1.0, 2.0], [0.1, 2.0, 0.0], [1.0, 0.01, 1.0], m=2.0)
    for k, (r, p, L) in enumerate(((1, "0.1", 1), (1, 2, "0.01"), (2, 0, 1))):
        moved = motion("p**2/4 + L**2/(4*q**2) + log(q)", domain=(0, float("inf")), parameters={"L": L})
        orbit = moved.at(r, p)
        assert orbit.frequency is not None
        assert abs(found.radial[k] - orbit.action.value) <= found.bound[k] + orbit.action.bound
        assert found.bound[k] < 2e-13 * found.radial[k]
        assert abs(found.radial_frequency[k] / orbit.frequency.value - 1) < 1e-12


@pytest.mark.parametrize(
    ("V", "state", "message"),
    [
        ("-1/r", ([1.0, 1.0], [0.0, 2.0], [1.0, 1.0]), r"orbit 1 \(r = 1, p_r = 2, L = 1\) has no turning points"),
        ("-1/r", ([1.0], [0.0], [0.0]), "falls into the centre"),
        ("-1/r", ([-1.0], [0.0], [1.0]), "r > 0 and L ≥ 0 are needed"),
        ("-G/r", ([1.0], [0.0], [1.0]), "unknown name 'G'"),
    ],
)
def test_what_is_refused(V: str, state: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        central_actions(V, *state)


@pytest.mark.parametrize(("q", "p"), [(1.0, 2.5), (-2.0, -2.5), (3.0, 2.0), (0.5, 0.3), (-2.5, -0.1)])
def test_an_angle_of_the_pendulum_is_that_of_the_place_after_any_number_of_turns(q: float, p: float) -> None:
    """At q + 2π both sin(q/2) and cos(q/2) change their signs."""
    places = q + 2 * np.pi * np.arange(-3, 4)
    with double():
        w = np.asarray(pendulum_angle(np.sin(places / 2), np.cos(places / 2), p / 2))
        assert np.all(np.abs(w - float(motion("p**2/2 - cos(q)").at(q, p).angle.value)) < 1e-14)  # type: ignore[union-attr]


def test_what_is_no_orbit_has_no_numbers() -> None:
    """J_r was 5.99 at L = −0.9, and 0.34 at r = −1."""
    with double():
        found = isochrone_actions(np.array([1.0, 1.0, -1.0, 1.0]), 0.3, np.array([0.9, -0.9, 0.9, 0.0]))
        assert np.isfinite(np.asarray(found.radial)).tolist() == [True, False, False, True]
        assert np.isfinite(np.asarray(found.azimuthal)).tolist() == [True, False, False, True]
        for inertia, strength in ((-1.0, -1.0), (-1.0, 1.0), (1.0, 0.0)):
            swing = pendulum_actions(0.5, inertia=inertia, strength=strength)
            assert np.isnan([float(swing.action), float(swing.period), float(swing.frequency)]).all()
