"""The other closed flows against mpmath at 50 digits or the adaptive reference, at their limits above all."""

from collections.abc import Sequence

import jax
import jax.numpy as jnp
import mpmath as mp
import numpy as np
import pytest

from canon.numeric.adaptive import integrate_adaptively
from canon.numeric.exact.carlson import carlson_rf, carlson_rj
from canon.numeric.exact.euler_rotor import sn_cn_dn
from canon.numeric.exact.free_top import free_top
from canon.numeric.exact.oscillator import oscillator
from canon.numeric.exact.pendulum import pendulum, period
from canon.numeric.exact.relativistic_charge import relativistic_charge
from canon.numeric.exact.stumpff import stumpff, stumpff_4, stumpff_quickly
from canon.numeric.exact.uniform import uniform_acceleration, uniform_fields
from canon.numeric.integrators import Field
from canon.numeric.precision import double
from canon.numeric.rotations import cross, multiply, rotate

SWING, PERIOD = jax.jit(pendulum), jax.jit(period)
FROM_TOP = jax.jit(lambda q, p, t: pendulum(q, p, t, from_top=True))
OSCILLATE = jax.jit(lambda q, v, t, k, g, f, W, b: oscillator(q, v, t, omega2=k, damping=g, force=f, drive=W, phase=b))
NEWTON, EINSTEIN = jax.jit(uniform_fields), jax.jit(relativistic_charge)


@pytest.mark.parametrize("m1", [1.0, 0.5, 1e-3, 1e-8, 1e-20])
def test_elliptic_functions_on_the_complementary_parameter(m1: float) -> None:
    with mp.workdps(60), double():
        K = float(mp.ellipk(1 - mp.mpf(m1)))
        u = np.concatenate([np.linspace(-3 * K, 5 * K, 17) + 0.01, [0.0, 1e-8, K - 1e-6, K]])
        found = np.array(jax.jit(sn_cn_dn)(u, m1))
        exact = [[mp.re(mp.ellipfun(k, mp.mpf(x), m=1 - mp.mpf(m1))) for x in u] for k in ("sn", "cn", "dn")]
    assert np.abs(found - np.array(exact, dtype=float)).max() < 2e-15 * max(1, K)


def test_carlson_integrals() -> None:
    with double():
        for x, y, z, p in ((0.3, 0.5, 0.9, 0.7), (0.0, 0.2, 1.0, 20.0), (0.0, 1e-12, 1.0, 1e-3), (1.0, 1.0, 1.0, 1.0)):
            assert float(carlson_rf(x, y, z)) == pytest.approx(float(mp.elliprf(x, y, z)), rel=1e-15)
            assert float(carlson_rj(x, y, z, p)) == pytest.approx(float(mp.elliprj(x, y, z, p)), rel=3e-15)


def swing_reference(q: float, p: float, t: float) -> tuple[mp.mpf, mp.mpf]:
    """Whittaker (1937), 44, at 50 digits, from the phase that belongs to the state."""
    angle, momentum, time = mp.mpf(q), mp.mpf(p), mp.mpf(t)
    S, P = mp.sin(angle / 2), momentum / 2
    m = S * S + P * P
    k = mp.sqrt(m)
    if m < 1:
        u = mp.ellipf(mp.atan2(S / k, P / k), m) + time
        sn, cn, dn = (mp.re(mp.ellipfun(name, u, m=m)) for name in ("sn", "cn", "dn"))
        return 2 * mp.atan2(k * sn, dn), 2 * k * cn
    way = mp.sign(P)
    u = mp.ellipf(angle / 2, 1 / m) * way + k * time
    sn, cn, dn = (mp.re(mp.ellipfun(name, u, m=1 / m)) for name in ("sn", "cn", "dn"))
    half_turns = int(mp.nint(u / (2 * mp.ellipk(1 / m))))
    side = (-1) ** half_turns
    return way * 2 * (mp.atan2(sn * side, cn * side) + half_turns * mp.pi), way * 2 * k * dn


@pytest.mark.parametrize(
    ("q", "p"),
    [
        (1.0, 0.3),
        (1e-8, 0.0),
        (3.1, 0.0),
        (0.0, 2 * (1 - 1e-8)),
        (0.0, 2 * (1 + 1e-8)),
        (0.0, 2 * (1 - 1e-15)),
        (np.pi - 1e-6, 1e-9),
        (0.5, 3.0),
        (-1.0, -2.5),
    ],
)
def test_pendulum_through_the_separatrix(q: float, p: float) -> None:
    with mp.workdps(50), double():
        for t in (1e-3, 1.0, 10.0, 55.5, -7.0):
            for value, exact in zip(SWING(q, p, t), swing_reference(q, p, t), strict=True):
                assert abs(float(value) - exact) < 1e-14 + 5e-16 * abs(t)


def test_pendulum_after_a_hundred_periods_at_the_separatrix() -> None:
    q, p = 0.0, 2 * (1 - 1e-8) ** 0.5
    with double():
        T = float(PERIOD(q, p))
        assert pytest.approx(float(4 * mp.ellipk(1 - mp.mpf(1e-8))), rel=1e-9) == T
        after = SWING(q, p, 100 * T)
        assert abs(float(after[0])) < 1e-12
        assert abs(float(after[1]) - p) < 1e-12
        assert float(PERIOD(0.0, 4.0)) == pytest.approx(float(mp.ellipk(mp.mpf(1) / 4)), rel=1e-15)


@pytest.mark.parametrize(("delta", "p", "t"), [(1e-3, 0.0, 4.0), (0.4, -0.3, 9.0), (-0.2, 2.5, 20.0), (7.0, 0.1, 3.0)])
def test_pendulum_counted_from_the_top(delta: float, p: float, t: float) -> None:
    with double():
        found, momentum = FROM_TOP(delta, p, t)
        other, same = SWING(np.pi + delta, p, t)
    assert float(found) == pytest.approx(float(other) - np.pi, abs=1e-12)
    assert float(momentum) == pytest.approx(float(same), abs=1e-12)


def test_pendulum_next_to_the_top_keeps_the_digits_of_its_distance() -> None:
    with double():
        found, _ = FROM_TOP(1e-100, 0.0, 3.0)
        assert float(found) == pytest.approx(1e-100 * np.cosh(3.0), rel=1e-14)


@pytest.mark.slow
def test_pendulum_units_and_its_jacobian() -> None:
    inertia, strength = 0.7, 2.3
    with double():
        field = Field(lambda z, t: (z[1] / inertia, -strength * jnp.sin(z[0])))
        run = integrate_adaptively(field, (np.array([9.0]), np.array([1.0])), [0.0, 4.0], relative=1e-14)
        found = pendulum(9.0, 1.0, 4.0, inertia=inertia, strength=strength)
        assert np.allclose(found, [run.states[0][1, 0], run.states[1][1, 0]], rtol=1e-12)
        M = jax.jit(jax.jacfwd(lambda z: jnp.stack(pendulum(z[0], z[1], 3.0))))(jnp.array([1.0, 1.9]))
        assert float(jnp.linalg.det(M)) == pytest.approx(1, abs=1e-12)


def oscillator_reference(
    q: float, v: float, t: float, k: float, g: float, f: float, W: float, b: float
) -> tuple[mp.mpf, mp.mpf]:
    """The three exponentials of the solution, apart from each other by 1e-25 where they coincide."""
    q, v, t, k, g, f, W, b = map(mp.mpf, (q, v, t, k, g, f, W, b))
    tiny = mp.mpf(10) ** -25
    root = mp.sqrt(mp.mpc(g * g - k)) or tiny
    low, high, wave = -g - root, -g + root, mp.mpc(0, W)
    wave += 2 * tiny if min(abs(wave - low), abs(wave - high)) < tiny else 0
    points = (wave, low, high)
    forced = sum(
        mp.exp(z * t) / mp.fprod(z - other for j, other in enumerate(points) if i != j) for i, z in enumerate(points)
    )
    slide = (mp.exp(high * t) - mp.exp(low * t)) / (high - low)
    even = (high * mp.exp(low * t) - low * mp.exp(high * t)) / (high - low)
    slope = (high * mp.exp(high * t) - low * mp.exp(low * t)) / (high - low)
    push = f * mp.expj(b)
    velocity = v * slope - q * k * slide + push * (slide + wave * forced)
    return mp.re(q * even + v * slide + push * forced), mp.re(velocity)


@pytest.mark.parametrize(
    "case",
    [
        (1.0, 0.3, 7.0, 1.0, 0.0, 0.4, 1.0, 0.3),  # resonance
        (1.0, 0.3, 7.0, 1.0, 0.0, 0.4, 1 + 1e-10, 0.3),
        (1.0, 0.3, 7.0, 1.0, 1.0, 0.4, 0.7, 0.3),  # critical damping
        (1.0, 0.3, 7.0, 1.0, 1 + 1e-12, 0.4, 0.7, 0.3),
        (1.0, 0.3, 7.0, 1.0, 1e-9, 0.4, 1.0, 0.3),
        (1.0, 0.3, 7.0, 1.0, 3.0, 0.4, 0.0, 0.3),  # overdamped, pushed
        (1.0, 0.3, 80.0, 5.7, 65.0, 0.0, 0.0, 0.0),  # long after the fast decay, whose exponential underflows
        (1.0, 0.3, 140.0, 0.26, 18.0, 0.4, 0.22, 0.3),
        (1.0, 0.3, 0.5, 4.0, 10.0, 0.4, 0.7, 0.3),
        (1.0, 0.3, 3.0, -1.0, 0.2, 0.4, 5.0, 0.3),  # inverted
        (1.0, 0.3, 0.01, 1.0, 0.2, 0.4, 5.0, 0.3),
        (1.0, 0.3, 2.0, 0.0, 0.0, 0.4, 0.0, 0.0),  # free, pushed
    ],
)
def test_damped_and_driven_oscillator(case: tuple[float, ...]) -> None:
    with mp.workdps(120), double():
        exact = [float(x) for x in oscillator_reference(*case)]
        found = [float(x) for x in OSCILLATE(*case)]
    assert np.abs(np.subtract(found, exact)).max() < 2e-15 * np.abs(exact).max()


FIELDS = {
    "crossed": ([0.1, 0.2, 0.3], [1.0, 0.5, -0.3]),
    "electric": ([0.1, 0.2, 0.3], [0.0, 0.0, 0.0]),
    "magnetic": ([0.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
    "null": ([0.0, 1.5, 0.0], [0.0, 0.0, 1.0]),
    "almost null": ([0.0, 1.5, 0.0], [0.0, 0.0, 1.0001]),
    "none": ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
}
X, V, LIGHT = np.array([0.1, 0.2, 0.3]), np.array([0.5, -0.3, 0.2]), 1.5


@pytest.mark.parametrize("name", FIELDS)
def test_charges_in_uniform_fields(name: str) -> None:
    """The null fields are those of a plane wave, |E| = c|B| and E·B = 0, where the eigenvalues all vanish."""
    e, w = map(np.array, FIELDS[name])

    def rate(state: tuple, t: float) -> tuple:
        g = jnp.sqrt(1 + jnp.sum(state[1] ** 2) / LIGHT**2)
        return state[1] / g, e + cross(state[1], jnp.asarray(w)) / g

    with double():
        relativistic = integrate_adaptively(Field(rate), (X, V), [0.0, 5.0], relative=1e-14).states
        found = EINSTEIN(X, V, e, w, LIGHT, 5.0)
        assert all(np.abs(a - b[1]).max() < 5e-14 for a, b in zip(found, relativistic, strict=True))
        returned = EINSTEIN(*found, e, w, LIGHT, -5.0)
        assert np.abs(np.array(returned) - [X, V]).max() < 1e-13
        slow = NEWTON(X, V, e, w, 3.0)
        back = NEWTON(*slow, e, w, -3.0)
        assert np.abs(np.array(back) - [X, V]).max() < 1e-14
        # the nonrelativistic flow is the limit of a large c, but for terms of (v/c)²
        assert np.abs(np.array(EINSTEIN(X, V, e, w, 1e7, 3.0)) - np.array(slow)).max() < 1e-11


@pytest.mark.parametrize(("speed", "t"), [(6e-3, 97.0), (0.0, -1e4), (1e-9, 1e6)])
def test_a_charge_that_is_pushed_for_long(speed: float, t: float) -> None:
    """Hyperbolic motion: y = (u_y/e) arsinh(et/√(1 + u_y²)), c = 1. Landau and Lifshitz (1975), § 20."""
    zero = np.zeros(3)
    with mp.workdps(40), double():
        x, u = EINSTEIN(zero, np.array([0.0, speed, 0.0]), np.array([9.0, 0.0, 0.0]), zero, 1.0, t)
        v = mp.mpf(speed)
        exact = v / 9 * mp.asinh(9 * mp.mpf(t) / mp.sqrt(1 + v * v))
        assert float(u[0]) == pytest.approx(9 * t, rel=5e-15)  # sinh of a proper time that is rounded
        assert float(x[1]) == pytest.approx(float(exact), rel=2e-15)


def test_uniform_acceleration() -> None:
    x, v = uniform_acceleration(X, V, np.array([0.0, 0.0, -9.81]), 2.0)
    assert np.allclose(x, [1.1, -0.4, 0.7 - 2 * 9.81], rtol=1e-15)
    assert np.allclose(v, [0.5, -0.3, 0.2 - 2 * 9.81], rtol=1e-15)


START = np.array([0.5, 0.5, -0.5, 0.5])


@pytest.mark.slow
@pytest.mark.parametrize("moments", [(1.0, 2.0, 2.7), (2.0, 1.0, 2.7), (1.0, 1.0, 1.7), (1.5, 1.5, 1.5)])
def test_free_tops(moments: Sequence[float]) -> None:
    I = np.array(moments)

    def rate(state: tuple, t: float) -> tuple:
        attitude, M = state
        spin = jnp.concatenate([jnp.zeros(1), M / I])
        return multiply(attitude, spin) / 2, cross(M, M / I)

    field = Field(rate)
    with double():
        flow = jax.jit(lambda attitude, M, t: free_top(attitude, M, tuple(moments), t))
        for M in ([0.3, 0.4, 1.2], [1.2, 0.1, -0.3], [-0.5, 1.0, 0.2], [1e-3, -1.0, 1e-9], [0.0, 0.0, 1.0]):
            momentum = np.array(M)
            exact = integrate_adaptively(field, (START, momentum), [0.0, 7.0], relative=1e-14).states
            attitude, found = map(np.asarray, flow(START, momentum, 7.0))
            assert np.abs(found - exact[1][1]).max() < 2e-12
            assert min(np.abs(attitude - s * exact[0][1]).max() for s in (1, -1)) < 2e-12
            assert np.abs(rotate(attitude, found) - rotate(START, momentum)).max() < 1e-15 * 4
        still = flow(START, np.array([0.0, 1.0, 0.0]), 7.0)[1]
        assert np.abs(np.asarray(still) - [0, 1, 0]).max() < 1e-15


def test_stumpff_functions_both_ways() -> None:
    psi = np.concatenate([np.linspace(-60.5, 37.5, 99), [-1000.0, 1e-9, -1e-9]])
    with mp.workdps(40), double():
        exact = []
        for value in psi:
            x = mp.sqrt(mp.mpc(value))
            exact.append([mp.cos(x), mp.sin(x) / x, (1 - mp.cos(x)) / x**2, (x - mp.sin(x)) / x**3])
        true = np.array([[float(mp.re(term)) for term in row] for row in exact]).T
        for function in (stumpff, stumpff_quickly):
            found = np.array(function(jnp.asarray(psi)))
            scale = np.maximum(np.abs(true), np.array([1.0, 1.0, 0.05, 0.02])[:, None])
            assert (np.abs(found - true) / scale).max() < 5e-15
        fourth = [float(mp.re((mp.mpf(1) / 2 - row[2]) / value)) for row, value in zip(exact, psi, strict=True)]
        assert np.allclose(stumpff_4(jnp.asarray(psi)), fourth, rtol=5e-15)
