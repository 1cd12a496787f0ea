"""What docstrings state of conditioning, where it is a number: measured by moving what goes in."""

import jax
import mpmath as mp
import numpy as np
import pytest

from canon.numeric.actions.frequency_analysis import frequency_lines
from canon.numeric.cycloid import fastest_descent
from canon.numeric.exact import carlson, stumpff
from canon.numeric.groups import se3, symplectic
from canon.numeric.integrators import catalogue, separable
from canon.numeric.precision import double
from canon.numeric.refraction import ray_through_layers
from canon.numeric.surfaces import surface_integral
from canon.numeric.transport import flow_differences

STEP = 1e-6
POINTS = [(0.3, 1.0, 2.0, 0.7), (1e-8, 1.0, 1e6, 0.7), (1.0, 1.0, 1.0 + 1e-3, 0.7)]


def total(function, arguments) -> np.ndarray:
    """Σ |∂ ln f/∂ ln x| by central differences, at all points at once."""
    found = 0.0
    for k, x in enumerate(arguments):
        up, down = ([*arguments[:k], x * factor, *arguments[k + 1 :]] for factor in (1 + STEP, 1 - STEP))
        found = found + np.abs(np.log(function(*up)) - np.log(function(*down))) / (2 * STEP)
    return found


def test_carlsons_integrals_do_not_amplify():
    x, y, z, p = np.array(POINTS).T
    with double():
        r_f, r_j = jax.jit(carlson.carlson_rf), jax.jit(carlson.carlson_rj)
        assert total(r_f, (x, y, z)) == pytest.approx(1 / 2, abs=1e-6)
        assert total(r_j, (x, y, z, p)) == pytest.approx(3 / 2, abs=1e-6)
        assert np.asarray(r_f(x, y, z)) == pytest.approx([float(mp.elliprf(*at[:3])) for at in POINTS], rel=1e-14)


@pytest.mark.parametrize("angle", [1e-9, 1.0, 3.0, np.pi])
def test_translations_of_twists_have_the_condition_that_is_stated(angle):
    with double():
        omega = angle * np.array([2.0, 3.0, 6.0]) / 7
        matrix = np.stack([np.asarray(se3.exp(omega, v)[1]) for v in np.eye(3)], axis=1)
    assert np.linalg.cond(matrix) == pytest.approx((angle / 2) / np.sin(angle / 2), rel=1e-12)
    assert np.linalg.cond(matrix) <= np.pi / 2 + 1e-12


def envelope(k: int, psi: float):
    """The size about which c_k oscillates; 0 where it does not."""
    return 1 / (1 + mp.sqrt(psi)) ** min(k, 2) if psi > 0 else mp.mpf(0)


def exact_stumpff(psi: float):
    """c_0 … c_3 of |ψ| > 1e-3, in sixty digits."""
    x = mp.sqrt(abs(mp.mpf(psi)))
    c, s, sign = (mp.cos(x), mp.sin(x), 1) if psi > 0 else (mp.cosh(x), mp.sinh(x), -1)
    return c, s / x, sign * (1 - c) / x**2, sign * (x - s) / x**3


@pytest.mark.parametrize(("function", "most"), [(stumpff.stumpff, 4), (stumpff.stumpff_quickly, 12)])
def test_stumpffs_functions_are_off_by_the_roundings_that_are_stated(function, most):
    random = np.random.default_rng(0)
    psi = np.concatenate([sign * 10 ** random.uniform(-3, 3.6, 60) for sign in (1, -1)])
    with double():
        found = [np.asarray(c) for c in jax.jit(function)(psi)]
    with mp.workdps(60):
        for j, at in enumerate(map(float, psi)):
            for k, exact in enumerate(exact_stumpff(at)):
                off = abs(mp.mpf(float(found[k][j])) - exact) / max(abs(exact), envelope(k, at))
                assert off <= 2.0**-53 * (most + 4 * mp.sqrt(abs(at)))


def test_the_time_of_the_fastest_descent_does_not_amplify():
    for ratio in 10.0 ** np.arange(-8, 9):
        assert total(lambda x, y, g: fastest_descent(x, y, g).time, (ratio, 1.0, 9.8)) <= 1.22
        assert total(lambda x, y, g: fastest_descent(x, y, g).radius, (ratio, 1.0, 9.8)) <= 5.001


@pytest.mark.parametrize(("index", "across"), [(1.5, 1e-3), (1.5, 1e6), (1.001, 1.0), (1.001, 1e6)])
def test_slopes_of_flat_rays_know_the_difference_of_indices_and_the_path_knows_itself(index, across):
    def ray(n, m, d, e, x):
        return ray_through_layers([n, m], [d, e], x)

    at = (1.0, index, 1.0, 2.0, across)
    assert total(lambda *x: ray(*x).optical_path, at) == pytest.approx(2, abs=1e-5)
    assert total(lambda *x: ray(*x).invariant, at) <= 3.001
    slope = total(lambda *x: ray(*x).slopes[1], at)
    assert slope <= 4 + index / (index - 1)
    if across == 1e6:
        assert slope > 0.9 * index / (index - 1)


@pytest.mark.parametrize("size", [1e-3, 1.0, 20.0])
def test_flows_of_quadratic_hamiltonians_are_off_by_the_roundings_that_are_stated(size):
    S = np.random.default_rng(1).normal(size=(4, 4))
    S = (S + S.T) / 2
    S *= size / np.linalg.norm(S, 2)
    with double():
        found, field = np.asarray(symplectic.exp(S)), np.asarray(symplectic.generator(S))
    with mp.workdps(60):
        exact = mp.expm(mp.matrix(field.tolist()))
        off = np.array((mp.matrix(found.tolist()) - exact).tolist(), dtype=float)
        assert np.linalg.norm(off, 2) <= 5 * (1 + size) * 2.0**-53 * np.linalg.norm(found, 2)


@pytest.mark.parametrize("noise", [1e-3, 1e-9])
def test_noise_moves_a_frequency_as_far_as_is_stated(noise):
    random, count, off = np.random.default_rng(1), 512, []
    for _ in range(40):
        nu = 0.07 + 0.1 * random.uniform()
        signal = np.exp(2j * np.pi * nu * np.arange(count))
        signal = signal + noise * (random.normal(size=count) + 1j * random.normal(size=count))
        off.append(frequency_lines(signal, 1.0).frequencies[0] - nu)
    stated = 2.2 * np.sqrt(6) * noise / (np.pi * count**1.5)
    assert np.sqrt(np.mean(np.square(off))) == pytest.approx(stated, rel=0.3)


def test_the_integral_over_a_small_surface_far_away_is_known_to_its_bound():
    """A disc of radius 1e-3 at (q, p) = (1e3, 1e3): ∬ dp∧dq is known to some 1e-13 of 1, not of itself."""

    def disc(u):
        r, angle = 1e-3 * u[:, 0], 2 * np.pi * u[:, 1]
        return np.stack([1e3 + r * np.cos(angle), 1e3 + r * np.sin(angle)], axis=1)

    found = surface_integral(disc, (False, True))
    assert abs(abs(found.value) - np.pi * 1e-6) <= found.bound < 1e-8


def test_differences_of_a_flow_are_off_by_no_more_than_they_say():
    """Half a turn of an oscillator, in closed form: M = −1 along two curves through a point."""
    flow, method = separable(lambda p: p, lambda q: -q), catalogue.method("kahan_li8")
    found, off = flow_differences(
        flow,
        method,
        lambda s: 1.0 + np.multiply.outer(np.sin(s), np.eye(2)),
        first=1,
        steps=400,
        duration=np.pi,
        t0=0.0,
    )
    assert np.abs(found + np.eye(2)).max() <= off < 1e-9
